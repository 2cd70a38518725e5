#include "planner/assembly/travel/work_judge.h"

#include <algorithm>

#include "planner/assembly/travel/travel_search.h"
#include "planner/assembly/travel/work_lines.h"
#include "planner/motion/paths/travel.h"
#include "planner/plan/data/tool_route.h"

namespace assay::assembly {
namespace {

bool IsFree(const motion::CollisionScene& scene, const WorkLines& lines) {
  const motion::MotionRules rules{.clearance = kTravelClearance,
                                  .bodies = motion::MotionRules::Bodies::kArm};
  motion::MotionCheck check(scene, rules);
  return std::ranges::none_of(lines, [&](const motion::JointPath& line) {
    return FindObstruction(check, line).has_value();
  });
}

bool AnyPostureWorks(const domain::Problem& problem, const plan::Action& action) {
  const domain::Workcell& workcell = *problem.workcell;
  const plan::ToolRoute route = plan::RouteOf(problem, action, nullptr, action.place.X_WorldPart);
  const motion::CollisionScene scene(problem, {.opening = workcell.gripper().max_opening()});
  const auto postures = motion::PosturesAt(workcell, route.poised, workcell.home());
  return std::ranges::any_of(postures, [&](const kinematics::JointVector& poised) {
    const auto lines = FollowWork(workcell, route, IsGuarded(action), poised);
    return lines && IsFree(scene, *lines);
  });
}

}  // namespace

constraint_posting::Judgement WorkJudge::operator()(std::span<const plan::Action> actions) {
  const plan::Action& last = actions.back();
  if (CanWork(last)) return {.snapshots = 1};
  return {.objections = {{.action = static_cast<int>(actions.size()) - 1,
                          .parts = plan::PartsOf(problem_, last),
                          .place = true,
                          .why = "the arm cannot follow the straight lines of the work"}},
          .snapshots = 1};
}

// A strategy of fine motion, which is planned later, may enter a hole by other lines.
bool WorkJudge::CanWork(const plan::Action& action) {
  if (plan::HoldIn(action) == nullptr || !plan::FixedPart(problem_, action).IsNone()) return true;
  for (const auto& [known, can_work] : known_) {
    if (known == action) return can_work;
  }
  known_.emplace_back(action, AnyPostureWorks(problem_, action));
  return known_.back().second;
}

}  // namespace assay::assembly
