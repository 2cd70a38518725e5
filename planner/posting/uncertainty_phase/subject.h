#pragma once

#include <cstddef>
#include <vector>

#include "planner/domain/problem/problem.h"
#include "planner/plan/data/plan.h"

namespace assay::posting {

// The parts that an action moves, or moves to: of an assemble the held one and the fixed one.
std::vector<domain::PartId> HandledParts(const domain::Problem& problem,
                                         const plan::Action& action);

// What an action is about, in whatever plan.
struct Subject {
  std::size_t kind = 0;  // index of the action's kind
  std::vector<domain::PartId> parts = {};

  bool operator==(const Subject&) const = default;
};

Subject SubjectOf(const domain::Problem& problem, const plan::Action& action);

}  // namespace assay::posting
