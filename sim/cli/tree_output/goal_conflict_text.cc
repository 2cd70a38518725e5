#include "sim/cli/tree_output/goal_conflict_text.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "planner/contingent/grounding/ground_query.h"

namespace assay::cli {

std::string Text(const contingent::GroundTask& task, const contingent::GoalConflict& conflict) {
  std::string text = fmt::format(
      "There is no plan. No tree of these actions, with or without repeats, is sure to reach {}:\n",
      conflict.parts.size() == 1 ? "this part of the goal" : "these parts of the goal");
  for (const contingent::GroundQuery& part : conflict.parts) {
    text += "  " + TextOf(task, part) + "\n";
  }
  if (!conflict.is_minimal) text += "  (some of these parts alone may be unreachable already)\n";
  return text;
}

std::string NotFoundText(const contingent::ContingentPlan& plan, std::int64_t budget) {
  if (plan.doubt.empty()) return fmt::format("No plan within {} knowledge states.\n", budget);
  return fmt::format("No plan was found. This does not prove that there is none: {}.\n",
                     plan.doubt);
}

nlohmann::ordered_json ToJson(const contingent::GroundTask& task,
                              const contingent::GoalConflict& conflict) {
  nlohmann::ordered_json parts = nlohmann::ordered_json::array();
  for (const contingent::GroundQuery& part : conflict.parts) parts.push_back(TextOf(task, part));
  return {{"goal", std::move(parts)}, {"minimal", conflict.is_minimal}};
}

}  // namespace assay::cli
