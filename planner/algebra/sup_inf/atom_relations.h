#pragma once

#include "planner/algebra/expression/expression.h"

namespace assay::algebra {

// Takes the linear relations that hold between an atom and its operands, wherever the atom has a
// value.
class AtomRelations {
 public:
  virtual ~AtomRelations() = default;
  virtual void IsAtMost(const Expression& bound) = 0;         // atom <= bound
  virtual void NegatedIsAtMost(const Expression& bound) = 0;  // -atom <= bound
};

}  // namespace assay::algebra
