#include "planner/assembly/travel/work_lines.h"

#include "planner/geometry/pose.h"
#include "planner/motion/paths/straight_line.h"

namespace assay::assembly {
namespace {

using geometry::Pose;
using geometry::Vector3;

constexpr double kSameOrientation = 1e-9;

bool IsTurned(const domain::Workcell& workcell, const Pose& X_WorldTool,
              const kinematics::JointVector& q) {
  return geometry::AngleBetween(motion::ToolAt(workcell, q).linear(), X_WorldTool.linear()) >
         kSameOrientation;
}

// Returns the farthest pose to which a guarded move may lead the tool beyond its work.
Pose Beyond(const domain::Workcell& workcell, const plan::ToolRoute& route) {
  const Pose& work = route.to_work.back();
  const Vector3 way = work.translation() - route.poised.translation();
  return geometry::Translation(workcell.rules().guarded_travel * way.normalized()) * work;
}

}  // namespace

bool IsGuarded(const plan::Action& action) { return action.kind->Needs(domain::Need::kHolding); }

std::optional<WorkLines> FollowWork(const domain::Workcell& workcell, const plan::ToolRoute& route,
                                    bool is_guarded, const kinematics::JointVector& poised) {
  std::vector<Pose> poses = route.to_work;
  if (is_guarded) {
    poses.push_back(Beyond(workcell, route));
    poses.push_back(route.to_work.back());
  }
  poses.insert(poses.end(), route.away.begin(), route.away.end());
  WorkLines sections = {{poised}};
  for (const Pose& pose : poses) {
    if (!IsTurned(workcell, pose, sections.back().back())) {
      if (!AppendLine(workcell, pose, sections.back())) return std::nullopt;
      continue;
    }
    const auto q = motion::NearestPosture(workcell, pose, sections.back().back());
    if (!q) return std::nullopt;
    sections.push_back({*q});
  }
  return sections;
}

std::optional<motion::Obstruction> FindObstruction(motion::MotionCheck& check,
                                                   const motion::JointPath& path) {
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    if (auto obstruction = check.FindObstruction(path[i], path[i + 1])) return obstruction;
  }
  return std::nullopt;
}

bool AppendLine(const domain::Workcell& workcell, const Pose& X_WorldTool,
                motion::JointPath& path) {
  const auto line =
      motion::FollowLine(workcell, path.back(), X_WorldTool.translation(), kWorkLineStep);
  if (line.path) path.insert(path.end(), line.path->q.begin() + 1, line.path->q.end());
  return line.path.has_value();
}

}  // namespace assay::assembly
