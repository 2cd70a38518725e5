#pragma once

#include <map>
#include <string>

#include "planner/base/document/document.h"
#include "planner/domain/problem/problem.h"
#include "planner/domain/problem/units.h"

namespace assay::domain {

// Reads where the parts are at the start, into a problem that has its parts with their models: the
// `pose` of each entry of `parts`, or the matings of `initially`. Of an open pose (`one-of`) the
// one that `chosen` tells by the part's name, else the first. `root`: of the scenario. Throws
// InputError, also for parts that are beside or in the table, or overlap.
void ReadInitialPoses(const Value& root, const Units& units,
                      const std::map<std::string, int>& chosen, Problem& problem);

}  // namespace assay::domain
