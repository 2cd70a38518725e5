#pragma once

#include <string>
#include <utility>

#include "planner/constraint_posting/uncertainty_phase/uncertainty_phase.h"
#include "planner/domain/problem/problem_file.h"

namespace assay::check {

// A problem with its certified plan.
struct Certified {
  domain::Problem problem;
  plan::Plan plan;
};

inline Certified CertifiedPlan(domain::Problem problem, uncertainty::Propagation propagation =
                                                            uncertainty::Propagation::kSound) {
  constraint_posting::UncertaintyOptions options;
  options.propagation = propagation;
  options.instances = 1;
  plan::Plan plan = constraint_posting::MakeCertifiedPlan(problem, {}, options).plan;
  return {std::move(problem), std::move(plan)};
}

inline domain::Problem ScenarioNamed(const std::string& name,
                                     const domain::Overrides& overrides = {}) {
  return domain::ReadProblem(Document::Load(ASSAY_SOURCE_DIR "/scenarios/" + name + ".yaml"),
                             ASSAY_SOURCE_DIR "/models", overrides);
}

inline Certified CertifiedPlan(
    const std::string& scenario, const domain::Overrides& overrides = {},
    uncertainty::Propagation propagation = uncertainty::Propagation::kSound) {
  return CertifiedPlan(ScenarioNamed(scenario, overrides), propagation);
}

// Returns the id of the first step of this kind in the order of execution. Returns None if there is
// no such step.
inline plan::StepId FirstStep(const domain::ActionKind& kind, const plan::Plan& plan) {
  for (const plan::StepId id : plan.ExecutionOrder()) {
    if (plan.step(id).action.Is(kind)) return id;
  }
  return plan::StepId::None();
}

// Returns the plan up to its first pickup. It is quicker to execute than the whole plan, and enough
// for claims about the pickup.
inline plan::Plan UpToThePickup(const plan::Plan& plan) {
  const int last = plan.step(FirstStep(domain::kPickup, plan)).executed;
  plan::Plan cut{.problem = plan.problem, .steps = {}};
  for (const plan::PlannedStep& step : plan.steps) {
    if (step.executed > last) continue;
    cut.steps.push_back(step);
    cut.steps.back().inserted = static_cast<int>(cut.steps.size());
  }
  return cut;
}

}  // namespace assay::check
