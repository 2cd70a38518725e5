#include "planner/plan/certificates/pushing.h"

#include <algorithm>

namespace assay::plan {

double BeyondContact(const domain::Problem& problem, const Certificate& certificate) {
  const double travel = problem.workcell->rules().guarded_travel;
  return std::min(travel, DoubtOfContact(certificate, travel) + kBeyondContact);
}

}  // namespace assay::plan
