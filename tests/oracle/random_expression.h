#pragma once

#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "planner/algebra/expression/evaluation.h"
#include "planner/algebra/sup_inf/constraint_set.h"
#include "planner/base/random.h"
#include "planner/numeric/interval_arithmetic.h"

// Random expressions without structure, with all operators.
namespace assay::oracle {

using algebra::Expression;
using algebra::ExpressionPool;

// Returns an interval that certainly contains the value of the expression at a point. Rounding
// makes it wide.
inline Interval ValueAt(const Expression& e, const std::vector<double>& point) {
  std::vector<Interval> box;
  for (double x : point) box.push_back({x, x});
  return algebra::Evaluate(e, std::span<const Interval>(box));
}

inline Interval RandomInterval(RandomStream& random) {
  const double a = random.Uniform(-3, 3);
  if (random.Index(10) == 0) return {a, a};
  return {a, a + random.Uniform() * (random.Index(2) == 0 ? 0.3 : 4)};
}

// Makes a number positive, and leaves any other expression as it is. The root and the reciprocal of
// a positive number are real.
inline Expression RealIfNumber(const Expression& e) {
  if (!e.IsConstant()) return e;
  return e.constant() == 0 ? 1 : std::abs(e.constant());
}

inline Expression RandomExpression(int depth, RandomStream& random, ExpressionPool& pool) {
  if (depth == 0 || random.Index(8) == 0) {
    if (random.Index(3) == 0) return random.Index(9) - 4;
    if (random.Index(4) == 0) return random.Uniform(-2, 2);
    return pool.Variable(algebra::VariableId(random.Index(pool.variable_count())));
  }
  const auto operand = [&] { return RandomExpression(depth - 1, random, pool); };
  switch (random.Index(12)) {
    case 0:
    case 1:
      return operand() + operand();
    case 2:
      return operand() - operand();
    case 3:
    case 4:
      return operand() * operand();
    case 5:
      return Power(RealIfNumber(operand()), random.Index(5) - 1);
    case 6:
      return operand() / RealIfNumber(operand());
    case 7:
      return Sin(operand());
    case 8:
      return Cos(operand());
    case 9:
      return Sqrt(RealIfNumber(operand()));
    case 10:
      return Abs(operand());
    default:
      return random.Index(2) == 0 ? Min(operand(), operand()) : Max(operand(), operand());
  }
}

// Declares one to four variables and returns an expression of at most this depth.
inline Expression RandomExpressionAndBox(int depth, RandomStream& random, ExpressionPool& pool) {
  const int variables = 1 + random.Index(4);
  for (int i = 0; i < variables; ++i) {
    pool.Declare(std::string(1, static_cast<char>('a' + i)), RandomInterval(random));
  }
  return RandomExpression(1 + random.Index(depth), random, pool);
}

}  // namespace assay::oracle
