#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "planner/assembly/contingent_assembly.h"

namespace assay::cli {

// One plan tree for the worlds of a scenario (domain::ReadWorlds).

// The tree's actions in the words of plans, by what they are in the tree ("plan1-action_3()"):
// "verify assemble(peg, block, ...)".
std::map<std::string, std::string> ActionWords(const std::vector<domain::Problem>& worlds,
                                               const assembly::ContingentAssembly& assembly);

// For people: the tree, its actions in the words of plans, and each plan with what was done about
// uncertainty; or why there is none.
std::string Text(const std::vector<domain::Problem>& worlds,
                 const assembly::ContingentAssembly& assembly);

// {"outcome", "tree" (contingent/tree.schema.json), "plans": [{"worlds": [{"peg": "lying"}],
// "actions", "ordering", ...}]}, or with "conflict".
nlohmann::ordered_json ToJson(const std::vector<domain::Problem>& worlds,
                              const assembly::ContingentAssembly& assembly);

}  // namespace assay::cli
