#include "planner/algebra/sup_inf/constraint_set.h"

namespace assay::algebra {

ConstraintSet DeclaredBox(const ExpressionPool& pool) {
  ConstraintSet declared;
  for (int v = 0; v < pool.variable_count(); ++v) {
    declared.box.push_back(pool.bounds(VariableId(v)));
  }
  return declared;
}

}  // namespace assay::algebra
