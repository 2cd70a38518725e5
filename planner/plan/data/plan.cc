#include "planner/plan/data/plan.h"

#include <algorithm>

namespace assay::plan {

std::vector<StepId> Plan::ExecutionOrder() const {
  std::vector<StepId> order;
  for (std::size_t i = 0; i < steps.size(); ++i) order.emplace_back(i);
  std::ranges::sort(order, {}, [this](StepId id) { return step(id).executed; });
  return order;
}

bool IsCertified(const Plan& plan) {
  return std::ranges::any_of(
      plan.steps, [](const PlannedStep& step) { return step.certificate != Certificate{}; });
}

}  // namespace assay::plan
