#pragma once

#include <vector>

#include "planner/contingent/grounding/ground_task.h"

namespace assay::contingent {

// Returns each atom's place in an order that keeps atoms of one initial relation near each other,
// so that diagrams are small: FORCE (Aloul, Markov and Sakallah 2003). An atom that only effects
// relate to others comes after the atoms on which it depends.
std::vector<int> PlacesOfAtoms(const GroundTask& task);

}  // namespace assay::contingent
