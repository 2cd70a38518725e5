#include "sim/cli/page_output/execution_page.h"

#include "sim/cli/shown_executions/noiseless_trial.h"
#include "sim/view/page.h"

namespace assay::cli {

std::string ExecutionPage(const ShownExecution& shown) {
  const scene::Scene scene(shown.problem, shown.scene);
  view::Subject subject{.problem = shown.problem,
                        .plan = shown.plan,
                        .scene = scene,
                        .trace = shown.trace,
                        .outcome = shown.outcome,
                        .reason = shown.reason,
                        .claims = shown.claims,
                        .way = shown.way,
                        .why_not = shown.why_not,
                        .source = shown.source,
                        .plan_file = shown.plan_file};
  if (!shown.believed) return view::Page(subject);
  const scene::Scene believed(shown.problem, *shown.believed);
  const check::Trial noiseless = NoiselessTrial({shown.problem, shown.plan, *shown.believed});
  subject.beside.emplace(view::Beside{"the plan without noise", believed, noiseless.trace});
  return view::Page(subject);
}

}  // namespace assay::cli
