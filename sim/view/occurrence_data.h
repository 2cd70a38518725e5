#pragma once

#include <nlohmann/json_fwd.hpp>

#include "sim/execution/trace/trace.h"

namespace assay::view {

// Returns what happened at single times of an execution, in the order of time: grasps, looks,
// verifications, recoveries, motions of strategies, collisions, and an end before its time. Each
// has a sentence for people.
nlohmann::ordered_json OccurrencesOf(const execution::Trace& trace);

// Returns the guarded moves: when each began and ended, its direction, and the force that ends it.
nlohmann::ordered_json GuardsOf(const execution::Trace& trace);

// Returns the collisions: the time of each, and the pair of bodies.
nlohmann::ordered_json CollisionsOf(const execution::Trace& trace);

// Returns the pairs of bodies that touch, as ranges of time. The world is left out.
nlohmann::ordered_json ContactsOf(const execution::Trace& trace);

}  // namespace assay::view
