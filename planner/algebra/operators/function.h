#pragma once

#include <optional>
#include <span>

#include "planner/algebra/expression/expression.h"
#include "planner/base/interval.h"

namespace assay::algebra {

// What the operators need in order to make their nodes.

// Returns the pool of the operands, or null if all are plain numbers. Operands of two pools break
// an invariant.
ExpressionPool* JoinedPool(std::span<const Expression> operands);

// Returns the number, stored in the pool if there is one.
Expression Number(double value, ExpressionPool* pool);

// Returns e, stored in the pool if it is a plain number.
Expression InPool(const Expression& e, ExpressionPool* pool);

// Returns the interval that contains this constant alone.
Interval IntervalOf(const Expression& constant);

// Returns true if there are operands for which the operation has no value.
bool MayLackValue(Operator op, int exponent);

// Returns the operation on the pool's expressions as a node, without any rule.
Expression NodeOf(ExpressionPool& pool, Operator op, std::span<const Expression> operands,
                  int exponent = 0);

// Returns the value of the operation if all operands are numbers and the value is exact or there is
// no pool. Returns nothing otherwise.
std::optional<Expression> Folded(Operator op, std::span<const Expression> operands,
                                 int exponent = 0);

// Returns the operation, folded if possible.
Expression FunctionOf(Operator op, std::span<const Expression> operands, int exponent = 0);

}  // namespace assay::algebra
