#pragma once

#include <vector>

#include "planner/contingent/grounding/ground_task.h"

namespace assay::contingent {

// For each atom its place in an order in which atoms that the initial relations name together are
// near each other, so that diagrams are small: FORCE (Aloul, Markov and Sakallah 2003). What only
// effects relate comes behind what they depend on.
std::vector<int> PlacesOfAtoms(const GroundTask& task);

}  // namespace assay::contingent
