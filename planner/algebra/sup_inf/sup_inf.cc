#include "planner/algebra/sup_inf/sup_inf.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "planner/algebra/expression/evaluation.h"
#include "planner/algebra/operators/operator_rule.h"
#include "planner/algebra/sup_inf/linear_part.h"
#include "planner/algebra/sup_inf/linear_relaxation.h"
#include "planner/numeric/interval_arithmetic.h"

namespace assay::algebra {
namespace {

enum class Side { kSup, kInf };

// The answer to one question about an expression that is not a number.
class Answer {
 public:
  Answer(ExpressionPool& pool, const std::set<VariableId>& keep, const ConstraintSet& constraints)
      : relaxation_(pool, constraints, keep), keeps_(!keep.empty()) {}

  Expression Of(const Expression& j, Side side) {
    if (!keeps_) {
      const Interval range = relaxation_.RangeOf(j);
      return side == Side::kSup ? range.high : range.low;
    }
    if (relaxation_.IsKept(j)) return j;
    if (!j.op().rule().passes_bounds_through) return Symbolic(j, side);
    std::vector<Expression> bounds;
    for (const Expression& operand : j.operands()) bounds.push_back(Of(operand, side));
    return Apply(j.op(), bounds);
  }

 private:
  // INF(J) is computed as -SUP(-J): the upper bounds of -J are negated, and the greatest result is
  // taken.
  Expression Symbolic(const Expression& j, Side side) {
    const double none = side == Side::kSup ? kInfinity : -kInfinity;
    const LeastOf sup = relaxation_.Sup(side == Side::kSup ? j : -j);
    if (sup.IsContradiction()) return -none;
    std::optional<Expression> answer;
    for (const LinearForm& form : WithoutIdleNumber(sup)) {
      const std::optional<Expression> bound = Rounded(side == Side::kSup ? form : -form, side);
      if (!bound) continue;
      if (!answer) {
        answer = *bound;
      } else {
        answer = side == Side::kSup ? Min(*answer, *bound) : Max(*answer, *bound);
      }
    }
    return answer.value_or(none);
  }

  // Returns the forms without a number that another form never exceeds. The range of a product
  // often gives a number of this kind.
  std::vector<LinearForm> WithoutIdleNumber(const LeastOf& sup) {
    std::vector<LinearForm> forms = sup.Forms();
    const auto number = std::ranges::find_if(forms, &LinearForm::IsConstant);
    if (number == forms.end()) return forms;
    const bool is_idle = std::ranges::any_of(forms, [&](const LinearForm& form) {
      return !form.IsConstant() && relaxation_.GreatestOf(form) <= number->constant.RoundedDown();
    });
    if (is_idle) forms.erase(number);
    return forms;
  }

  // Returns the form with numbers that are doubles or quotients of two doubles. The result is never
  // below the form for SUP and never above it for INF. Returns nothing if the coefficient of a
  // variable without bounds is neither a double nor such a quotient.
  std::optional<Expression> Rounded(const LinearForm& form, Side side) {
    Expression sum = 0;
    LinearForm slack{.constant = form.constant};
    for (const auto& [column, coefficient] : form.coefficients) {
      const Expression product = relaxation_.ProductOf(column);
      const auto numerator = coefficient.Numerator().Exactly();
      const auto denominator = coefficient.Denominator().Exactly();
      if (const std::optional<double> exact = coefficient.Exactly()) {
        sum = sum + *exact * product;
      } else if (numerator && denominator) {
        sum = sum + *numerator * product / *denominator;
      } else {
        const Interval& range = relaxation_.RangeOf(column);
        const double greatest = std::max(std::abs(range.low), std::abs(range.high));
        if (!std::isfinite(greatest)) return std::nullopt;
        const numeric::Rational error = Abs(coefficient - coefficient.Nearest()) * greatest;
        slack.constant = slack.constant + (side == Side::kSup ? error : -error);
        sum = sum + coefficient.Nearest() * product;
      }
    }
    const double constant =
        side == Side::kSup ? slack.constant.RoundedUp() : slack.constant.RoundedDown();
    return sum + constant;
  }

  LinearRelaxation relaxation_;
  bool keeps_;
};

Expression SupOrInf(const Expression& j, const std::set<VariableId>& keep,
                    const ConstraintSet& constraints, Side side) {
  if (j.IsConstant()) return j;
  return Answer(*j.pool(), keep, constraints).Of(j, side);
}

}  // namespace

Expression Sup(const Expression& j, const std::set<VariableId>& keep,
               const ConstraintSet& constraints) {
  return SupOrInf(j, keep, constraints, Side::kSup);
}

Expression Inf(const Expression& j, const std::set<VariableId>& keep,
               const ConstraintSet& constraints) {
  return SupOrInf(j, keep, constraints, Side::kInf);
}

std::vector<Interval> TightenedBox(const ConstraintSet& constraints) {
  std::vector<Interval> box = constraints.box;
  if (constraints.inequalities.empty()) return box;
  const LinearSupInf core(LinearPartOf(constraints).at_most_zero);
  for (std::size_t v = 0; v < box.size(); ++v) {
    box[v] = TightenedInterval(VariableId(v), box[v], core);
  }
  return box;
}

}  // namespace assay::algebra
