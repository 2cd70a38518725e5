#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "planner/plan/data/plan.h"

namespace assay::plan {

using Ordering = std::vector<std::pair<StepId, StepId>>;  // first before second

// Returns whether some order of steps 0 .. steps - 1 keeps the ordering, whose ids must be among
// them.
bool IsAcyclic(int steps, const Ordering& ordering);

// Returns the first pair of the ordering that the order breaks; {None, None} if it keeps them all.
std::pair<StepId, StepId> FirstBroken(const Ordering& ordering, const std::vector<StepId>& order);

enum class Visit { kContinue, kStop };

// Calls `visit` with every order of the steps that keeps the ordering, in lexicographic order of
// the step ids, until it returns kStop. Returns whether all orders were visited.
bool VisitLinearizations(int steps, const Ordering& ordering,
                         const std::function<Visit(const std::vector<StepId>&)>& visit);

}  // namespace assay::plan
