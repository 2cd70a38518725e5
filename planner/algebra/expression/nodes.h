#pragma once

#include <vector>

#include "planner/algebra/expression/expression.h"

namespace assay::algebra {

// Returns the distinct sub-expressions of e, by increasing index. Operands precede the expressions
// that contain them, and e itself is last. A loop over them takes time proportional to the stored
// size of e, however deep e is and however often its parts occur. The pool's marks hold the place
// of each node in the list.
std::vector<Expression> NodesOf(const Expression& e);
std::size_t NodeCount(const Expression& e);

// Returns the distinct sub-expressions of e. Operands come before the expressions that contain
// them. This function takes less time than NodesOf, because it does not sort the nodes by index. e
// must belong to a pool.
std::vector<Expression> NodesInPostorder(const Expression& e);

// Returns the variables that occur in e, by increasing number.
std::vector<VariableId> VariablesOf(const Expression& e);

// Returns the variables of an atom, in increasing order. It gives the same result as VariablesOf,
// and is faster for atoms like x and sin(x).
std::vector<VariableId> VariablesOfAtom(const Expression& atom);

}  // namespace assay::algebra
