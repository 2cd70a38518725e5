#include "sim/cli/shown_executions/shown_execution.h"

#include <fmt/format.h>

#include <array>
#include <fstream>

#include "planner/base/input_files/input_file.h"
#include "sim/cli/command_line/usage_error.h"
#include "sim/cli/tasks/planned_problem.h"
#include "sim/execution/interpretation/knowledge_scenario.h"

namespace assay::cli {
namespace {

constexpr std::size_t kMostTraceBytes = std::size_t{1} << 30;

// A database may be too large to be read as a whole.
bool IsDatabase(const std::filesystem::path& file) {
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

void RefuseOptions(const ShowRequest& request, Numbered numbered, bool has_leaves) {
  const auto refuse = [&](std::string_view what) {
    throw UsageError(fmt::format("{0}: {1} (see assay {0} --help)", request.verb, what));
  };
  if (request.counterexample && numbered != Numbered::kCounterexample) {
    refuse("--counterexample is for databases");
  }
  if (request.number && numbered == Numbered::kNo) {
    refuse("numbers of trials are for databases, results and plan trees");
  }
  if (request.is_every_leaf && !has_leaves) {
    refuse("--worlds is for scenarios whose plan is a tree");
  }
}

}  // namespace

ShownExecution ExecutionOf(const ShowRequest& request) {
  if (IsDatabase(request.input)) {
    RefuseOptions(request, Numbered::kCounterexample, false);
    return StoredTrialExecution(request);
  }
  const std::string text = ReadInput(
      request.input, "a scenario file, plan file, trace, result or database", kMostTraceBytes);
  if (IsResult(text)) {
    RefuseOptions(request, Numbered::kTrial, false);
    return ResultExecution(request);
  }
  if (IsTrace(text)) {
    RefuseOptions(request, Numbered::kNo, false);
    return TraceExecution(request, text);
  }
  const Document document = Document::Parse(text, request.input.string());
  const bool is_tree = !IsPlanFile(document) && execution::NeedsATree(document);
  RefuseOptions(request, is_tree ? Numbered::kTrial : Numbered::kNo, is_tree);
  return is_tree ? TreeExecution(request) : PlanExecution(request, document);
}

}  // namespace assay::cli
