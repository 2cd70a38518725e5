#include "sim/cli/tree_output/contingent_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

#include "planner/contingent/plan_tree/tree_file.h"
#include "planner/contingent/plan_tree/tree_text.h"
#include "planner/plan/plan_files/json_layout.h"
#include "sim/cli/command_line/usage_error.h"
#include "sim/cli/tree_output/goal_conflict_text.h"

namespace assay::cli {
namespace {

using Json = nlohmann::ordered_json;
using contingent::ContingentPlan;
using contingent::Guarantee;
using contingent::TreeCheck;
using contingent::TreeSize;

constexpr double kMostUnfolded = 10'000;  // leaves
constexpr int kDeepestPrinted = 1'000;    // depth of nested branches

std::string Word(Guarantee guarantee) {
  switch (guarantee) {
    case Guarantee::kReachesGoal:
      return "reaches the goal";
    case Guarantee::kLeastDepth:
      return "least depth";
    case Guarantee::kIfFair:
      return "reaches the goal if repeats end";
  }
  return "";
}

Json CheckToJson(const TreeCheck& check) {
  Json json = {{"holds", check.holds},
               {"worlds", check.worlds},
               {"all", check.AreAllWorlds()},
               {"drawn", check.were_drawn},
               {"numbers_sampled", check.are_numbers_sampled},
               {"unreached", check.unreached.size()}};
  if (!check.holds) json["failure"] = check.failure;
  return json;
}

// Returns why there is no plan, or why none was found.
std::string RefusalText(const ContingentAnswer& answer, std::int64_t budget) {
  std::string text = answer.conflict ? cli::Text(answer.task, *answer.conflict)
                                     : NotFoundText(answer.plan, budget);
  if (!answer.unserved.empty()) {
    text += fmt::format("No grasp serves:\n  {}\n", fmt::join(answer.unserved, "\n  "));
  }
  return text;
}

}  // namespace

ContingentAnswer PlanFor(contingent::GroundTask task, contingent::Wanted wanted,
                         std::int64_t most) {
  ContingentAnswer answer{.task = std::move(task), .plan = {}};
  Budget budget(most);
  answer.plan = contingent::MakePlan(answer.task, wanted, budget);
  if (answer.plan.outcome == Outcome::kNone) {
    Budget again(most);
    answer.conflict = contingent::FindGoalConflict(answer.task, again);
  }
  return answer;
}

std::string JsonText(const ContingentAnswer& answer) {
  Json json = {{"outcome", Name(answer.plan.outcome, "planned")}};
  if (answer.plan.outcome == Outcome::kFound) {
    const TreeSize size = contingent::SizeOf(answer.plan.tree);
    if (!answer.is_from_file) json["guarantee"] = Word(answer.plan.guarantee);
    json["tree"] = contingent::ToJson(answer.task, answer.plan.tree);
    json["depth"] = size.depth;
    json["leaves"] = size.leaves;
    json["branch_points"] = size.branch_points;
    json["actions"] = size.actions;
    json["nodes"] = size.nodes;
    json["repeats"] = size.repeats;
  }
  if (!answer.plan.doubt.empty()) json["doubt"] = answer.plan.doubt;
  if (answer.conflict) json["conflict"] = cli::ToJson(answer.task, *answer.conflict);
  if (answer.plan.outcome != Outcome::kFound && !answer.unserved.empty()) {
    json["not_served"] = answer.unserved;
  }
  if (answer.check) json["check"] = CheckToJson(*answer.check);
  json["expanded"] = answer.plan.states;
  json["seconds"] = answer.seconds;
  return plan::JsonText(json);
}

std::string Text(const TreeCheck& check) {
  if (!check.holds) return fmt::format("check: FAILS: {}\n", check.failure);
  return fmt::format(
      "check: holds in {} of the worlds that the initial knowledge allows, as {} {}{}{}\n",
      check.AreAllWorlds() ? "all" : "a sample", check.worlds, check.worlds == 1 ? "case" : "cases",
      check.are_numbers_sampled ? ", with a sample of the numbers" : "",
      check.unreached.empty() ? "" : fmt::format(", {} nodes unreached", check.unreached.size()));
}

std::string Text(const ContingentAnswer& answer, bool unfolds, std::int64_t budget) {
  const ContingentPlan& plan = answer.plan;
  if (plan.outcome != Outcome::kFound) return RefusalText(answer, budget);
  const TreeSize size = contingent::SizeOf(plan.tree);
  if (unfolds && size.leaves > kMostUnfolded) {
    throw UsageError(
        fmt::format("contingent: --unfold: the tree has {} leaves; at most {} can be printed",
                    size.leaves, kMostUnfolded));
  }
  std::string text =
      size.nesting > kDeepestPrinted
          ? fmt::format(
                "The tree has {} nested branches; at most {} are printed as text. --json prints "
                "the whole tree.\n",
                size.nesting, kDeepestPrinted)
          : TextOf(answer.task, plan.tree,
                   unfolds ? contingent::Sharing::kUnfolded : contingent::Sharing::kOnce);
  text += fmt::format(
      "depth {}, {} leaves, {} branch points, {} actions in {} nodes; {}; {} knowledge states\n",
      size.depth, size.leaves, size.branch_points, size.actions, size.nodes,
      answer.is_from_file ? "from a file" : Word(plan.guarantee), plan.states);
  if (answer.check) text += Text(*answer.check);
  return text;
}

}  // namespace assay::cli
