#include "planner/motion/handling/part_reach.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <variant>

#include "planner/domain/reachability/reachability.h"
#include "planner/domain/reachability/tool_path.h"
#include "planner/geometry/pose.h"
#include "planner/motion/collision/swept_volume.h"
#include "planner/motion/paths/path_search.h"
#include "planner/motion/paths/straight_line.h"

namespace assay::motion {
namespace {

const MotionRules kWay = {.clearance = 0.01};  // metres
// The rules for the work, in which hand and fingers come near the table. The clearance is in
// metres.
const MotionRules kWork = {.clearance = 0.001};
constexpr SweepAccuracy kVolume = {.sagitta = 0.0005};
constexpr double kWayStep = 0.02;  // metres

// Returns three poses of the tool: at the grasp, at the end of its retreat along its own axis, and
// straight above this end at safe height.
std::array<Pose, 3> WayOut(const domain::Workcell& workcell, const Pose& X_WorldTool) {
  const Pose retreated =
      X_WorldTool * geometry::Translation(0, 0, -workcell.rules().approach_distance);
  Pose above = retreated;
  above.translation().z() = std::max(above.translation().z(), workcell.rules().safe_height);
  return {X_WorldTool, retreated, above};
}

// Returns the path of the arm that begins at the posture and leads the tool along straight lines
// through the poses. Returns none if the arm cannot follow the lines.
std::optional<JointPath> Along(const domain::Workcell& workcell, const JointVector& from,
                               std::span<const Pose> way) {
  JointPath path = {from};
  for (const Pose& X_WorldTool : way) {
    const LineResult line = FollowLine(workcell, path.back(), X_WorldTool.translation(), kWayStep);
    if (!line.path) return std::nullopt;
    path.insert(path.end(), line.path->q.begin() + 1, line.path->q.end());
  }
  return path;
}

}  // namespace

bool CanServe(const domain::Problem& problem, PartId part, GraspId grasp, const Pose& X_WorldPart) {
  if (!domain::IsReachableAt(problem, part, grasp, X_WorldPart)) return false;
  const domain::Workcell& workcell = *problem.workcell;
  const domain::Grasp& chosen = (*problem.part(part).grasps)[grasp.index()];
  std::array<Pose, 3> way = WayOut(workcell, X_WorldPart * chosen.X_PartTool);
  const domain::PathReach from_grasp = ReachAlong(workcell, way);
  if (!from_grasp.start) return false;
  const auto out = Along(workcell, *from_grasp.start, std::span(way).subspan(1));
  std::ranges::reverse(way);
  const domain::PathReach from_above = ReachAlong(workcell, way);
  if (!out || !from_above.start) return false;
  const CollisionScene scene(problem, {.opening = workcell.gripper().max_opening()});
  if (MotionCheck(scene, kWork).FindObstruction(*from_grasp.start, *from_grasp.start)) return false;
  if (InTheWay(scene, SweptVolume(scene, *out, kVolume), kWork.clearance)) return false;
  const PathResult path =
      FindPath(scene, {.from = workcell.home(), .to = *from_above.start, .rules = kWay});
  return std::holds_alternative<JointPath>(path);
}

std::string WhyNotServed(const domain::Problem& problem, PartId part, const Pose& X_WorldPart) {
  std::vector<domain::GraspConditions> broken;
  for (std::size_t i = 0; i < problem.part(part).grasps->size(); ++i) {
    broken.push_back(BrokenAt(problem, part, GraspId(i), X_WorldPart));
  }
  std::vector<std::string> reasons;
  const auto add = [&](std::int64_t grasps, const std::string& what) {
    if (grasps > 0) reasons.push_back(fmt::format("{} for {}", what, grasps));
  };
  for (const domain::GraspCondition condition : domain::kGraspConditions) {
    const auto breaks = [condition](domain::GraspConditions all) {
      return (all & static_cast<domain::GraspConditions>(condition)) != 0;
    };
    add(std::ranges::count_if(broken, breaks), Describe(problem, condition));
  }
  add(std::ranges::count(broken, 0), "nothing is in the way of arm and hand");
  return fmt::format("none of its {} grasps works; conditions that are not met: {}", broken.size(),
                     fmt::join(reasons, "; "));
}

GraspId ServingGrasp(const domain::Problem& problem, PartId part, const Pose& X_WorldPart) {
  const std::size_t count = problem.part(part).grasps->size();
  for (std::size_t i = 0; i < count; ++i) {
    if (CanServe(problem, part, GraspId(i), X_WorldPart)) return GraspId(i);
  }
  return GraspId::None();
}

}  // namespace assay::motion
