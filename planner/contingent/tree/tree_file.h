#pragma once

#include <nlohmann/json_fwd.hpp>

#include "planner/base/document/document.h"
#include "planner/contingent/tree/plan_tree.h"

namespace assay::contingent {

// A plan tree, "assay-tree/1" (its schema: tree.schema.json): its nodes by number, children by
// their numbers, so that equal sub-plans stand there once:
//   {"act": {"name": "grasp", "arguments": ["can1"]}, "then": 7}
//   {"branch": "isSpillable(can1)", "true": 5, "false": 6}
//   {"branch": "getObjectLocation(cup)", "values": {"table": 3, "shelf": 4}}
//   {"goal": true}
// and "repeats": [7] where going on with these numbers goes back. A run-time variable's argument is
// {"value_of": "rightCombination"}.
nlohmann::ordered_json ToJson(const GroundTask& task, const PlanTree& tree);

// Reads a tree back. Throws InputError with the place of what does not fit the format or the task:
// unknown actions, formulas and functions, nodes that lead back to themselves without "repeats",
// and repeats of nodes that are not above.
PlanTree ReadTree(const Value& tree, const GroundTask& task);

}  // namespace assay::contingent
