#include <CLI/CLI.hpp>
#include <filesystem>
#include <limits>
#include <memory>

#include "planner/contingent/grounding/grounding.h"
#include "planner/contingent/knowledge/knowledge_base.h"
#include "planner/contingent/pks_and_pddl/task_file.h"
#include "planner/contingent/plan_tree/tree_file.h"
#include "planner/contingent/search/contingent_planner.h"
#include "planner/contingent/tree_check/tree_check.h"
#include "sim/cli/command_line/console.h"
#include "sim/cli/command_line/progress.h"
#include "sim/cli/command_line/stopwatch.h"
#include "sim/cli/command_line/verb.h"
#include "sim/cli/tasks/output_file.h"
#include "sim/cli/tree_output/contingent_report.h"
#include "sim/cli/tree_output/dot.h"

namespace assay::cli {
namespace contingent_verb {

using contingent::GroundTask;

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
  std::int64_t budget = kKnowledgeStates;
};

// Loads a plan tree from a file that holds the tree alone, or from the output of --json.
contingent::ContingentPlan LoadTree(const std::filesystem::path& file, const GroundTask& task) {
  // This throws if the initial state contradicts itself, as planning does.
  contingent::KnowledgeBase(task).Initial();
  const Document document = Document::Load(file);
  const std::optional<Value> inner = document.root().Find("tree");
  contingent::ContingentPlan plan;
  plan.tree = contingent::ReadTree(inner ? *inner : document.root(), task);
  plan.outcome = Outcome::kFound;
  return plan;
}

ContingentAnswer PlanOrLoad(GroundTask task, const Options& options) {
  if (options.tree.empty()) {
    return PlanFor(std::move(task),
                   options.shortest ? contingent::Wanted::kLeastDepth : contingent::Wanted::kFirst,
                   options.budget);
  }
  ContingentAnswer answer{.task = std::move(task), .plan = {}, .is_from_file = true};
  answer.plan = LoadTree(options.tree, answer.task);
  return answer;
}

ContingentAnswer MakeAnswer(const Options& options) {
  const contingent::Task task = contingent::LoadTask(options.domain, options.problem);
  RequireWritable(options.output);
  const Progress progress("planning " + options.problem.string());
  const Stopwatch stopwatch;
  contingent::Externs externs;
  ContingentAnswer answer =
      PlanOrLoad(contingent::Ground(task.domain, task.problem, externs), options);
  answer.seconds = stopwatch.Seconds();
  if ((options.check || answer.is_from_file) && answer.plan.outcome == Outcome::kFound) {
    answer.check = contingent::CheckTree(answer.task, answer.plan.tree, {.worlds = options.worlds});
  }
  return answer;
}

ExitCode Execute(const Options& options) {
  const ContingentAnswer answer = MakeAnswer(options);
  const bool is_found = answer.plan.outcome == Outcome::kFound;
  std::string text;
  if (options.json) {
    text = JsonText(answer);
  } else if (options.dot && is_found) {
    text = PlanTreeToDot(answer.task, answer.plan.tree);
  } else {
    text = Text(answer, options.unfold, options.budget);
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
                   "find the tree of least depth; only for small problems");
  command.add_flag("--check", options->check,
                   "run the tree in every world that the initial knowledge allows");
  command
      .add_option("--worlds", options->worlds,
                  "up to this many worlds are run one by one; more worlds are run as sets or, if "
                  "sets cannot decide, this many are drawn at random")
      ->check(CLI::Range(1, 100'000'000))
      ->capture_default_str();
  command.add_option("--tree", options->tree,
                     "check the tree in this file, which --json has written, instead of planning");
  command.add_flag("--unfold", options->unfold, "print shared sub-plans in each branch");
  CLI::Option* const json = command.add_flag("--json", options->json, "print the result as JSON");
  command.add_flag("--dot", options->dot, "print the tree for Graphviz")->excludes(json);
  command.add_option("-o,--output", options->output, "write to this file instead of printing");
  command
      .add_option("--budget", options->budget,
                  "limit of knowledge states, counted with repetitions")
      ->check(CLI::Range(1, std::numeric_limits<int>::max()))
      ->capture_default_str();
  return [options] { return Execute(*options); };
}

}  // namespace contingent_verb

const Verb kContingent = {
    .name = "contingent",
    .summary =
        "plans with knowledge that is available only during execution (PKS, contingent PDDL)",
    .page = "planner/contingent-planning.md",
    .example =
        "assay contingent scenarios/know/force-sensing.pks scenarios/know/two-cans.pks "
        "--check\n\nThe page scenarios/know/README.md describes the formats of both files.",
    .declare = contingent_verb::Declare,
};

}  // namespace assay::cli
