#include "planner/domain/workcell/arm_site.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "planner/domain/workcell/floor.h"
#include "planner/geometry/pose.h"

namespace assay::domain {
namespace {

using geometry::Pose;
using geometry::Vector2;
using geometry::Vector3;
using kinematics::JointVector;

constexpr std::array kSafeHeights = {0.40, 0.30, 0.25, 0.20};  // the highest that works is taken
constexpr double kNearestEdge = 0.10;                          // metres from the base's axis
constexpr double kFarthestMiddle = 3.0;
constexpr double kSquareStep = 0.025;
constexpr double kLow = 0.01;        // height of the tool that works at the table
constexpr double kLeastHalf = 0.10;  // half the side of the smallest square
constexpr double kMostHalf = 0.30;
constexpr double kLowest = 1.05;  // how far the arm may stand below the table's top
constexpr double kLowerStep = 0.15;
constexpr double kTableGap = 0.05;     // between the base's shapes and the table
constexpr double kLimitMargin = 0.05;  // radians that joints stay away from their limits

using WorkingConfiguration = std::optional<kinematics::Indicators>;

// Returns the configurations of an arm; nothing, which is any, if they cannot be told apart.
std::vector<WorkingConfiguration> WorkingConfigurations(const kinematics::Arm& arm) {
  using namespace kinematics;
  if (!arm.IndicatorsTellAllApart()) return {std::nullopt};
  std::vector<WorkingConfiguration> configurations;
  for (const Shoulder shoulder : {Shoulder::kRight, Shoulder::kLeft}) {
    for (const Elbow elbow : {Elbow::kAbove, Elbow::kBelow}) {
      for (const Wrist wrist : {Wrist::kNoFlip, Wrist::kFlip}) {
        configurations.push_back(Indicators{shoulder, elbow, wrist});
      }
    }
  }
  return configurations;
}

double HeightOfLowestJoint(const kinematics::Arm& arm, const Pose& X_WorldBase,
                           const JointVector& q) {
  double lowest = std::numeric_limits<double>::infinity();
  const auto X_BaseLinks = arm.LinkPoses(q);
  for (std::size_t link = 1; link < X_BaseLinks.size(); ++link) {
    lowest = std::min(lowest, (X_WorldBase * X_BaseLinks[link]).translation().z());
  }
  return lowest;
}

// An arm at its place, in one configuration, with its tool straight down.
class StandingArm {
 public:
  StandingArm(const kinematics::Arm& arm, const kinematics::Gripper& gripper,
              const Pose& X_WorldBase, const WorkingConfiguration& configuration)
      : arm_(arm),
        X_FlangeTool_(gripper.X_FlangeTool()),
        X_WorldBase_(X_WorldBase),
        configuration_(configuration) {}

  const Pose& X_WorldBase() const { return X_WorldBase_; }

  // Returns the postures at a point of the world, with the tool straight down and turned by yaw
  // about the vertical.
  std::vector<JointVector> PosturesAt(const Vector3& p, double yaw) const {
    const Pose X_WorldTool = geometry::Translation(p.x(), p.y(), p.z()) * geometry::RotationZ(yaw) *
                             geometry::RotationX(std::numbers::pi);
    std::vector<JointVector> postures;
    const Pose X_BaseFlange = X_WorldBase_.inverse() * X_WorldTool * X_FlangeTool_.inverse();
    const auto add = [&](const JointVector& solution) {
      const auto q = arm_.NearestInRange(solution, JointVector::Zero());
      if (q && IsAwayFromLimits(*q)) postures.push_back(*q);
    };
    if (configuration_) {
      const auto q = arm_.Inverse(X_BaseFlange, *configuration_, JointVector::Zero());
      if (q) add(*q);
    } else {
      for (const auto& solution : arm_.Inverse(X_BaseFlange)) add(solution.q);
    }
    return postures;
  }

  bool IsAwayFromLimits(const JointVector& q) const {
    for (std::size_t i = 0; i < 6; ++i) {
      const auto& [lower, upper, velocity, effort] = arm_.limits()[i];
      const double angle = q[static_cast<Eigen::Index>(i)];
      if (angle < lower + kLimitMargin || angle > upper - kLimitMargin) return false;
    }
    return true;
  }

  // Returns whether the tool reaches points from `high` down to the table, turned either way.
  bool ReachesDown(double x, double y, double high) const {
    constexpr int kHeights = 4;
    for (const double yaw : {0.0, std::numbers::pi / 2}) {
      for (int i = 0; i <= kHeights; ++i) {
        const double z = std::lerp(kLow, high, static_cast<double>(i) / kHeights);
        if (PosturesAt({x, y, z}, yaw).empty()) return false;
      }
    }
    return true;
  }

 private:
  const kinematics::Arm& arm_;
  Pose X_FlangeTool_;
  Pose X_WorldBase_;
  WorkingConfiguration configuration_;
};

bool ReachesSquare(const StandingArm& arm, double middle, double half, double high) {
  for (const double x : {-half, 0.0, half}) {
    for (const double y : {-half, 0.0, half}) {
      if (!arm.ReachesDown(middle + x, y, high)) return false;
    }
  }
  return true;
}

// Sets the square of the site to a larger one that the arm reaches from the site's safe height.
void FindLargerSquare(const StandingArm& arm, ArmSite& site) {
  for (double middle = kNearestEdge; middle < kFarthestMiddle; middle += kSquareStep) {
    double half = std::max(kLeastHalf, site.half_side + kSquareStep);
    while (half <= kMostHalf && middle - half >= kNearestEdge &&
           ReachesSquare(arm, middle, half, site.safe_height)) {
      site.X_WorldBase = arm.X_WorldBase();
      site.half_side = half;
      site.middle = Vector2(middle, 0);
      half += kSquareStep;
    }
  }
}

constexpr double kLowered = 0.05;  // metres by which a joint may be lower than it needs to be

// Returns the posture with the least turns of the joints, among those in which no joint is much
// lower than it needs to be.
JointVector HomeOf(const kinematics::Arm& arm, const StandingArm& standing, const ArmSite& site) {
  std::vector<JointVector> postures =
      standing.PosturesAt({site.middle.x(), site.middle.y(), site.safe_height}, 0);
  const auto height = [&](const JointVector& q) {
    return HeightOfLowestJoint(arm, site.X_WorldBase, q);
  };
  double highest = -std::numeric_limits<double>::infinity();
  for (const JointVector& q : postures) highest = std::max(highest, height(q));
  std::erase_if(postures, [&](const JointVector& q) { return height(q) < highest - kLowered; });
  return *std::ranges::min_element(postures, {}, [](const JointVector& q) { return q.norm(); });
}

// Returns how far the arm's base reaches along x.
double FrontOf(const kinematics::Arm& arm) {
  const Pose forward_is_down = geometry::RotationY(std::numbers::pi / 2);
  return -UndersideOf(arm.model().links.front(), forward_is_down).value_or(0);
}

// Finds the place of an arm that works in one configuration.
std::optional<ArmSite> FindSite(const kinematics::Arm& arm, const kinematics::Gripper& gripper,
                                const WorkingConfiguration& configuration) {
  const double height = -UndersideOf(arm.model().links.front(), Pose::Identity()).value_or(0);
  ArmSite site;
  for (const double safe_height : kSafeHeights) {
    site.safe_height = safe_height;
    for (double lower = 0; lower < kLowest; lower += kLowerStep) {
      FindLargerSquare({arm, gripper, geometry::Translation(0, 0, height - lower), configuration},
                       site);
    }
    if (site.half_side > 0) break;
  }
  if (site.half_side == 0) return std::nullopt;
  const StandingArm standing(arm, gripper, site.X_WorldBase, configuration);
  site.home = HomeOf(arm, standing, site);
  site.table_edge = std::min(site.middle.x() - site.half_side, FrontOf(arm) + kTableGap);
  return site;
}

}  // namespace

std::optional<ArmSite> FindArmSite(const kinematics::Arm& arm, const kinematics::Gripper& gripper) {
  std::optional<ArmSite> best;
  double lowest = 0;
  for (const WorkingConfiguration& configuration : WorkingConfigurations(arm)) {
    const std::optional<ArmSite> site = FindSite(arm, gripper, configuration);
    if (!site) continue;
    const double height = HeightOfLowestJoint(arm, site->X_WorldBase, site->home);
    const auto rank = [](const ArmSite& one) { return std::pair(one.safe_height, one.half_side); };
    const bool is_better =
        !best || rank(*site) > rank(*best) ||
        (rank(*site) == rank(*best) &&
         (height > lowest + kLowered ||
          (height > lowest - kLowered && site->home.norm() < best->home.norm())));
    if (!is_better) continue;
    best = site;
    lowest = height;
  }
  return best;
}

}  // namespace assay::domain
