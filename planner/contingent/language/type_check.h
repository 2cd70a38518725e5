#pragma once

#include "planner/contingent/language/domain.h"
#include "planner/contingent/language/symbol_table.h"

namespace assay::contingent {

// Checks that every name is declared, that it has as many arguments as declared and of the right
// types, and that numbers stand where numbers belong. Turns constants that name a function without
// arguments into functions. Gives the free variables of LCW formulas their types. Throws InputError
// with file, line and column, and with the input that is allowed there.
void CheckTypes(Domain& domain, Problem& problem, const SymbolTable& symbols);

}  // namespace assay::contingent
