#pragma once

#include <span>

#include "planner/algebra/expression/expression.h"

namespace assay::algebra {

// The rules by which a sum or a product folds the numbers among its operands. `neutral` is the
// number that the operation leaves out.
struct Folding {
  Operator op;
  double neutral = 0;
  bool is_absorbed_by_zero = false;
};

// Makes the node of the operator sum or product. Numbers are folded where this is exact. Neutral
// numbers are left out. Short sums in a sum, and short products in a product, are flattened.
Expression Combined(const Folding& folding, std::span<const Expression> operands);

}  // namespace assay::algebra
