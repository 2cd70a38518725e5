#pragma once

#include <map>
#include <optional>
#include <set>
#include <unordered_map>
#include <utility>
#include <vector>

#include "planner/algebra/normal_forms/normal_form.h"
#include "planner/algebra/sup_inf/constraint_set.h"
#include "planner/algebra/sup_inf/linear_sup_inf.h"

namespace assay::algebra {

// Writes non-linear expressions and constraints in linear terms, so that SUP/INF's linear core can
// bound them. Every non-linear product of a normal form becomes a column, like a variable (the
// rules are in the spirit of Brooks 1981). These constraints relate the columns:
// - A product lies in the range that interval arithmetic gives it from the ranges of its factors.
// - min(a, b) <= a and b; max(a, b) >= a and b; abs(a) >= a and -a.
// - A product R*K, where K contains only kept variables and has a known sign, lies between K times
//   the bounds of R. The bounds of R are symbolic if R is a variable, and numbers otherwise. If the
//   sign of K is unknown, only the range is used.
// - The given constraints hold. A product has the same column in all constraints. Every constraint
//   holds at every point that the given constraints allow, so SUP is never too small.
class LinearRelaxation {
 public:
  LinearRelaxation(ExpressionPool& pool, const ConstraintSet& constraints,
                   std::set<VariableId> keep);

  // Return bounds of e. Sup gives bounds in the kept columns. RangeOf keeps no column, and it is
  // never worse than interval arithmetic on e as it is written.
  LeastOf Sup(const Expression& e);
  Interval RangeOf(const Expression& e);

  bool IsKept(const Expression& e) const;  // contains kept variables only
  double GreatestOf(const LinearForm& form) { return core().Sup(form, {}).Greatest(); }
  const Interval& RangeOf(ColumnId column);
  Expression ProductOf(ColumnId column) const;

 private:
  using Factors = std::vector<NormalForm::Factor>;
  struct Column {
    Factors factors;
    Interval range;  // range of the product; for a variable the declared one (box_ may be tighter)
  };

  void AddRow(const LinearForm& at_most_zero);
  void AddInequality(const Inequality& inequality);

  std::optional<LinearForm> UpperForm(const Expression& e);
  bool AddUpper(const Interval& coefficient, ColumnId column, LinearForm& form);
  ColumnId ColumnOf(const Factors& factors);
  void TieToOperands(ColumnId column, const Expression& atom);
  void TieToKept(ColumnId column, const Factors& factors);
  void TieToKept(ColumnId column, const LeastOf& sup_of_rest, int side, ColumnId kept);
  std::pair<LeastOf, LeastOf> SymbolicBounds(const Factors& factors);
  LinearForm Times(ColumnId column, const LinearForm& form);

  const LinearSupInf& core();
  double NumericSup(const Expression& e);
  const Interval& RangeOfVariable(VariableId variable);
  Interval RangeOfProduct(const Factors& factors);
  Interval RangeOfAtom(const Expression& atom);
  Interval RangeAsItStands(const Expression& e);

  std::set<VariableId> keep_;
  std::set<ColumnId> kept_columns_;
  std::vector<Interval> box_;    // tightened on demand
  std::vector<bool> tightened_;  // indexed by VariableId
  std::vector<Column> columns_;  // the variables' columns come first
  std::map<std::vector<std::pair<int, int>>, ColumnId> column_of_;  // indexed by atom and exponent
  std::vector<LinearForm> rows_;
  std::optional<LinearSupInf> core_;            // over rows_; empty after rows_ has changed
  std::optional<LinearSupInf> variables_core_;  // over the rows that contain variables only
  std::unordered_map<int, Interval> range_of_;  // indexed by an expression's index
};

}  // namespace assay::algebra
