#pragma once

#include <nlohmann/json_fwd.hpp>

#include "planner/base/input_files/document.h"
#include "planner/contingent/plan_tree/plan_tree.h"

namespace assay::contingent {

// Returns a plan tree in the format "assay-tree/1" (its schema: tree.schema.json). Nodes refer to
// their children by number, so that equal sub-plans are written once:
//   {"act": {"name": "grasp", "arguments": ["can1"]}, "then": 7}
//   {"branch": "isSpillable(can1)", "true": 5, "false": 6}
//   {"branch": "getObjectLocation(cup)", "values": {"table": 3, "shelf": 4}}
//   {"goal": true}
//
// The member "repeats": [7] lists the children that are nodes above. A run-time variable's argument
// is {"value_of": "rightCombination"}.
nlohmann::ordered_json ToJson(const GroundTask& task, const PlanTree& tree);

// Reads a tree back. Throws InputError with the place of each element that does not fit the format
// or the task: an unknown action, formula or function; a node that leads back to itself without
// "repeats"; and a repeat of a node that is not above.
PlanTree ReadTree(const Value& tree, const GroundTask& task);

}  // namespace assay::contingent
