#include "planner/algebra/sup_inf/linear_program.h"

#include <algorithm>
#include <optional>

namespace assay::algebra {
namespace {

using Kind = LinearOptimum::Kind;

// Chvatal's dictionary: basic slacks and the objective, written as forms in the non-basic columns.
// A slack is how far a row is below 0, and is not negative. A non-basic column has the value 0.
class Dictionary {
 public:
  Dictionary(const LinearForm& objective, const std::vector<LinearForm>& at_most_zero)
      : objective_(objective) {
    for (const LinearForm& row : at_most_zero) CountColumns(row);
    CountColumns(objective);
    for (std::size_t i = 0; i < at_most_zero.size(); ++i) {
      basic_.emplace(ColumnId(first_slack_ + static_cast<int>(i)), -at_most_zero[i]);
    }
    for (int column = 0; column < first_slack_; ++column) Eliminate(ColumnId(column));
  }

  LinearOptimum Solve() {
    if (!MakeFeasible()) return {.kind = Kind::kContradiction};
    // A column that could not be eliminated occurs in no row.
    if (!objective_.IsConstant() && !IsSlack(objective_.coefficients.begin()->first)) {
      return {.kind = Kind::kUnbounded};
    }
    while (const std::optional<ColumnId> entering = FirstRising(objective_)) {
      const std::optional<ColumnId> leaving = Tightest(*entering);
      if (!leaving) return {.kind = Kind::kUnbounded};
      Pivot(*leaving, *entering);
    }
    return {.kind = Kind::kFinite, .value = objective_.constant};
  }

 private:
  void CountColumns(const LinearForm& form) {
    if (form.IsConstant()) return;
    first_slack_ = std::max(first_slack_, form.coefficients.rbegin()->first.index() + 1);
  }

  bool IsSlack(ColumnId column) const { return column.index() >= first_slack_; }

  // Eliminates a column without a sign. One row is solved for it, and that row then constrains
  // nothing else.
  void Eliminate(ColumnId column) {
    for (const auto& [slack, form] : basic_) {
      if (form.CoefficientOf(column).IsZero()) continue;
      Pivot(slack, column);
      basic_.erase(column);
      return;
    }
  }

  static void Replace(ColumnId column, const LinearForm& by, LinearForm& in) {
    const numeric::Rational coefficient = in.CoefficientOf(column);
    if (!coefficient.IsZero()) in = in.Without(column) + coefficient * by;
  }

  void Pivot(ColumnId leaving, ColumnId entering) {
    const LinearForm row = basic_.extract(leaving).mapped();
    const numeric::Rational pivot = row.CoefficientOf(entering);
    const LinearForm solved =
        (numeric::Rational(1) / pivot) * (FormOf(leaving) - row.Without(entering));
    for (auto& [slack, form] : basic_) Replace(entering, solved, form);
    Replace(entering, solved, objective_);
    basic_.emplace(entering, solved);
  }

  // Returns false if the rows contradict each other.
  bool MakeFeasible() {
    const auto is_negative = [](const auto& row) { return row.second.constant.Sign() < 0; };
    for (;;) {
      const auto row = std::ranges::find_if(basic_, is_negative);
      if (row == basic_.end()) return true;
      const std::optional<ColumnId> entering = FirstRising(row->second);
      if (!entering) return false;
      Pivot(row->first, *entering);
    }
  }

  // Returns the first slack that increases the form.
  std::optional<ColumnId> FirstRising(const LinearForm& form) const {
    for (const auto& [column, coefficient] : form.coefficients) {
      if (IsSlack(column) && coefficient.Sign() > 0) return column;
    }
    return std::nullopt;
  }

  // Returns the basic slack that is the first to reach 0 as the entering slack grows.
  std::optional<ColumnId> Tightest(ColumnId entering) const {
    std::optional<ColumnId> tightest;
    numeric::Rational least;
    for (const auto& [slack, form] : basic_) {
      const numeric::Rational slope = form.CoefficientOf(entering);
      if (slope.Sign() >= 0) continue;
      const numeric::Rational room = form.constant / -slope;
      if (tightest && room >= least) continue;
      tightest = slack;
      least = room;
    }
    return tightest;
  }

  int first_slack_ = 0;  // columns below it belong to the problem
  std::map<ColumnId, LinearForm> basic_;
  LinearForm objective_;
};

}  // namespace

LinearOptimum Maximize(const LinearForm& objective, const std::vector<LinearForm>& at_most_zero) {
  return Dictionary(objective, at_most_zero).Solve();
}

}  // namespace assay::algebra
