#include "planner/plan/checker/straight_reach.h"

#include <fmt/format.h>

#include <cmath>

#include "planner/geometry/pose.h"
#include "planner/plan/checker/world_state.h"

namespace assay::plan {
namespace {

using kinematics::Arm;
using kinematics::JointVector;

constexpr double kLimitRounding = 1e-9;                 // radians
constexpr double kGreatestJointStep = 20 * M_PI / 180;  // radians, between poses of a line

class LineFollower {
 public:
  explicit LineFollower(const domain::Workcell& workcell)
      : arm_(workcell.arm()),
        X_BaseWorld_(workcell.X_WorldBase().inverse()),
        X_ToolFlange_(workcell.gripper().X_FlangeTool().inverse()) {}

  std::vector<JointVector> JointVectorsAt(const Pose& X_WorldTool) const {
    const Pose X_BaseFlange = FlangeFor(X_WorldTool);
    std::vector<JointVector> found;
    for (const kinematics::InverseSolution& solution : arm_.Inverse(X_BaseFlange)) {
      for (const JointVector& q : arm_.Representatives(solution.q)) {
        if (Attains(q, X_BaseFlange)) found.push_back(q);
      }
    }
    return found;
  }

  // Returns the index of the first pose of the line that cannot be reached continuously from q at
  // its start. Returns the line's size if all can be reached.
  std::size_t Follow(JointVector q, const ToolLine& line) const {
    for (std::size_t i = 1; i < line.size(); ++i) {
      const std::optional<JointVector> next = Nearest(FlangeFor(line[i]), q);
      if (!next) return i;
      q = *next;
    }
    return line.size();
  }

 private:
  Pose FlangeFor(const Pose& X_WorldTool) const {
    return X_BaseWorld_ * X_WorldTool * X_ToolFlange_;
  }

  bool Attains(const JointVector& q, const Pose& X_BaseFlange) const {
    for (int joint = 0; joint < 6; ++joint) {
      const kinematics::JointLimits& limits = arm_.limits()[static_cast<std::size_t>(joint)];
      const bool within =
          q[joint] >= limits.lower - kLimitRounding && q[joint] <= limits.upper + kLimitRounding;
      if (!within) return false;
    }
    return PosesAgree(arm_.Forward(q), X_BaseFlange);
  }

  std::optional<JointVector> Nearest(const Pose& X_BaseFlange, const JointVector& from) const {
    std::optional<JointVector> nearest;
    double least = kGreatestJointStep;
    for (const kinematics::InverseSolution& solution : arm_.Inverse(X_BaseFlange, from)) {
      const std::optional<JointVector> q = arm_.NearestInRange(solution.q, from);
      if (!q || !Attains(*q, X_BaseFlange)) continue;
      const double step = (*q - from).cwiseAbs().maxCoeff();
      if (step > least) continue;
      least = step;
      nearest = q;
    }
    return nearest;
  }

  const Arm& arm_;
  Pose X_BaseWorld_;
  Pose X_ToolFlange_;
};

}  // namespace

ToolLine LineFrom(const Pose& X_WorldTool, const geometry::Vector3& displacement, int intervals) {
  ToolLine line;
  for (int i = 0; i <= intervals; ++i) {
    line.push_back(geometry::Translation(displacement * i / intervals) * X_WorldTool);
  }
  return line;
}

std::optional<std::string> WhyOutOfReach(const domain::Workcell& workcell,
                                         std::span<const ToolLine> lines) {
  const LineFollower follower(workcell);
  const Pose& start = lines.front().front();
  const std::vector<JointVector> postures = follower.JointVectorsAt(start);
  if (postures.empty()) {
    return fmt::format(
        "the arm does not reach the tool pose at {}: no joint vector within its "
        "limits",
        InMillimetres(start.translation()));
  }
  geometry::Vector3 stuck_at = start.translation();
  for (const JointVector& q : postures) {
    bool follows_all = true;
    for (const ToolLine& line : lines) {
      const std::size_t end = follower.Follow(q, line);
      if (end == line.size()) continue;
      follows_all = false;
      stuck_at = line[end].translation();
    }
    if (follows_all) return std::nullopt;
  }
  return fmt::format(
      "the arm reaches the tool pose at {} in {} ways, but none goes on "
      "continuously along the straight line past {}",
      InMillimetres(start.translation()), postures.size(), InMillimetres(stuck_at));
}

}  // namespace assay::plan
