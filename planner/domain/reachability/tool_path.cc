#include "planner/domain/reachability/tool_path.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "planner/base/check.h"
#include "planner/geometry/pose.h"

namespace assay::domain {
namespace {

using geometry::Matrix3;
using geometry::Pose;
using geometry::Vector3;
using kinematics::Indicators;
using kinematics::JointVector;

constexpr double kStep = 0.05;        // metres between tested positions
constexpr double kTurnStep = 0.1;     // radians between tested orientations
constexpr double kLargestTurn = 0.4;  // greatest turn of a joint from one test to the next, radians
constexpr int kHalvings = 1;          // number of times that a step with a greater turn is halved

Pose PoseOf(const Matrix3& R_WorldTool, const Vector3& p_World) {
  Pose X_WorldTool = geometry::Translation(p_World);
  X_WorldTool.linear() = R_WorldTool;
  return X_WorldTool;
}

// One of the arm's eight configurations, and its joints at the present point of the way.
struct Configuration {
  Indicators indicators;
  JointVector q;
};

// Returns the configurations that the arm may be in at the start of a path, the nearest to home
// first.
std::vector<Configuration> StartsAt(const Workcell& workcell, const Pose& X_WorldTool) {
  std::vector<Configuration> starts;
  const kinematics::Arm& arm = workcell.arm();
  for (const auto& s : arm.Inverse(workcell.FlangeFor(X_WorldTool), workcell.home())) {
    if (const auto q = arm.NearestInRange(s.q, workcell.home())) {
      starts.push_back({s.indicators, *q});
    }
  }
  std::ranges::stable_sort(starts, {},
                           [&](const Configuration& c) { return (c.q - workcell.home()).norm(); });
  return starts;
}

// Returns false if the arm does not get there in its present configuration.
bool MoveTo(const Workcell& workcell, const Pose& X_WorldTool, Configuration& configuration) {
  const JointVector& from = configuration.q;
  const auto solution =
      workcell.arm().Inverse(workcell.FlangeFor(X_WorldTool), configuration.indicators, from);
  if (!solution) return false;
  const auto q = workcell.arm().NearestInRange(*solution, from);
  if (!q || (*q - from).cwiseAbs().maxCoeff() > kLargestTurn) return false;
  configuration.q = *q;
  return true;
}

// The way of the tool from one pose to another, with its origin on a straight line.
class Leg {
 public:
  Leg(const Workcell& workcell, const Pose& from, const Pose& to)
      : workcell_(workcell),
        from_(from),
        line_(to.translation() - from.translation()),
        turn_(Matrix3(from.linear().transpose() * to.linear())) {}

  bool Follow(Configuration& configuration) const {
    const int steps = Steps();
    for (int i = 0; i < steps; ++i) {
      const double now = static_cast<double>(i) / steps;
      const double next = static_cast<double>(i + 1) / steps;
      if (!Step(now, next, kHalvings, configuration)) return false;
    }
    return true;
  }

  // Returns whether the arm reaches each tested pose after the first in some configuration.
  bool IsReachedThroughout() const {
    const int steps = Steps();
    for (int i = 1; i <= steps; ++i) {
      if (!IsReached(workcell_, PoseAt(static_cast<double>(i) / steps))) return false;
    }
    return true;
  }

 private:
  int Steps() const {
    const double looks = std::max({1.0, line_.norm() / kStep, turn_.angle() / kTurnStep});
    return static_cast<int>(std::ceil(looks));
  }
  bool Step(double now, double next, int halvings, Configuration& configuration) const {
    if (MoveTo(workcell_, PoseAt(next), configuration)) return true;
    if (halvings == 0) return false;
    const double middle = (now + next) / 2;
    return Step(now, middle, halvings - 1, configuration) &&
           Step(middle, next, halvings - 1, configuration);
  }
  Pose PoseAt(double share) const {
    return PoseOf(from_.linear() * Eigen::AngleAxisd(share * turn_.angle(), turn_.axis()),
                  from_.translation() + share * line_);
  }

  const Workcell& workcell_;
  const Pose& from_;
  Vector3 line_;
  Eigen::AngleAxisd turn_;
};

bool IsReachedAlong(const Workcell& workcell, std::span<const Pose> X_WorldTools) {
  if (!IsReached(workcell, X_WorldTools[0])) return false;
  for (std::size_t i = 1; i < X_WorldTools.size(); ++i) {
    if (!Leg(workcell, X_WorldTools[i - 1], X_WorldTools[i]).IsReachedThroughout()) return false;
  }
  return true;
}

}  // namespace

bool IsReached(const Workcell& workcell, const Pose& X_WorldTool) {
  const auto solutions = workcell.arm().Inverse(workcell.FlangeFor(X_WorldTool), workcell.home());
  return std::ranges::any_of(solutions, [&](const auto& solution) {
    return workcell.arm().NearestInRange(solution.q, workcell.home()).has_value();
  });
}

bool CanFollow(const Workcell& workcell, const Matrix3& R_WorldTool,
               std::span<const Vector3> corners) {
  std::vector<Pose> X_WorldTools;
  for (const Vector3& corner : corners) X_WorldTools.push_back(PoseOf(R_WorldTool, corner));
  if (!workcell.rules().keeps_configuration) return IsReachedAlong(workcell, X_WorldTools);
  return ReachAlong(workcell, X_WorldTools).start.has_value();
}

PathReach ReachAlong(const Workcell& workcell, std::span<const Pose> X_WorldTools) {
  ASSAY_CHECK(!X_WorldTools.empty());
  PathReach reach;
  for (const Configuration& start : StartsAt(workcell, X_WorldTools[0])) {
    Configuration configuration = start;
    std::size_t reached = 1;
    while (reached < X_WorldTools.size() &&
           Leg(workcell, X_WorldTools[reached - 1], X_WorldTools[reached]).Follow(configuration)) {
      ++reached;
    }
    reach.reached = std::max(reach.reached, reached);
    if (reached < X_WorldTools.size()) continue;
    reach.start = start.q;
    break;
  }
  return reach;
}

}  // namespace assay::domain
