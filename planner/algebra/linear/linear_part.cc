#include "planner/algebra/linear/linear_part.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace assay::algebra {
namespace {

using OptionalForm = std::optional<LinearForm>;

// Reads each sub-expression once, however often it occurs.
class LinearReader {
 public:
  const OptionalForm& Read(const Expression& e) {
    if (const auto known = known_.find(e.index()); known != known_.end() && e.index() >= 0) {
      return known->second;
    }
    return known_[e.index()] = ReadNew(e);
  }

 private:
  OptionalForm ReadNew(const Expression& e) {
    switch (e.op()) {
      case Operator::kConstant:
        if (!std::isfinite(e.constant())) return std::nullopt;
        return LinearForm{.constant = e.constant()};
      case Operator::kVariable:
        return FormOf(ColumnId(e.variable().index()));
      case Operator::kSum:
        return ReadSum(e);
      case Operator::kProduct:
        return ReadProduct(e);
      case Operator::kQuotient:
        return ReadQuotient(e);
      case Operator::kPower:
      case Operator::kSin:
      case Operator::kCos:
      case Operator::kSqrt:
      case Operator::kAbs:
      case Operator::kMin:
      case Operator::kMax:
        return std::nullopt;
    }
    return std::nullopt;
  }

  OptionalForm ReadSum(const Expression& e) {
    LinearForm sum;
    for (const Expression& operand : e.operands()) {
      const OptionalForm& form = Read(operand);
      if (!form) return std::nullopt;
      for (const auto& [column, coefficient] : form->coefficients) sum.Add(column, coefficient);
      sum.constant = sum.constant + form->constant;
    }
    return sum;
  }

  OptionalForm ReadProduct(const Expression& e) {
    LinearForm product{.constant = 1};
    for (const Expression& operand : e.operands()) {
      const OptionalForm& form = Read(operand);
      if (!form || (!form->IsConstant() && !product.IsConstant())) return std::nullopt;
      product = form->IsConstant() ? form->constant * product : product.constant * *form;
    }
    return product;
  }

  OptionalForm ReadQuotient(const Expression& e) {
    const OptionalForm divisor = Read(e.operands()[1]);
    if (!divisor || !divisor->IsConstant() || divisor->constant.IsZero()) return std::nullopt;
    const OptionalForm& dividend = Read(e.operands()[0]);
    if (!dividend) return std::nullopt;
    return Rational(1) / divisor->constant * *dividend;
  }

  std::unordered_map<int, OptionalForm> known_;  // indexed by an expression's index
};

}  // namespace

bool IsNumber(const Interval& coefficient) {
  return coefficient.low == coefficient.high && std::isfinite(coefficient.low);
}

bool IsVariable(const std::vector<NormalForm::Factor>& factors) {
  return factors.size() == 1 && factors[0].exponent == 1 &&
         factors[0].atom.op() == Operator::kVariable;
}

std::optional<LinearForm> ExactLinearForm(const Expression& e) { return LinearReader().Read(e); }

std::optional<LinearForm> LinearFormOf(const Expression& e) {
  if (std::optional<LinearForm> form = ExactLinearForm(e)) return form;
  LinearForm form;
  for (const NormalForm::Term& term : NormalFormOf(e).terms) {
    if (!IsNumber(term.coefficient)) return std::nullopt;
    if (term.factors.empty()) {
      form.constant = form.constant + term.coefficient.low;
    } else if (IsVariable(term.factors)) {
      form.Add(ColumnId(term.factors[0].atom.variable().index()), term.coefficient.low);
    } else {
      return std::nullopt;
    }
  }
  return form;
}

Interval Narrowed(const Interval& a, const Interval& b) {
  const Interval both = {std::max(a.low, b.low), std::min(a.high, b.high)};
  return both.low <= both.high ? both : a;
}

std::vector<LinearForm> EndsOf(ColumnId column, const Interval& range) {
  std::vector<LinearForm> rows;
  const LinearForm form = FormOf(column);
  if (std::isfinite(range.high)) rows.push_back(form - LinearForm{.constant = range.high});
  if (std::isfinite(range.low)) rows.push_back(LinearForm{.constant = range.low} - form);
  return rows;
}

LinearPart LinearPartOf(const ConstraintSet& constraints) {
  LinearPart part;
  for (std::size_t v = 0; v < constraints.box.size(); ++v) {
    std::ranges::copy(EndsOf(ColumnId(v), constraints.box[v]),
                      std::back_inserter(part.at_most_zero));
  }
  for (const Inequality& inequality : constraints.inequalities) {
    const std::optional<LinearForm> lesser = LinearFormOf(inequality.lesser);
    const std::optional<LinearForm> greater = LinearFormOf(inequality.greater);
    if (lesser && greater) {
      part.at_most_zero.push_back(*lesser - *greater);
    } else {
      part.others.push_back(inequality);
    }
  }
  return part;
}

Interval TightenedInterval(VariableId variable, const Interval& interval,
                           const LinearSupInf& core) {
  const LinearForm form = FormOf(ColumnId(variable.index()));
  return Narrowed(interval, {-core.Sup(-form, {}).Greatest(), core.Sup(form, {}).Greatest()});
}

}  // namespace assay::algebra
