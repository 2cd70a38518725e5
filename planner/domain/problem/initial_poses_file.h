#pragma once

#include <map>
#include <string>

#include "planner/base/input_files/document.h"
#include "planner/domain/problem/problem.h"
#include "planner/domain/problem/units.h"

namespace assay::domain {

// Reads the poses of the parts at the start into a problem that has its parts with their models.
// They come from the `pose` of each entry of `parts`, or from the matings of `initially`. For an
// open pose (`one-of`), `chosen` gives the choice by the part's name; without an entry there, the
// first is taken. `root` is the scenario's root. Throws InputError for malformed poses, and for
// parts that are beside or in the table, or overlap (PossibleStarts). A part that is assembled at
// the start gets the height error of the part with which it is assembled, and may have none of its
// own.
void ReadInitialPoses(const Value& root, const Units& units,
                      const std::map<std::string, int>& chosen, Problem& problem);

}  // namespace assay::domain
