#pragma once

#include <map>
#include <set>
#include <vector>

#include "planner/algebra/sup_inf/linear_form.h"

namespace assay::algebra {

// The result of SUP for a linear form J: J is at most the least of these forms. INF(J) is computed
// as -SUP(-J): the forms for -J are negated, and J is at least the greatest of the results.
class LeastOf {
 public:
  LeastOf() = default;  // +infinity: there is no bound
  explicit LeastOf(const LinearForm& form) { Add(form); }
  static LeastOf Contradiction();  // -infinity: no point satisfies the constraints

  void Add(const LinearForm& form);
  void Add(const LeastOf& other);

  bool IsContradiction() const { return is_contradiction_; }
  bool IsInfinite() const { return forms_.empty() && !is_contradiction_; }
  // Requires that all forms are constant. Returns a double that is not below the least of them.
  double Greatest() const;
  std::vector<LinearForm> Forms() const;  // in a fixed order; all have different coefficients

 private:
  std::map<std::map<ColumnId, numeric::Rational>, numeric::Rational>
      forms_;  // coefficients and least constant
  bool is_contradiction_ = false;
};

// SUPP(x, Y): the bound of x that follows from x <= Y (Bledsoe 1975).
LeastOf Supp(ColumnId x, const LinearForm& y);

// SUP over linear inequalities (Bledsoe 1975, Shostak 1977). A column that may not occur in the
// answer is replaced by its own bounds. It may occur in these bounds until SUPP has solved for it.
//
// The answer for a single column is exact if no column is kept and the inequalities do not
// contradict each other. For a sum the published procedure is too loose: it takes the greatest
// value of each of several bounds separately, instead of the greatest value of their minimum. For x
// + y over y <= x, y <= 4 - 2x, 0 <= x <= 2 it would give 4. Therefore a sum J gets a column w of
// its own, with w <= J. SUP(w) is SUP(J), and the bounds of w are solved for w like those of any
// other column.
//
// The number of steps may be exponential. After kMostSteps steps for one question the simplex
// method answers instead. Its answer is just as exact, but it is always a number, even if there are
// columns to keep.
class LinearSupInf {
 public:
  static constexpr int kMostSteps = 200;  // examined bounds of columns and of forms

  explicit LinearSupInf(std::vector<LinearForm> at_most_zero, int most_steps = kMostSteps);

  LeastOf Sup(const LinearForm& j, const std::set<ColumnId>& keep) const;

 private:
  bool IsAlone(ColumnId column) const;
  LeastOf SupOfAlone(const LinearForm& j) const;
  LeastOf SupOfTied(const LinearForm& j, const std::set<ColumnId>& keep) const;
  ColumnId NewColumn(const LinearForm& j, const std::set<ColumnId>& keep) const;
  std::vector<LinearForm> RelatedTo(const LinearForm& j) const;

  std::vector<LinearForm> rows_;                         // each is at most 0
  std::map<ColumnId, std::vector<std::size_t>> places_;  // for each column, the rows with it
  int columns_ = 0;                                      // all columns have smaller numbers
  int most_steps_;
};

}  // namespace assay::algebra
