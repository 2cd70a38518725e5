#include "sim/execution/trial/finding.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "planner/base/check.h"
#include "planner/domain/matings/mating_success.h"

namespace assay::execution {
namespace {

using domain::Feature;
using domain::Mating;
using domain::Part;
using domain::Problem;

// Returns a finding that holds if the value is at most the limit. It does not hold for NaN.
Finding AtMost(Aspect aspect, const std::string& name, double value, double limit,
               domain::Dimension dimension) {
  return {aspect, name, value, limit, dimension, value <= limit};
}

const Feature& FeatureOf(const Part& part, domain::FeatureNumber number) {
  const Feature* feature = part.model->FindFeature(number);
  ASSAY_CHECK(feature != nullptr, "{} has no feature {}", part.name, number.index());
  return *feature;
}

// The mating frames of a pair of mating features, each in the frame of its own part.
struct Pair {
  Pose X_HeldFeature;
  Pose X_FixedFeature;
};

Pair PairOf(const Problem& problem, const Mating& mating, std::size_t pair) {
  const auto& [of_held, of_fixed] = mating.features[pair];
  return {FeatureOf(problem.part(mating.held), of_held).X_PartFeature,
          FeatureOf(problem.part(mating.fixed), of_fixed).X_PartFeature};
}

std::string NameOf(const char* what, const Problem& problem, const Mating& mating) {
  return fmt::format("{} of {} in {}", what, problem.part(mating.held).name,
                     problem.part(mating.fixed).name);
}

double AngleBetweenAxes(const Vector3& a, const Vector3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

Finding SeatedDepth(const Problem& problem, const Mating& mating, const Pose& X_FixedHeld) {
  const Vector3 error = mating.X_FixedHeld.translation() - X_FixedHeld.translation();
  return AtMost(Aspect::kSeated, NameOf("seated depth", problem, mating),
                std::abs(error.dot(mating.mating_vector.normalized())), domain::kSeatedLimit,
                domain::Dimension::kLength);
}

Finding LateralError(const Problem& problem, const Mating& mating, const Pose& X_FixedHeld) {
  const Pair pair = PairOf(problem, mating, 0);
  const Vector3 point = pair.X_HeldFeature.translation();
  const Vector3 error =
      pair.X_FixedFeature.linear().transpose() * (X_FixedHeld * point - mating.X_FixedHeld * point);
  return AtMost(Aspect::kAligned, NameOf("lateral error", problem, mating),
                error.head<2>().cwiseAbs().maxCoeff(), domain::LateralLimit(problem),
                domain::Dimension::kLength);
}

Finding AxisAngle(const Problem& problem, const Mating& mating, const Pose& X_FixedHeld) {
  const Vector3 axis = PairOf(problem, mating, 0).X_HeldFeature.linear().col(2);
  return AtMost(Aspect::kAligned, NameOf("axis angle", problem, mating),
                AngleBetweenAxes(X_FixedHeld.linear() * axis, mating.X_FixedHeld.linear() * axis),
                domain::kAxisAngleLimit, domain::Dimension::kAngle);
}

Finding AlignmentError(const Problem& problem, const Mating& mating, std::size_t pair,
                       const Pose& X_FixedHeld) {
  const Pair features = PairOf(problem, mating, pair);
  const Vector3 apart = X_FixedHeld * Vector3(features.X_HeldFeature.translation()) -
                        features.X_FixedFeature.translation();
  const Vector3 along = mating.mating_vector.normalized();
  const Vector3 across = apart - along * along.dot(apart);
  return AtMost(Aspect::kAligned,
                NameOf("alignment", problem, mating) +
                    fmt::format(", features {} and {}", mating.features[pair].first.index(),
                                mating.features[pair].second.index()),
                across.norm(), domain::AlignmentLimit(problem), domain::Dimension::kLength);
}

std::vector<Finding> MatingFindings(const Problem& problem, const Mating& mating,
                                    const Pose& X_FixedHeld) {
  std::vector<Finding> findings = {SeatedDepth(problem, mating, X_FixedHeld),
                                   LateralError(problem, mating, X_FixedHeld),
                                   AxisAngle(problem, mating, X_FixedHeld)};
  for (std::size_t pair = 1; pair < mating.features.size(); ++pair) {
    findings.push_back(AlignmentError(problem, mating, pair, X_FixedHeld));
  }
  return findings;
}

Finding Released(const Part& part, const GripperState& gripper, const Limits& limits) {
  const double wider = gripper.opening - gripper.held_width;
  return {Aspect::kReleased,
          fmt::format("opening beyond {}{}", part.name,
                      gripper.touching ? ", which the hand still touches" : ""),
          wider,
          limits.released,
          domain::Dimension::kLength,
          !gripper.touching && wider >= limits.released};
}

std::vector<Finding> AtRest(const Part& part, const execution::RestRecord::Speeds& speeds,
                            const Limits& limits) {
  return {AtMost(Aspect::kAtRest, "speed of " + part.name, speeds.linear, limits.speed,
                 domain::Dimension::kSpeed),
          AtMost(Aspect::kAtRest, "angular speed of " + part.name, speeds.angular,
                 limits.angular_speed, domain::Dimension::kAngularSpeed)};
}

std::vector<Finding> Located(const Part& part,
                             const std::vector<domain::StablePoseId>& stable_poses,
                             const Pose& X_WorldPart, const Limits& limits) {
  ASSAY_CHECK(!stable_poses.empty());
  const auto tilt_from = [&](domain::StablePoseId id) {
    const Pose& X_TablePart = part.model->stable_poses()[id.index()].X_TablePart;
    return AngleBetweenAxes(X_WorldPart.linear().row(2), X_TablePart.linear().row(2));
  };
  const domain::StablePoseId nearest = std::ranges::min(stable_poses, {}, tilt_from);
  const domain::StablePose& pose = part.model->stable_poses()[nearest.index()];
  const double height = X_WorldPart.translation().z() - pose.X_TablePart.translation().z();
  return {AtMost(Aspect::kLocated, fmt::format("tilt of {} from {}", part.name, pose.label),
                 tilt_from(nearest), limits.tilt, domain::Dimension::kAngle),
          AtMost(Aspect::kLocated, fmt::format("height of {} over {}", part.name, pose.label),
                 std::abs(height), limits.height, domain::Dimension::kLength)};
}

std::string Text(const Finding& finding) {
  const std::string_view unit = domain::SiUnitOf(finding.dimension).name;
  return fmt::format("{}: {:.4g} {}, limit {:.4g} {}", finding.name, finding.value, unit,
                     finding.limit, unit);
}

}  // namespace assay::execution
