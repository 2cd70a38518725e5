#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "planner/contingent/grounding/ground_task.h"
#include "planner/contingent/search/contingent_planner.h"
#include "planner/contingent/search/goal_conflict.h"
#include "planner/contingent/tree_check/tree_check_result.h"

namespace assay::cli {

// The number of knowledge states that contingent planning may examine, if nothing else is asked
// for.
inline constexpr std::int64_t kKnowledgeStates = 10'000'000;

// The result of contingent planning, and how it was obtained.
struct ContingentAnswer {
  contingent::GroundTask task;
  contingent::ContingentPlan plan;
  bool is_from_file = false;
  std::optional<contingent::TreeCheck> check = {};
  std::optional<contingent::GoalConflict> conflict = {};  // if there is no plan
  // For tasks of a scenario: the parts that no grasp serves (execution::Interpretation). They may
  // be the reason why no plan was found.
  std::vector<std::string> unserved = {};
  double seconds = 0;
};

// Plans for a task within a budget of knowledge states. If there is no plan, finds the parts of the
// goal that conflict.
ContingentAnswer PlanFor(contingent::GroundTask task, contingent::Wanted wanted,
                         std::int64_t budget);

std::string JsonText(const ContingentAnswer& answer);  // by sim/cli/verbs/contingent.schema.json
// Returns whether the tree holds, and in which worlds.
std::string Text(const contingent::TreeCheck& check);
// Returns the tree, or why there is none. `unfolds`: shared sub-plans are shown in each branch.
// Throws UsageError if the unfolded tree is too large.
std::string Text(const ContingentAnswer& answer, bool unfolds, std::int64_t budget);

}  // namespace assay::cli
