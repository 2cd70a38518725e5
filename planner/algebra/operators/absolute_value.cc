#include <array>
#include <cmath>

#include "planner/algebra/operators/function.h"
#include "planner/algebra/operators/operator_rule.h"
#include "planner/algebra/operators/point_or_box.h"
#include "planner/algebra/sup_inf/atom_relations.h"
#include "planner/numeric/interval_arithmetic.h"

namespace assay::algebra {

const OperatorRule kAbsRule = {
    .name = "abs",
    .operand_count = 1,
    .value = [](std::span<const double> x, int) { return std::abs(x[0]); },
    .range = [](std::span<const Interval> x, int) { return Abs(x[0]); },
    .slope = []<class Number>(const FunctionPlace<Number>& at, int) -> Number {
      if (Low(at.a) >= 0) return Exactly<Number>(1);
      if (High(at.a) <= 0) return Exactly<Number>(-1);
      return Between<Number>(-1, 1);
    },
    .curvature = []<class Number>(const FunctionPlace<Number>& at, int, int) -> Number {
      return Low(at.a) > 0 || High(at.a) < 0 ? Exactly<Number>(0) : Unknown<Number>();
    },
    .symmetry = Symmetry::kEven,
    .square =
        [](Expansion&, const Expression&, const PolynomialAlgebra::Polynomial& operand) {
          return OperatorRule::SquareOfAtom{.base = operand, .power = 2};
        },
    .relate =
        [](AtomRelations& relations, const Expression& size) {
          relations.NegatedIsAtMost(size.operands()[0]);
          relations.NegatedIsAtMost(-size.operands()[0]);
        },
};

Expression Abs(const Expression& a) { return FunctionOf(Operator::kAbs, std::array{a}); }

}  // namespace assay::algebra
