#include "planner/algebra/sup_inf/linear_part.h"

#include <algorithm>
#include <cmath>

#include "planner/algebra/normal_forms/normalization.h"
#include "planner/algebra/sup_inf/linear_reader.h"

namespace assay::algebra {

std::optional<LinearForm> ExactLinearForm(const Expression& e) { return LinearReader().Read(e); }

namespace {

// Returns e as a linear form if its normal form is linear and the normal form needed no rounding.
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

}  // namespace

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
