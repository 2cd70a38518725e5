#pragma once

#include <vector>

#include "planner/algebra/expression/expression.h"

namespace assay::algebra {

struct Inequality {
  Expression lesser;
  Expression greater;  // lesser <= greater
};

// The set that bounds are taken over: a box and inequalities between variables.
struct ConstraintSet {
  std::vector<Interval> box = {};  // indexed by VariableId; ends may be infinite
  std::vector<Inequality> inequalities = {};
};

// Returns the bounds with which the variables were declared.
ConstraintSet DeclaredBox(const ExpressionPool& pool);

}  // namespace assay::algebra
