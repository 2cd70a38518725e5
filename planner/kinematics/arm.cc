#include "planner/kinematics/arm.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/kinematics/branched_chain.h"
#include "planner/kinematics/lee_ziegler.h"

namespace assay::kinematics {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
// The greatest excess over a joint limit that counts as rounding, in radians.
constexpr double kLimitTolerance = 1e-9;

double Clamped(double angle, const JointLimits& limits) {
  return std::min(std::max(angle, limits.lower), limits.upper);
}

bool Within(double angle, const JointLimits& limits) {
  return angle >= limits.lower - kLimitTolerance && angle <= limits.upper + kLimitTolerance;
}

// Returns the least angle of the form angle + k turns that is at least `low`, up to rounding.
double FirstTurnFrom(double angle, double low) {
  return angle + kTurn * std::ceil((low - kLimitTolerance - angle) / kTurn);
}

}  // namespace

Arm::Arm(RobotModel model) : model_(std::move(model)), geometry_(GeometryOf(model_)) {
  for (std::size_t i = 0; i < 6; ++i) limits_[i] = model_.joints[i].limits;
  if (geometry_) {
    solver_ = std::make_shared<const LeeZiegler>(*geometry_);
  } else {
    solver_ = std::make_shared<const BranchedChain>(MovableChain(model_));
  }
}

Arm Arm::FromUrdf(const std::filesystem::path& file, const ArmInFile& arm,
                  std::span<const std::filesystem::path> packages) {
  return FromModel(ReadUrdf(file, UrdfContents::kBodies, packages), arm);
}

Arm Arm::FromModel(const RobotModel& model, const ArmInFile& arm) {
  return Arm(ArmModel(WithLocked(model, arm.locked), arm.base, arm.flange));
}

std::array<Pose, 7> Arm::LinkPoses(const JointVector& q) const {
  std::array<Pose, 7> X_BaseLink;
  X_BaseLink[0] = Pose::Identity();
  for (std::size_t i = 0; i < 6; ++i) {
    X_BaseLink[i + 1] = X_BaseLink[i] * model_.joints[i].X_ParentChild(q[static_cast<int>(i)]);
  }
  return X_BaseLink;
}

bool Arm::InRange(const JointVector& q) const {
  for (std::size_t i = 0; i < 6; ++i) {
    if (!Within(q[static_cast<int>(i)], limits_[i])) return false;
  }
  return true;
}

std::optional<JointVector> Arm::NearestInRange(const JointVector& q,
                                               const JointVector& reference) const {
  JointVector nearest;
  for (int i = 0; i < 6; ++i) {
    const JointLimits& limits = limits_[static_cast<std::size_t>(i)];
    double angle = q[i] + kTurn * std::round((reference[i] - q[i]) / kTurn);
    if (angle < limits.lower - kLimitTolerance) angle = FirstTurnFrom(angle, limits.lower);
    if (angle > limits.upper + kLimitTolerance) angle = -FirstTurnFrom(-angle, -limits.upper);
    if (!Within(angle, limits)) return std::nullopt;
    nearest[i] = Clamped(angle, limits);
  }
  return nearest;
}

std::vector<JointVector> Arm::Representatives(const JointVector& q) const {
  std::vector<JointVector> found = {q};
  for (int i = 0; i < 6; ++i) {
    const JointLimits& limits = limits_[static_cast<std::size_t>(i)];
    std::vector<JointVector> extended;
    for (JointVector base : found) {
      for (double angle = FirstTurnFrom(q[i], limits.lower); Within(angle, limits);
           angle += kTurn) {
        base[i] = Clamped(angle, limits);
        extended.push_back(base);
      }
    }
    found = std::move(extended);
  }
  return found;
}

JointVector NearestByTurns(const JointVector& q, const JointVector& reference) {
  JointVector nearest = q;
  for (int k = 0; k < 6; ++k) nearest[k] += kTurn * std::round((reference[k] - q[k]) / kTurn);
  return nearest;
}

}  // namespace assay::kinematics
