#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "planner/contingent/format/task_file.h"
#include "planner/contingent/grounding/ground_query.h"
#include "planner/contingent/grounding/grounding.h"
#include "planner/contingent/knowledge/knowledge_base.h"
#include "planner/contingent/search/contingent_planner.h"
#include "planner/contingent/search/goal_conflict.h"
#include "planner/contingent/tree/tree_check.h"
#include "planner/contingent/tree/tree_file.h"
#include "planner/contingent/tree/tree_text.h"
#include "planner/plan/file/json_layout.h"
#include "sim/cli/plans/dot.h"
#include "sim/cli/plans/goal_conflict_text.h"
#include "sim/cli/program/console.h"
#include "sim/cli/program/progress.h"
#include "sim/cli/program/stopwatch.h"
#include "sim/cli/program/usage_error.h"
#include "sim/cli/program/verb.h"
#include "sim/cli/work/output_file.h"

namespace assay::cli {
namespace know_verb {

using Json = nlohmann::ordered_json;
using contingent::ContingentPlan;
using contingent::GoalConflict;
using contingent::GroundQuery;
using contingent::GroundTask;
using contingent::Guarantee;
using contingent::TreeCheck;
using contingent::TreeSize;

constexpr double kMostUnfolded = 10'000;  // leaves
constexpr int kDeepestTold = 1'000;       // depth of nested branches

struct Options {
  std::filesystem::path domain;
  std::filesystem::path problem;
  std::filesystem::path output;
  std::filesystem::path tree;  // a plan tree to check instead of planning
  bool shortest = false;
  bool json = false;
  bool dot = false;
  bool unfold = false;
  bool check = false;
  std::int64_t worlds = contingent::TreeCheckOptions{}.worlds;
  std::int64_t budget = 10'000'000;
};

// The result of planning, and how it was obtained.
struct Answer {
  GroundTask task;
  ContingentPlan plan;
  bool is_from_file = false;
  std::optional<TreeCheck> check;
  std::optional<GoalConflict> conflict;  // if there is no plan
  double seconds = 0;
};

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

std::string Word(Outcome outcome) {
  switch (outcome) {
    case Outcome::kFound:
      return "planned";
    case Outcome::kNone:
      return "none";
    case Outcome::kBudget:
      return "budget";
  }
  return "";
}

// Loads a plan tree from a file that holds the tree alone, or from the output of --json.
ContingentPlan LoadTree(const std::filesystem::path& file, const GroundTask& task) {
  // This throws if the initial state contradicts itself, as planning does.
  contingent::KnowledgeBase(task).Initial();
  const Document document = Document::Load(file);
  const std::optional<Value> inner = document.root().Find("tree");
  ContingentPlan plan;
  plan.tree = contingent::ReadTree(inner ? *inner : document.root(), task);
  plan.outcome = Outcome::kFound;
  return plan;
}

ContingentPlan PlanOrLoad(const GroundTask& task, const Options& options) {
  if (!options.tree.empty()) return LoadTree(options.tree, task);
  Budget budget(options.budget);
  return contingent::MakePlan(
      task, options.shortest ? contingent::Wanted::kLeastDepth : contingent::Wanted::kFirst,
      budget);
}

Answer MakeAnswer(const Options& options) {
  const contingent::Task task = contingent::LoadTask(options.domain, options.problem);
  RequireWritable(options.output);
  const Progress progress("planning " + options.problem.string());
  const Stopwatch stopwatch;
  contingent::Externs externs;
  Answer answer;
  answer.task = contingent::Ground(task.domain, task.problem, externs);
  answer.plan = PlanOrLoad(answer.task, options);
  answer.is_from_file = !options.tree.empty();
  if (answer.plan.outcome == Outcome::kNone) {
    Budget budget(options.budget);
    answer.conflict = contingent::FindGoalConflict(answer.task, budget);
  }
  answer.seconds = stopwatch.Seconds();
  if ((options.check || answer.is_from_file) && answer.plan.outcome == Outcome::kFound) {
    answer.check = contingent::CheckTree(answer.task, answer.plan.tree, {.worlds = options.worlds});
  }
  return answer;
}

Json ToJson(const TreeCheck& check) {
  Json json = {{"holds", check.holds},
               {"worlds", check.worlds},
               {"all", check.AreAllWorlds()},
               {"drawn", check.were_drawn},
               {"numbers_sampled", check.are_numbers_sampled},
               {"unreached", check.unreached.size()}};
  if (!check.holds) json["failure"] = check.failure;
  return json;
}

std::string JsonText(const Answer& answer) {
  Json json = {{"outcome", Word(answer.plan.outcome)}};
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
  if (answer.check) json["check"] = ToJson(*answer.check);
  json["expanded"] = answer.plan.states;
  json["seconds"] = answer.seconds;
  return plan::JsonText(json);
}

std::string CheckText(const TreeCheck& check) {
  if (!check.holds) return fmt::format("check: FAILS: {}\n", check.failure);
  return fmt::format(
      "check: holds in {} of the worlds that the initial knowledge allows, as {} {}{}{}\n",
      check.AreAllWorlds() ? "all" : "a sample", check.worlds, check.worlds == 1 ? "case" : "cases",
      check.are_numbers_sampled ? ", of their numbers a sample" : "",
      check.unreached.empty() ? "" : fmt::format(", {} nodes unreached", check.unreached.size()));
}

std::string PlanText(const Answer& answer, const Options& options) {
  const ContingentPlan& plan = answer.plan;
  if (plan.outcome == Outcome::kNone) return cli::Text(answer.task, *answer.conflict);
  if (plan.outcome == Outcome::kBudget) return NotFoundText(plan, options.budget);
  const TreeSize size = contingent::SizeOf(plan.tree);
  if (options.unfold && size.leaves > kMostUnfolded) {
    throw UsageError(fmt::format("know: --unfold: the tree has {} leaves; at most {} are told",
                                 size.leaves, kMostUnfolded));
  }
  std::string text =
      size.nesting > kDeepestTold
          ? fmt::format("The tree has {} branches in each other; as text at most {} are told.\n",
                        size.nesting, kDeepestTold)
          : TextOf(answer.task, plan.tree,
                   options.unfold ? contingent::Sharing::kUnfolded : contingent::Sharing::kOnce);
  text += fmt::format(
      "depth {}, {} leaves, {} branch points, {} actions in {} nodes; {}; {} knowledge states\n",
      size.depth, size.leaves, size.branch_points, size.actions, size.nodes,
      answer.is_from_file ? "from a file" : Word(plan.guarantee), plan.states);
  if (answer.check) text += CheckText(*answer.check);
  return text;
}

ExitCode Execute(const Options& options) {
  const Answer answer = MakeAnswer(options);
  const bool is_found = answer.plan.outcome == Outcome::kFound;
  std::string text;
  if (options.json) {
    text = JsonText(answer);
  } else if (options.dot && is_found) {
    text = PlanTreeToDot(answer.task, answer.plan.tree);
  } else {
    text = PlanText(answer, options);
  }
  if (options.output.empty()) {
    Print(text);
  } else {
    WriteFile(options.output, text);
  }
  if (answer.check && !answer.check->holds) return ExitCode::kFailed;
  return ExitCodeOf(answer.plan.outcome);
}

Execution Declare(CLI::App& command) {
  const auto options = std::make_shared<Options>();
  command.add_option("domain", options->domain, "domain, .pks or .pddl")->required();
  command.add_option("problem", options->problem, "problem in the same language")->required();
  command.add_flag("--shortest", options->shortest,
                   "the tree of least depth; looks at all states that are near enough");
  command.add_flag("--check", options->check,
                   "run the tree in every world that the initial knowledge allows");
  command
      .add_option("--worlds", options->worlds,
                  "how many worlds to run one by one; of more, all as sets, or as many drawn")
      ->check(CLI::Range(1, 100'000'000))
      ->capture_default_str();
  command.add_option("--tree", options->tree, "check this tree, of --json, instead of planning");
  command.add_flag("--unfold", options->unfold, "tell shared sub-plans in each branch");
  CLI::Option* const json = command.add_flag("--json", options->json, "print the result as JSON");
  command.add_flag("--dot", options->dot, "print the tree for Graphviz")->excludes(json);
  command.add_option("-o,--output", options->output, "write to this file instead of printing");
  command.add_option("--budget", options->budget, "how often to look at a knowledge state")
      ->check(CLI::Range(1, std::numeric_limits<int>::max()))
      ->capture_default_str();
  return [options] { return Execute(*options); };
}

}  // namespace know_verb

const Verb kKnow = {
    .name = "know",
    .summary = "plans with what will be known only during execution (PKS, contingent PDDL)",
    .example =
        "assay know scenarios/know/force-sensing.pks scenarios/know/two-cans.pks --check\n"
        "  The format is described in scenarios/know/README.md.",
    .declare = know_verb::Declare,
};

}  // namespace assay::cli
