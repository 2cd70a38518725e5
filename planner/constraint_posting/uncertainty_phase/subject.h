#pragma once

#include <vector>

#include "planner/domain/problem/problem.h"
#include "planner/plan/data/plan.h"

namespace assay::constraint_posting {

// The kind of an action and the parts it handles, independent of the plan.
struct Subject {
  const domain::ActionKind* kind = nullptr;
  std::vector<domain::PartId> parts = {};

  bool operator==(const Subject&) const = default;
};

Subject SubjectOf(const domain::Problem& problem, const plan::Action& action);

}  // namespace assay::constraint_posting
