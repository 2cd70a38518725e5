#include "planner/domain/problem/goal_file.h"

#include <fmt/format.h>

#include <algorithm>

#include "planner/domain/matings/mating_file.h"
#include "planner/domain/problem/name.h"
#include "planner/domain/problem/part_name.h"
#include "planner/domain/resting/stable_pose_names.h"

namespace assay::domain {
namespace {

LocatedGoal ReadLocated(const Value& located, const Problem& problem) {
  located.AllowOnly({"part", "stable"});
  LocatedGoal goal;
  goal.part = ReadPartName(located.At("part"), problem);
  for (const Goal& other : problem.goals) {
    const auto* other_located = std::get_if<LocatedGoal>(&other);
    if (other_located == nullptr || other_located->part != goal.part) continue;
    located.At("part").Fail(
        fmt::format("part '{}' is located by two goals", problem.part(goal.part).name),
        "one goal with all its stable poses");
  }
  const Value stable = located.At("stable");
  const StablePoseNames names(*problem.part(goal.part).model);
  for (const Value& item : stable.Items()) goal.stable_poses.push_back(names.Read(item));
  if (goal.stable_poses.empty()) stable.Fail("no stable pose", "at least one");
  return goal;
}

void ReadGoal(const Value& goal, const Units& units, Problem& problem) {
  goal.AllowOnly({"assembled", "located"});
  if (goal.Entries().size() != 1) {
    goal.Fail(fmt::format("a goal with {} keys", goal.Entries().size()),
              "one of assembled, located");
  }
  if (const auto assembled = goal.Find("assembled")) {
    const MatingId id = AddMating(*assembled, units, problem);
    if (std::ranges::find(problem.goals, Goal(id)) != problem.goals.end()) {
      assembled->Fail("this goal is given twice", "each goal once");
    }
    const bool is_to_be_made = std::ranges::count(problem.assembled, id) == 0;
    if (is_to_be_made) RequireShaftInHole(*assembled, problem, id);
    problem.goals.emplace_back(id);
  } else {
    problem.goals.emplace_back(ReadLocated(goal.At("located"), problem));
  }
}

}  // namespace

void ReadGoals(const Value& goals, const Units& units, Problem& problem) {
  const std::vector<Value> items = goals.Items();
  if (items.empty()) goals.Fail("there is no goal", "at least one of assembled, located");
  for (const Value& item : items) ReadGoal(item, units, problem);
}

}  // namespace assay::domain
