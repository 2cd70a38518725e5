#include "planner/motion/paths/straight_line.h"

#include <algorithm>
#include <cmath>

namespace assay::motion {
namespace {

using kinematics::Indicators;
using kinematics::InverseSolution;

// Greatest turn of a joint, radians, in a step of a centimetre or less.
constexpr double kGreatestTurn = 0.2;
constexpr double kCentimetre = 0.01;       // metres; in longer steps joints may turn more
constexpr double kSameJointValues = 1e-6;  // radians

class LineFollower {
 public:
  LineFollower(const domain::Workcell& workcell, const Pose& X_WorldTool, double step)
      : workcell_(workcell),
        X_WorldTool_(X_WorldTool),
        greatest_turn_(kGreatestTurn * std::max(1.0, step / kCentimetre)) {}

  // Returns the indicators of the arm's configuration: those of the inverse solution that equals q.
  // Returns none if no solution equals q.
  std::optional<Indicators> ConfigurationAt(const JointVector& q) const {
    for (const InverseSolution& s : SolutionsAt(X_WorldTool_.translation(), q)) {
      const auto nearest = workcell_.arm().NearestInRange(s.q, q);
      if (nearest && (*nearest - q).cwiseAbs().maxCoeff() < kSameJointValues) return s.indicators;
    }
    return std::nullopt;
  }

  std::optional<JointVector> Next(const Vector3& p_World, const Indicators& configuration,
                                  const JointVector& q) const {
    for (const InverseSolution& s : SolutionsAt(p_World, q)) {
      if (s.indicators != configuration) continue;
      const auto nearest = workcell_.arm().NearestInRange(s.q, q);
      if (nearest && (*nearest - q).cwiseAbs().maxCoeff() < greatest_turn_) return nearest;
    }
    return std::nullopt;
  }

 private:
  kinematics::InverseSolutions SolutionsAt(const Vector3& p_World, const JointVector& near) const {
    Pose X_WorldTool = X_WorldTool_;
    X_WorldTool.translation() = p_World;
    return workcell_.arm().Inverse(workcell_.FlangeFor(X_WorldTool), near);
  }

  const domain::Workcell& workcell_;
  Pose X_WorldTool_;
  double greatest_turn_;
};

}  // namespace

Pose ToolAt(const domain::Workcell& workcell, const JointVector& q) {
  return workcell.X_WorldBase() * workcell.arm().Forward(q) * workcell.gripper().X_FlangeTool();
}

std::optional<JointVector> NearestPosture(const domain::Workcell& workcell, const Pose& X_WorldTool,
                                          const JointVector& near) {
  std::optional<JointVector> nearest;
  for (const auto& s : workcell.arm().Inverse(workcell.FlangeFor(X_WorldTool), near)) {
    const auto q = workcell.arm().NearestInRange(s.q, near);
    if (!q) continue;
    if (!nearest || (*q - near).norm() < (*nearest - near).norm()) nearest = *q;
  }
  return nearest;
}

std::optional<JointVector> PostureLike(const domain::Workcell& workcell, const Pose& X_WorldTool,
                                       const JointVector& like) {
  const kinematics::Arm& arm = workcell.arm();
  const auto q = arm.Inverse(workcell.FlangeFor(X_WorldTool), arm.IndicatorsOf(like), like);
  if (!q) return std::nullopt;
  const JointVector nearest = kinematics::NearestByTurns(*q, like);
  if (!arm.InRange(nearest)) return std::nullopt;
  return nearest;
}

LineResult FollowLine(const domain::Workcell& workcell, const JointVector& from, const Vector3& end,
                      double step) {
  const Pose X_WorldTool = ToolAt(workcell, from);
  const Vector3 start = X_WorldTool.translation();
  const LineFollower follower(workcell, X_WorldTool, step);
  const std::optional<Indicators> configuration = follower.ConfigurationAt(from);
  if (!configuration) return {std::nullopt, start};
  const double length = (end - start).norm();
  const int steps = std::max(2, static_cast<int>(std::ceil(length / step)));
  LinePath path{.step = length / steps, .q = {from}};
  for (int i = 1; i <= steps; ++i) {
    const Vector3 p = start + static_cast<double>(i) / steps * (end - start);
    const auto q = follower.Next(p, *configuration, path.q.back());
    if (!q) return {std::nullopt, p};
    path.q.push_back(*q);
  }
  return {path, end};
}

}  // namespace assay::motion
