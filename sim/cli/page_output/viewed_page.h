#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "planner/base/input_files/document.h"
#include "planner/domain/workcell/model_path.h"
#include "sim/cli/command_line/exit_code.h"
#include "sim/view/page.h"

namespace assay::cli {

// What `assay view` is asked for.
struct ViewRequest {
  std::filesystem::path input;
  std::optional<int> number = {};  // of a trial; in a result of a falsification of a counterexample
  std::optional<int> counterexample = {};  // of a falsification in a database; none: the first
  bool is_every_leaf = false;              // the trials of a plan tree go through its leaves
  std::filesystem::path plan = {};         // of a trace or a result; empty: plan.json beside it
  domain::ModelPath models = {};
};

struct ViewedPage {
  std::string html;
  double seconds = 0;  // of simulated time
  ExitCode code = ExitCode::kDone;
};

ViewedPage PageOf(const view::Subject& subject);

// Each function makes the page of one kind of input. They throw InputError for errors in files, and
// UsageError for requests that do not fit the input.

// A trace that `assay run -o` has written. `text` is its contents.
ViewedPage TracePage(const ViewRequest& request, std::string_view text);
// A plan file, or a scenario for which a plan is made; `document` is its contents. The plan is
// executed once without noise. The exit code is kFailed if the execution does not succeed.
ViewedPage PlanPage(const ViewRequest& request, const Document& document);
// A trial of the plan tree that is made for a scenario. The exit code is kFailed if the trial
// failed.
ViewedPage TreePage(const ViewRequest& request);
// A trial of the database of a sweep, which is executed again.
ViewedPage StoredTrialPage(const ViewRequest& request);
// A counterexample or a trial in the result.json of a run under noise, which is executed again.
ViewedPage ResultPage(const ViewRequest& request);

}  // namespace assay::cli
