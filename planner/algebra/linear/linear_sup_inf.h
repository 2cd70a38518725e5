#pragma once

#include <map>
#include <set>
#include <vector>

#include "planner/algebra/linear/linear_form.h"

namespace assay::algebra {

// What SUP says of a linear form: it is at most the least of these. INF is the mirror image: INF(J)
// is -SUP(-J), the greatest of the negated forms.
class LeastOf {
 public:
  LeastOf() = default;  // +infinity: nothing is said
  explicit LeastOf(const LinearForm& form) { Add(form); }
  static LeastOf Contradiction();  // -infinity: there is nothing to speak of

  void Add(const LinearForm& form);
  void Add(const LeastOf& other);

  bool IsContradiction() const { return is_contradiction_; }
  bool IsInfinite() const { return forms_.empty() && !is_contradiction_; }
  double Greatest() const;  // of numbers alone: a double that is not below the least of them
  std::vector<LinearForm> Forms() const;  // each with other coefficients, in a fixed order

 private:
  std::map<std::map<ColumnId, Rational>, Rational> forms_;  // coefficients and least constant
  bool is_contradiction_ = false;
};

// SUPP(x, Y): what x <= Y says of x alone (Bledsoe 1975).
LeastOf Supp(ColumnId x, const LinearForm& y);

// SUP over linear inequalities (Bledsoe 1975, Shostak 1977): a column that may not stay in the
// answer gives way to its own bounds, in which it may stay until SUPP has solved for it.
//
// The answer for a single column is exact if none is kept and the inequalities do not contradict
// each other. Of a sum the procedure as published asks too little: it takes the greatest value of
// each of several bounds alone, where the greatest of their minimum is meant (x + y over y <= x, y
// <= 4 - 2x, 0 <= x <= 2 would get 4). So a sum J gets a column w of its own, with w <= J: SUP(w)
// is SUP(J), and what bounds w is solved for w like any other.
//
// There may be exponentially many steps. After kMostSteps of one question the simplex method
// answers instead, just as exactly, but always by a number, also if there are columns to keep.
class LinearSupInf {
 public:
  static constexpr int kMostSteps = 200;  // bounds of columns and forms looked at

  explicit LinearSupInf(std::vector<LinearForm> at_most_zero, int most_steps = kMostSteps);

  LeastOf Sup(const LinearForm& j, const std::set<ColumnId>& keep) const;

 private:
  bool IsAlone(ColumnId column) const;
  LeastOf SupOfAlone(const LinearForm& j) const;
  LeastOf SupOfTied(const LinearForm& j, const std::set<ColumnId>& keep) const;
  ColumnId NewColumn(const LinearForm& j, const std::set<ColumnId>& keep) const;
  std::vector<LinearForm> RelatedTo(const LinearForm& j) const;

  std::vector<LinearForm> rows_;                         // each at most 0
  std::map<ColumnId, std::vector<std::size_t>> places_;  // of columns in rows
  int columns_ = 0;                                      // numbered below this
  int most_steps_;
};

}  // namespace assay::algebra
