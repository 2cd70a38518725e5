#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "planner/assembly/contingent_assembly.h"

namespace assay::cli {

// These reports are about one plan tree for all worlds of a scenario (domain::ReadWorlds).

// Returns the tree's actions in the words of plans, by their names in the tree. The action
// "plan1-action_3()", for example, may be "verify assemble(peg, block, ...)".
std::map<std::string, std::string> ActionWords(const std::vector<domain::Problem>& worlds,
                                               const assembly::ContingentAssembly& assembly);

// Returns a text for people: the tree with its actions in the words of plans, and each plan with
// what was done about uncertainty. If there is no tree, the text states why.
std::string Text(const std::vector<domain::Problem>& worlds,
                 const assembly::ContingentAssembly& assembly);

// Returns {"outcome", "tree" (contingent/tree.schema.json), "plans": [{"worlds": [{"peg":
// "lying"}], "actions", "ordering", ...}]}, or an object with "conflict" if there is no tree.
nlohmann::ordered_json ToJson(const std::vector<domain::Problem>& worlds,
                              const assembly::ContingentAssembly& assembly);

}  // namespace assay::cli
