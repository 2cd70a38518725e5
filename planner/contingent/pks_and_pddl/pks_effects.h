#pragma once

#include <vector>

#include "planner/contingent/pks_and_pddl/pks_tokens.h"

namespace assay::contingent {

// Reads the effects of an action, or update rules:
//   effects = effect { ";" effect }
//   effect = [ "forall" "(" variables ")" ] [ query "=>" ] changes
// A comma may separate effects, too, if the next effect begins with a query.
std::vector<Effect> ReadEffects(PksTokens& tokens);
// Reads changes with commas between them, such as add(Kf, p(a)).
std::vector<Change> ReadChanges(PksTokens& tokens);

}  // namespace assay::contingent
