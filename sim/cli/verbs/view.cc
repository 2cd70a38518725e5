#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>

#include "planner/base/input_files/input_file.h"
#include "sim/cli/command_line/console.h"
#include "sim/cli/command_line/usage_error.h"
#include "sim/cli/command_line/verb.h"
#include "sim/cli/options/models_folder.h"
#include "sim/cli/page_output/viewed_page.h"
#include "sim/cli/tasks/output_file.h"
#include "sim/cli/tasks/planned_problem.h"
#include "sim/execution/interpretation/knowledge_scenario.h"

namespace assay::cli {
namespace view_verb {

namespace fs = std::filesystem;

struct Options {
  ViewRequest request;
  fs::path page;
};

constexpr std::size_t kMostTraceBytes = std::size_t{1} << 30;

// A database may be too large to be read as a whole.
bool IsDatabase(const fs::path& file) {
  constexpr std::string_view kMark = "SQLite format 3";
  std::array<char, kMark.size()> begin{};
  std::ifstream(file, std::ios::binary).read(begin.data(), begin.size());
  return std::string_view(begin.data(), begin.size()) == kMark;
}

bool IsTrace(std::string_view text) { return text.starts_with(R"({"format":"assay-trace/)"); }

// Only results have no key `format`.
bool IsResult(std::string_view text) {
  return text.starts_with("{") && text.find("\"format\"") == std::string_view::npos;
}

// The options that a kind of input has.
enum class Numbered { kNo, kTrial, kCounterexample };

void RefuseOptions(const ViewRequest& request, Numbered numbered, bool has_leaves) {
  if (request.counterexample && numbered != Numbered::kCounterexample) {
    throw UsageError("view: --counterexample is for databases (see assay view --help)");
  }
  if (request.number && numbered == Numbered::kNo) {
    throw UsageError(
        "view: numbers of trials are for databases, results and plan trees (see assay view "
        "--help)");
  }
  if (request.is_every_leaf && !has_leaves) {
    throw UsageError("view: --worlds is for scenarios whose plan is a tree");
  }
}

ViewedPage Viewed(const ViewRequest& request) {
  if (IsDatabase(request.input)) {
    RefuseOptions(request, Numbered::kCounterexample, false);
    return StoredTrialPage(request);
  }
  const std::string text = ReadInput(
      request.input, "a scenario file, plan file, trace, result or database", kMostTraceBytes);
  if (IsResult(text)) {
    RefuseOptions(request, Numbered::kTrial, false);
    return ResultPage(request);
  }
  if (IsTrace(text)) {
    RefuseOptions(request, Numbered::kNo, false);
    return TracePage(request, text);
  }
  const Document document = Document::Parse(text, request.input.string());
  const bool is_tree = !IsPlanFile(document) && execution::NeedsATree(document);
  RefuseOptions(request, is_tree ? Numbered::kTrial : Numbered::kNo, is_tree);
  return is_tree ? TreePage(request) : PlanPage(request, document);
}

ExitCode Execute(const Options& options) {
  RequireWritable(options.page);
  const ViewedPage page = Viewed(options.request);
  WriteFile(options.page, page.html);
  Print(fmt::format("{}: {:.1f} s in {} kB\n", options.page.string(), page.seconds,
                    (page.html.size() + 500) / 1000));
  return page.code;
}

Execution Declare(CLI::App& command) {
  const auto options = std::make_shared<Options>();
  ViewRequest& request = options->request;
  command
      .add_option("input", request.input,
                  "scenario file or plan file, which is executed once without noise; a trace; the "
                  "database of a sweep; or the result.json of a run under noise")
      ->required();
  const CLI::Range numbers(1, std::numeric_limits<int>::max());
  command
      .add_option("number", request.number,
                  "of the trial in a database; of the trial or counterexample in a result; of the "
                  "trial of a plan tree (1 if left out)")
      ->check(numbers);
  command
      .add_option("--counterexample", request.counterexample,
                  "which one, if the trial of the database is a falsification; the first if left "
                  "out")
      ->check(numbers);
  command
      .add_option_function<std::string>(
          "--worlds",
          [&request](const std::string& worlds) { request.is_every_leaf = worlds == "all"; },
          "of a plan tree: drawn: hidden facts are drawn; all: the trials go through the leaves "
          "and "
          "repeats of the tree in turn")
      ->check(CLI::IsMember({"drawn", "all"}));
  command.add_option("-o,--output", options->page, "HTML file to write")->required();
  command.add_option("--plan", request.plan,
                     "plan file of a trace or a result; plan.json beside it if left out");
  AddModelsOption(command, request.models);
  return [options] { return Execute(*options); };
}

}  // namespace view_verb

const Verb kView = {
    .name = "view",
    .summary = "writes a page that shows an execution in three dimensions, with its certificates",
    .page = "sim/viewing.md",
    .example =
        "assay view scenarios/spar-fig13.yaml -o out/fig13.html\n"
        "  assay view fig15.sqlite 17 -o out/trial-17.html",
    .declare = view_verb::Declare,
};

}  // namespace assay::cli
