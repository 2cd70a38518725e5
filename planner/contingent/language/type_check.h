#pragma once

#include "planner/contingent/language/domain.h"
#include "planner/contingent/language/symbol_table.h"

namespace assay::contingent {

// Checks that every name is declared, has as many arguments as declared, of the right types, and
// that numbers stand where numbers belong; makes functions without arguments, which look like
// constants, functions; gives the free variables of LCW formulas their types. Throws InputError
// with file, line and column, and with what is allowed there.
void CheckTypes(Domain& domain, Problem& problem, const SymbolTable& symbols);

}  // namespace assay::contingent
