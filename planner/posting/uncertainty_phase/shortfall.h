#pragma once

#include <cstddef>
#include <vector>

#include "planner/uncertainty/preconditions/certify.h"

namespace assay::posting {

// How far a step is from being proved; less is better.
struct Shortfall {
  std::size_t goals = 0;  // that are not proved
  double violation = 0;  // metres and radians: how far their bounds are beyond their limits, in all

  bool IsLessThan(const Shortfall& other) const {
    constexpr double kRelevant = 1e-5;  // metres and radians: less is not worth an action
    return goals < other.goals || (goals == other.goals && violation < other.violation - kRelevant);
  }
};

inline Shortfall ShortfallOf(const std::vector<uncertainty::Unproved>& unproved) {
  return {unproved.size(), uncertainty::Violation(unproved)};
}

}  // namespace assay::posting
