#include "sim/film/subject.h"

#include <set>

namespace assay::film {

std::vector<domain::PartId> WorkedParts(const domain::Problem& problem, const plan::Plan& plan) {
  std::set<domain::PartId> parts;
  for (const plan::PlannedStep& step : plan.steps) {
    for (const domain::PartId part : PartsOf(problem, step.action)) parts.insert(part);
  }
  for (std::size_t i = 0; i < problem.parts.size() && plan.steps.empty(); ++i) {
    parts.insert(domain::PartId(i));
  }
  return {parts.begin(), parts.end()};
}

}  // namespace assay::film
