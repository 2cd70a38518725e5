#pragma once

#include <optional>
#include <vector>

#include "planner/contingent/pks_and_pddl/pks_tokens.h"

namespace assay::contingent {

// These functions read one element of the .pks format, which scenarios/know/README.md describes:
// a query to the knowledge, such as K(a & b) | Kw(c); a literal; literals joined by &; a term.
Query ReadQuery(PksTokens& tokens);
Literal ReadLiteral(PksTokens& tokens);
std::vector<Literal> ReadConjunction(PksTokens& tokens);
Term ReadTerm(PksTokens& tokens);
// Reads "within NUMBER"; returns none if it does not stand there.
std::optional<double> ReadWithin(PksTokens& tokens);

}  // namespace assay::contingent
