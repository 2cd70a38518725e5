#pragma once

#include <map>
#include <optional>
#include <set>
#include <unordered_map>
#include <utility>
#include <vector>

#include "planner/algebra/forms/normal_form.h"
#include "planner/algebra/linear/constraint_set.h"
#include "planner/algebra/linear/linear_sup_inf.h"

namespace assay::algebra {

// Non-linear expressions and constraints in linear terms, so that SUP/INF's linear core can bound
// them: every non-linear product of a normal form is a column like a variable (the rules are in the
// spirit of Brooks 1981). What ties the columns:
//   - a product lies in the range that interval arithmetic gives it, its factors taken numerically;
//   - min(a, b) <= a and b, max(a, b) >= a and b, abs(a) >= a and -a;
//   - a product R*K, K of kept variables alone and of known sign, lies between K times what bounds
//     R: symbolic bounds if R is a variable, else numbers. K of unknown sign leaves the range;
//   - the constraints, likewise: a product's column is the same one in all of them.
// Every column's bounds hold at every point that the constraints allow, so SUP is never too small.
class LinearRelaxation {
 public:
  LinearRelaxation(ExpressionPool& pool, const ConstraintSet& constraints,
                   std::set<VariableId> keep);

  // Bounds of e in the kept columns; none is kept for RangeOf, which is never worse than interval
  // arithmetic on e as it stands.
  LeastOf Sup(const Expression& e);
  Interval RangeOf(const Expression& e);

  bool IsKept(const Expression& e) const;  // speaks of kept variables alone
  double GreatestOf(const LinearForm& form) { return core().Sup(form, {}).Greatest(); }
  const Interval& RangeOf(ColumnId column);
  Expression ProductOf(ColumnId column) const;

 private:
  using Factors = std::vector<NormalForm::Factor>;
  struct Column {
    Factors factors;
    Interval range;  // of a variable: as declared; box_ knows more
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
  std::vector<Interval> box_;                                       // tightened where asked for
  std::vector<bool> tightened_;                                     // by VariableId
  std::vector<Column> columns_;                                     // the variables' come first
  std::map<std::vector<std::pair<int, int>>, ColumnId> column_of_;  // atom's index and exponent
  std::vector<LinearForm> rows_;
  std::optional<LinearSupInf> core_;            // over rows_, unless they have changed
  std::optional<LinearSupInf> variables_core_;  // over the rows that speak of variables alone
  std::unordered_map<int, Interval> range_of_;  // by an expression's index
};

}  // namespace assay::algebra
