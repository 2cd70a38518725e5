#pragma once

#include <optional>
#include <span>

#include "planner/algebra/expression/expression.h"
#include "planner/base/interval.h"

namespace assay::algebra {

// Functions with which the operators make their nodes.

// Returns the pool of an operator's operands, or null if all are plain numbers. Operands of two
// pools break an invariant.
ExpressionPool* JoinedPool(std::span<const Expression> operands);

// Returns the number as an operand. If `pool` is not null, the number is stored in it.
Expression Number(double value, ExpressionPool* pool);

// Returns e as an operand, stored in the pool if it is a plain number.
Expression InPool(const Expression& e, ExpressionPool* pool);

// Returns the interval of a constant operand, which contains this constant alone.
Interval IntervalOf(const Expression& constant);

// Returns true if the operator has no value for some operands.
bool MayLackValue(Operator op, int exponent);

// Returns the node of an operator over the pool's expressions, without any of the operator's rules.
Expression NodeOf(ExpressionPool& pool, Operator op, std::span<const Expression> operands,
                  int exponent = 0);

// Returns the node of an operator, folded if possible.
Expression FunctionOf(Operator op, std::span<const Expression> operands, int exponent = 0);

}  // namespace assay::algebra
