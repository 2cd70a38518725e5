#pragma once

#include <cstddef>
#include <vector>

#include "planner/domain/problem/problem.h"
#include "planner/plan/data/plan.h"

namespace assay::constraint_posting {

// Returns the part that an action handles; for an assemble, the held part and the fixed part.
std::vector<domain::PartId> HandledParts(const domain::Problem& problem,
                                         const plan::Action& action);

// The kind of an action and the parts it handles, independent of the plan.
struct Subject {
  std::size_t kind = 0;  // index of the action's kind
  std::vector<domain::PartId> parts = {};

  bool operator==(const Subject&) const = default;
};

Subject SubjectOf(const domain::Problem& problem, const plan::Action& action);

}  // namespace assay::constraint_posting
