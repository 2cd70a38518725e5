#include "sim/cli/shown_executions/plan_of_request.h"

#include <fmt/format.h>

#include <system_error>

#include "planner/base/input_files/quotation.h"
#include "sim/cli/command_line/usage_error.h"

namespace assay::cli {
namespace {

namespace fs = std::filesystem;

fs::path PlanFileOf(const ShowRequest& request) {
  if (!request.plan.empty()) return request.plan;
  const fs::path plan = request.input.parent_path() / "plan.json";
  std::error_code ignored;
  if (fs::exists(plan, ignored)) return plan;
  throw UsageError(fmt::format("there is no {} beside {}; allowed: --plan FILE",
                               Quote(plan.string()), Quote(request.input.string())));
}

}  // namespace

PlannedProblem PlanOf(const ShowRequest& request) {
  PlannedProblem planned = ReadPlan(Document::Load(PlanFileOf(request)), request.models);
  RequireSound(planned);
  return planned;
}

}  // namespace assay::cli
