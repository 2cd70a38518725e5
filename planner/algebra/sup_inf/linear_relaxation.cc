#include "planner/algebra/sup_inf/linear_relaxation.h"

#include <algorithm>
#include <cmath>

#include "planner/algebra/expression/evaluation.h"
#include "planner/algebra/expression/nodes.h"
#include "planner/algebra/normal_forms/normalization.h"
#include "planner/algebra/operators/operator_rule.h"
#include "planner/algebra/sup_inf/atom_relations.h"
#include "planner/algebra/sup_inf/linear_part.h"
#include "planner/algebra/sup_inf/linear_reader.h"
#include "planner/base/check.h"
#include "planner/numeric/interval_arithmetic.h"

namespace assay::algebra {
namespace {

int SignOf(const Interval& range) {
  if (range.low >= 0) return 1;
  return range.high <= 0 ? -1 : 0;
}

LeastOf BoundOf(double end) {
  return std::isfinite(end) ? LeastOf(LinearForm{.constant = end}) : LeastOf();
}

}  // namespace

LinearRelaxation::LinearRelaxation(ExpressionPool& pool, const ConstraintSet& constraints,
                                   std::set<VariableId> keep)
    : keep_(std::move(keep)), box_(constraints.box), tightened_(constraints.box.size(), false) {
  for (std::size_t v = 0; v < box_.size(); ++v) {
    columns_.push_back({.factors = {{.atom = pool.Variable(VariableId(v))}}, .range = box_[v]});
    if (keep_.contains(VariableId(v))) kept_columns_.insert(ColumnId(v));
  }
  LinearPart linear = LinearPartOf(constraints);
  rows_ = std::move(linear.at_most_zero);
  variables_core_.emplace(rows_);
  for (const Inequality& inequality : linear.others) AddInequality(inequality);
}

void LinearRelaxation::AddRow(const LinearForm& at_most_zero) {
  rows_.push_back(at_most_zero);
  core_.reset();
}

// The difference greater - lesser is not negative and at most its upper form, so the upper form is
// not negative either.
void LinearRelaxation::AddInequality(const Inequality& inequality) {
  const Expression difference = inequality.greater - inequality.lesser;
  if (const std::optional<LinearForm> upper = UpperForm(difference)) AddRow(-*upper);
}

LeastOf LinearRelaxation::Sup(const Expression& e) {
  const std::optional<LinearForm> form = UpperForm(e);
  return form ? core().Sup(*form, kept_columns_) : LeastOf();
}

const LinearSupInf& LinearRelaxation::core() {
  if (!core_) core_.emplace(rows_);
  return *core_;
}

bool LinearRelaxation::IsKept(const Expression& e) const {
  return std::ranges::all_of(VariablesOf(e), [&](VariableId v) { return keep_.contains(v); });
}

// Returns a form that is nowhere less than e, or nothing if nothing bounds e.
std::optional<LinearForm> LinearRelaxation::UpperForm(const Expression& e) {
  if (std::optional<LinearForm> exact = ExactLinearForm(e)) return exact;
  LinearForm form;
  for (const NormalForm::Term& term : NormalFormOf(e).terms) {
    if (term.factors.empty()) {
      if (!std::isfinite(term.coefficient.high)) return std::nullopt;
      form.constant = form.constant + term.coefficient.high;
    } else if (!AddUpper(term.coefficient, ColumnOf(term.factors), form)) {
      return std::nullopt;
    }
  }
  return form;
}

// Adds a form that is nowhere less than coefficient * column. It is c * column + d. Here c is one
// number of the interval `coefficient`, and d is the greatest excess that another number of this
// interval can cause. Returns false if d is infinite.
bool LinearRelaxation::AddUpper(const Interval& coefficient, ColumnId column, LinearForm& form) {
  const Interval& range = RangeOf(column);
  double chosen = IsNumber(coefficient) ? coefficient.low : Midpoint(coefficient);
  if (SignOf(range) > 0 && std::isfinite(coefficient.high)) chosen = coefficient.high;
  if (SignOf(range) < 0 && std::isfinite(coefficient.low)) chosen = coefficient.low;
  const Interval rest = (coefficient - Interval{chosen, chosen}) * range;
  if (!std::isfinite(rest.high)) return false;
  form.Add(column, chosen);
  form.constant = form.constant + rest.high;
  return true;
}

ColumnId LinearRelaxation::ColumnOf(const Factors& factors) {
  if (IsVariable(factors)) {
    const ColumnId column(factors[0].atom.variable().index());
    ASSAY_CHECK(column.index() < static_cast<int>(box_.size()), "a variable without bounds");
    return column;
  }
  std::vector<std::pair<int, int>> key;
  for (const auto& [atom, exponent] : factors) key.emplace_back(atom.index(), exponent);
  if (const auto known = column_of_.find(key); known != column_of_.end()) return known->second;
  const Interval range = RangeOfProduct(factors);
  const ColumnId column(columns_.size());
  columns_.push_back({.factors = factors, .range = range});
  column_of_.emplace(std::move(key), column);
  for (const LinearForm& row : EndsOf(column, range)) AddRow(row);
  if (factors.size() == 1 && factors[0].exponent == 1) TieToOperands(column, factors[0].atom);
  if (!keep_.empty()) TieToKept(column, factors);
  return column;
}

void LinearRelaxation::TieToOperands(ColumnId column, const Expression& atom) {
  class Ties : public AtomRelations {
   public:
    Ties(LinearRelaxation& relaxation, LinearForm form)
        : relaxation_(relaxation), form_(std::move(form)) {}
    void IsAtMost(const Expression& bound) override { Add(form_, bound); }
    void NegatedIsAtMost(const Expression& bound) override { Add(-form_, bound); }

   private:
    void Add(const LinearForm& form, const Expression& bound) {
      if (const auto upper = relaxation_.UpperForm(bound)) relaxation_.AddRow(form - *upper);
    }

    LinearRelaxation& relaxation_;
    LinearForm form_;
  };
  const auto relate = atom.op().rule().relate;
  if (relate == nullptr) return;
  Ties ties(*this, FormOf(column));
  relate(ties, atom);
}

void LinearRelaxation::TieToKept(ColumnId column, const Factors& factors) {
  const auto is_kept = [&](const auto& factor) { return IsKept(factor.atom); };
  Factors kept, rest;
  std::ranges::partition_copy(factors, std::back_inserter(kept), std::back_inserter(rest), is_kept);
  if (rest.empty()) kept_columns_.insert(column);
  if (rest.empty() || kept.empty() || SignOf(RangeOfProduct(kept)) == 0) return;
  const ColumnId kept_column = ColumnOf(kept);
  const auto [sup, sup_of_negative] = SymbolicBounds(rest);
  TieToKept(column, sup, 1, kept_column);
  TieToKept(column, sup_of_negative, -1, kept_column);
}

// The column stands for R * K, and `kept` stands for K. The inequality side * R <= f is true for
// each form f. Adds this inequality multiplied by K: side * R * K <= f * K. If K is negative, adds
// the reverse inequality.
void LinearRelaxation::TieToKept(ColumnId column, const LeastOf& sup_of_rest, int side,
                                 ColumnId kept) {
  const numeric::Rational sign(SignOf(RangeOf(kept)));
  for (const LinearForm& form : sup_of_rest.Forms()) {
    AddRow(sign * (numeric::Rational(side) * FormOf(column) - Times(kept, form)));
  }
}

// Returns the bounds of the product of the factors, and the bounds of its negative.
std::pair<LeastOf, LeastOf> LinearRelaxation::SymbolicBounds(const Factors& factors) {
  if (IsVariable(factors)) {
    const LinearForm form = FormOf(ColumnOf(factors));
    return {variables_core_->Sup(form, kept_columns_), variables_core_->Sup(-form, kept_columns_)};
  }
  const Interval range = RangeOfProduct(factors);
  return {BoundOf(range.high), BoundOf(-range.low)};
}

LinearForm LinearRelaxation::Times(ColumnId column, const LinearForm& form) {
  LinearForm product;
  product.Add(column, form.constant);
  for (const auto& [other, coefficient] : form.coefficients) {
    Factors factors = columns_[column.index()].factors;
    for (const NormalForm::Factor& factor : columns_[other.index()].factors) {
      const auto same = std::ranges::find(factors, factor.atom, &NormalForm::Factor::atom);
      if (same == factors.end()) {
        factors.push_back(factor);
      } else {
        same->exponent += factor.exponent;
      }
    }
    std::ranges::sort(factors, {}, [](const auto& factor) { return factor.atom.index(); });
    product.Add(ColumnOf(factors), coefficient);
  }
  return product;
}

Expression LinearRelaxation::ProductOf(ColumnId column) const {
  Expression product = 1;
  for (const auto& [atom, exponent] : columns_[column.index()].factors) {
    product = product * Power(atom, exponent);
  }
  return product;
}

const Interval& LinearRelaxation::RangeOf(ColumnId column) {
  const bool is_variable = column.index() < static_cast<int>(box_.size());
  return is_variable ? RangeOfVariable(VariableId(column.index())) : columns_[column.index()].range;
}

const Interval& LinearRelaxation::RangeOfVariable(VariableId variable) {
  Interval& range = box_[variable.index()];
  if (tightened_[variable.index()]) return range;
  tightened_[variable.index()] = true;
  return range = TightenedInterval(variable, range, *variables_core_);
}

Interval LinearRelaxation::RangeOfProduct(const Factors& factors) {
  Interval product = {1, 1};
  for (const auto& [atom, exponent] : factors) {
    product = product * Power(RangeOfAtom(atom), exponent);
  }
  return product;
}

Interval LinearRelaxation::RangeOfAtom(const Expression& atom) {
  if (atom.op() == Operator::kVariable) return RangeOfVariable(atom.variable());
  const OperatorRule& rule = atom.op().rule();
  // A sum that was too long to be expanded is an atom, too.
  const bool is_unexpanded = rule.expand != nullptr && atom.op() != Operator::kPower;
  if (atom.IsConstant() || is_unexpanded) return RangeAsItStands(atom);
  std::vector<Interval> operands;
  for (const Expression& operand : atom.operands()) operands.push_back(RangeOf(operand));
  return rule.range(operands, atom.exponent());
}

Interval LinearRelaxation::RangeAsItStands(const Expression& e) {
  for (const VariableId variable : VariablesOf(e)) RangeOfVariable(variable);
  return Evaluate(e, box_);
}

Interval LinearRelaxation::RangeOf(const Expression& e) {
  if (e.IsConstant()) return {e.constant(), e.constant()};
  if (const auto known = range_of_.find(e.index()); known != range_of_.end()) return known->second;
  const Interval sup_inf = {-NumericSup(-e), NumericSup(e)};
  const bool is_exact = ExactLinearForm(e).has_value() && sup_inf.low <= sup_inf.high;
  const Interval range = is_exact ? sup_inf : Narrowed(RangeAsItStands(e), sup_inf);
  range_of_.emplace(e.index(), range);
  return range;
}

double LinearRelaxation::NumericSup(const Expression& e) {
  const std::optional<LinearForm> form = UpperForm(e);
  return form ? GreatestOf(*form) : kInfinity;
}

}  // namespace assay::algebra
