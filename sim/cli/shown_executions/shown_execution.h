#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planner/base/input_files/document.h"
#include "planner/domain/workcell/model_path.h"
#include "sim/check/certificate_claims/claim.h"
#include "sim/cli/command_line/exit_code.h"
#include "sim/execution/trace/trace.h"
#include "sim/scene/mjcf.h"
#include "sim/view/page.h"

namespace assay::cli {

// What `assay view` and `assay film` are asked to show.
struct ShowRequest {
  std::string verb = "view";  // for messages
  std::filesystem::path input = {};
  std::optional<int> number = {};  // of a trial; in a result of a falsification of a counterexample
  std::optional<int> counterexample = {};  // of a falsification in a database; none: the first
  bool is_every_leaf = false;              // the trials of a plan tree go through its leaves
  std::filesystem::path plan = {};         // of a trace or a result; empty: plan.json beside it
  bool needs_claims = true;                // whether the claims of a trace are judged
  domain::ModelPath models = {};
};

// An execution that is shown as a page or as a film.
struct ShownExecution {
  domain::Problem problem;
  plan::Plan plan;  // without steps if the execution followed no plan of steps
  scene::SceneOptions scene;
  // For a trial under noise: the scene without errors.
  std::optional<scene::SceneOptions> believed = {};
  execution::Trace trace;
  // The meaning of the following members is that of view::Subject.
  std::string outcome = {};
  std::string reason = {};
  std::vector<check::Claim> claims = {};
  std::optional<view::Way> way = {};
  std::vector<view::Reasons> why_not = {};
  std::string source = {};
  std::string plan_file = {};
  ExitCode code = ExitCode::kDone;  // of the verb that shows the execution
};

// Finds out what kind of file the input is, and reads or makes the execution. Throws InputError for
// errors in files, and UsageError for requests that do not fit the input.
ShownExecution ExecutionOf(const ShowRequest& request);

// These functions are for one kind of input each.

// A trace that `assay run -o` has written. `text` is its contents.
ShownExecution TraceExecution(const ShowRequest& request, std::string_view text);
// A plan file, or a scenario for which a plan is made; `document` is its contents. The plan is
// executed once without noise. The exit code is kFailed if the execution does not succeed.
ShownExecution PlanExecution(const ShowRequest& request, const Document& document);
// A trial of the plan tree that is made for a scenario. The exit code is kFailed if the trial
// failed.
ShownExecution TreeExecution(const ShowRequest& request);
// A trial of the database of a sweep, which is executed again.
ShownExecution StoredTrialExecution(const ShowRequest& request);
// A counterexample or a trial in the result.json of a run under noise, which is executed again.
ShownExecution ResultExecution(const ShowRequest& request);

}  // namespace assay::cli
