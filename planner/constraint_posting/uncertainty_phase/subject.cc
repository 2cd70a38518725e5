#include "planner/constraint_posting/uncertainty_phase/subject.h"

namespace assay::constraint_posting {

Subject SubjectOf(const domain::Problem& problem, const plan::Action& action) {
  return {action.kind, plan::PartsOf(problem, action)};
}

}  // namespace assay::constraint_posting
