#include "sim/cli/tasks/recorded_execution.h"

#include <fmt/format.h>

#include <algorithm>

#include "planner/base/input_files/input_error.h"
#include "planner/base/input_files/quotation.h"
#include "sim/cli/plan_output/plan_text.h"

namespace assay::cli {
namespace {

// Returns why the trace does not belong to this plan. The text is empty if the trace belongs to it.
std::string Mismatch(const execution::Trace& trace, const PlannedProblem& planned) {
  const domain::Problem& problem = planned.problem;
  const plan::Plan& plan = planned.result.plan;
  if (trace.problem != problem.name ||
      !std::ranges::equal(trace.parts, problem.parts, {}, {}, &domain::Part::name)) {
    return fmt::format("it is a trace of {}, and the plan {} is for {}", Quote(trace.problem),
                       planned.plan_file, problem.name);
  }
  const auto has_step = [&](plan::StepId step) {
    return step.index() >= 0 && step.index() < static_cast<int>(plan.steps.size());
  };
  for (const execution::Milestone* milestone : trace.All<execution::Milestone>()) {
    if (!has_step(milestone->step)) return "the plan does not have all steps of the trace";
  }
  for (const execution::StepEnd* end : trace.All<execution::StepEnd>()) {
    if (!has_step(end->step) ||
        plan::ShortText(problem, plan.step(end->step).action) != end->action) {
      return fmt::format("{} of the trace is not a step of the plan", Quote(end->action));
    }
  }
  const auto samples = trace.All<execution::Sample>();
  if (samples.empty()) return "the trace has no samples";
  const bool same_robots = std::ranges::all_of(samples, [&](const execution::Sample* sample) {
    return sample->snapshot.arms.size() == problem.workcell->robots().size();
  });
  return same_robots ? "" : "it is a trace of other robots";
}

}  // namespace

execution::Trace ReadTraceOf(const PlannedProblem& planned, std::string_view text,
                             const std::filesystem::path& file) {
  execution::Trace trace = execution::ReadTrace(text, file.string());
  if (const std::string mismatch = Mismatch(trace, planned); !mismatch.empty()) {
    throw InputError({.file = file.string()}, mismatch,
                     "a trace of the plan as assay run -o writes it");
  }
  return trace;
}

}  // namespace assay::cli
