#pragma once

#include <cstddef>
#include <vector>

#include "planner/uncertainty/preconditions/certify.h"

namespace assay::constraint_posting {

// The distance of a step from being proved; less is better.
struct Shortfall {
  std::size_t goals = 0;  // the number of goals that are not proved
  // the sum, over these goals, of the excess of a goal's bound over its limit, in metres and
  // radians
  double violation = 0;

  bool IsLessThan(const Shortfall& other) const {
    constexpr double kRelevant = 1e-5;  // metres and radians; a smaller gain is not worth an action
    return goals < other.goals || (goals == other.goals && violation < other.violation - kRelevant);
  }
};

inline Shortfall ShortfallOf(const std::vector<uncertainty::Unproved>& unproved) {
  return {unproved.size(), uncertainty::Violation(unproved)};
}

}  // namespace assay::constraint_posting
