#include "planner/algebra/sup_inf/linear_sup_inf.h"

#include <algorithm>
#include <utility>

#include "planner/algebra/sup_inf/linear_program.h"
#include "planner/base/budget.h"
#include "planner/base/check.h"
#include "planner/numeric/interval_arithmetic.h"

namespace assay::algebra {
namespace {

using Keep = std::set<ColumnId>;

// The column v (sign = 1) or -v (sign = -1). The published LOWER and INFF of v are UPPER and SUPP
// of -v.
struct SignedColumn {
  ColumnId column;
  int sign = 1;

  auto operator<=>(const SignedColumn&) const = default;
};

LeastOf SuppOfSigned(SignedColumn x, const LinearForm& y) {
  // Solves x <= b*x + rest for x.
  const numeric::Rational b = numeric::Rational(x.sign) * y.CoefficientOf(x.column);
  const LinearForm rest = y.Without(x.column);
  if (b < 1) return LeastOf((numeric::Rational(1) / (numeric::Rational(1) - b)) * rest);
  const bool is_false = b == 1 && rest.IsConstant() && rest.constant.Sign() < 0;
  return is_false ? LeastOf::Contradiction() : LeastOf();
}

Keep With(const Keep& keep, ColumnId column) {
  Keep more = keep;
  more.insert(column);
  return more;
}

// The recursion for one question, with the results it has already found.
class Recursion {
 public:
  Recursion(const std::vector<LinearForm>& rows, int most_steps) : budget_(most_steps) {
    for (const LinearForm& row : rows) {
      for (const auto& [column, coefficient] : row.coefficients) {
        const LinearForm rest = (numeric::Rational(-1) / Abs(coefficient)) * row.Without(column);
        upper_[{column, coefficient.Sign()}].Add(rest);
      }
    }
  }

  bool Exhausted() const { return budget_.Exhausted(); }

  // Computes SUP for J = r*v + B. While v is kept, B is at most the least of some forms B'. Each
  // r*v + B' contains only v and kept columns, and v is then replaced by its bounds.
  LeastOf Sup(const LinearForm& j, const Keep& keep) {
    const auto v = FirstNotKept(j, keep);
    if (v.IsNone()) return LeastOf(j);
    const LinearForm rest = j.Without(v);
    const LeastOf bound = rest.IsConstant() ? LeastOf(rest) : Sup(rest, With(keep, v));
    if (bound.IsContradiction()) return bound;
    LeastOf sup;
    for (const LinearForm& b : bound.Forms()) {
      const numeric::Rational r = j.CoefficientOf(v) + b.CoefficientOf(v);
      sup.Add(SupOfMultiple(r, v, b.Without(v), keep));
      if (Exhausted()) return {};
    }
    return sup;
  }

 private:
  static ColumnId FirstNotKept(const LinearForm& j, const Keep& keep) {
    for (const auto& [column, coefficient] : j.coefficients) {
      if (!keep.contains(column)) return column;
    }
    return ColumnId::None();
  }

  // Returns SUP of r*v + rest, where only v is not kept.
  LeastOf SupOfMultiple(const numeric::Rational& r, ColumnId v, const LinearForm& rest,
                        const Keep& keep) {
    if (r.IsZero()) return LeastOf(rest);
    const LeastOf& of_column = SupOfColumn({v, r.Sign()}, keep);
    if (of_column.IsContradiction()) return of_column;
    LeastOf sup;
    for (const LinearForm& form : of_column.Forms()) {
      budget_.Spend();
      sup.Add(Abs(r) * form + rest);
    }
    return sup;
  }

  const LeastOf& SupOfColumn(SignedColumn v, const Keep& keep) {
    const auto [place, is_new] = known_.try_emplace({v, keep});
    if (!is_new || !budget_.Spend()) return place->second;
    LeastOf sup;
    const Keep with_v = With(keep, v.column);
    for (const LinearForm& upper : upper_[v].Forms()) {
      const LeastOf bound = Sup(upper, with_v);
      if (bound.IsContradiction()) sup.Add(bound);
      for (const LinearForm& y : bound.Forms()) sup.Add(SuppOfSigned(v, y));
    }
    return place->second = std::move(sup);
  }

  Budget budget_;
  std::map<SignedColumn, LeastOf> upper_;  // the bounds that the paper calls UPPER
  std::map<std::pair<SignedColumn, Keep>, LeastOf> known_;
};

LeastOf SupBySimplex(const LinearForm& j, const std::vector<LinearForm>& rows) {
  const LinearOptimum optimum = Maximize(j, rows);
  switch (optimum.kind) {
    case LinearOptimum::Kind::kFinite:
      return LeastOf(LinearForm{.constant = optimum.value});
    case LinearOptimum::Kind::kUnbounded:
      return {};
    case LinearOptimum::Kind::kContradiction:
      return LeastOf::Contradiction();
  }
  return {};
}

}  // namespace

LeastOf LeastOf::Contradiction() {
  LeastOf least;
  least.is_contradiction_ = true;
  return least;
}

void LeastOf::Add(const LinearForm& form) {
  if (is_contradiction_) return;
  const auto [place, is_new] = forms_.emplace(form.coefficients, form.constant);
  if (!is_new && form.constant < place->second) place->second = form.constant;
}

void LeastOf::Add(const LeastOf& other) {
  if (other.is_contradiction_) *this = other;
  for (const auto& [coefficients, constant] : other.forms_) Add({coefficients, constant});
}

double LeastOf::Greatest() const {
  if (is_contradiction_) return -kInfinity;
  if (forms_.empty()) return kInfinity;
  const auto& [coefficients, constant] = *forms_.begin();
  ASSAY_CHECK(coefficients.empty(), "not a number");
  return constant.RoundedUp();
}

std::vector<LinearForm> LeastOf::Forms() const {
  std::vector<LinearForm> forms;
  for (const auto& [coefficients, constant] : forms_) forms.push_back({coefficients, constant});
  return forms;
}

LeastOf Supp(ColumnId x, const LinearForm& y) { return SuppOfSigned({x, 1}, y); }

LinearSupInf::LinearSupInf(std::vector<LinearForm> at_most_zero, int most_steps)
    : rows_(std::move(at_most_zero)), most_steps_(most_steps) {
  for (std::size_t row = 0; row < rows_.size(); ++row) {
    for (const auto& [column, coefficient] : rows_[row].coefficients) {
      places_[column].push_back(row);
      columns_ = std::max(columns_, column.index() + 1);
    }
  }
}

// A column that no row relates to others is bounded by itself, independently of all other columns.
LeastOf LinearSupInf::Sup(const LinearForm& j, const std::set<ColumnId>& keep) const {
  LinearForm alone, tied;
  for (const auto& [column, coefficient] : j.coefficients) {
    LinearForm& part = !keep.contains(column) && IsAlone(column) ? alone : tied;
    part.Add(column, coefficient);
  }
  alone.constant = j.constant;
  const LeastOf number = SupOfAlone(alone);
  if (tied.IsConstant() || number.IsContradiction() || number.IsInfinite()) return number;
  const LeastOf rest = SupOfTied(tied, keep);
  if (rest.IsContradiction()) return rest;
  LeastOf sup;
  for (const LinearForm& form : rest.Forms()) sup.Add(form + number.Forms().front());
  return sup;
}

bool LinearSupInf::IsAlone(ColumnId column) const {
  const auto places = places_.find(column);
  if (places == places_.end()) return true;
  return std::ranges::all_of(places->second,
                             [&](std::size_t row) { return rows_[row].coefficients.size() == 1; });
}

LeastOf LinearSupInf::SupOfAlone(const LinearForm& j) const {
  LinearForm sum{.constant = j.constant};
  for (const auto& [column, coefficient] : j.coefficients) {
    LeastOf ends;
    const auto places = places_.find(column);
    if (places == places_.end()) return {};
    for (const std::size_t row : places->second) {
      const numeric::Rational r = rows_[row].CoefficientOf(column);
      if (r.Sign() != coefficient.Sign()) continue;
      ends.Add(LinearForm{.constant = -coefficient * rows_[row].constant / r});
    }
    if (ends.IsInfinite()) return ends;
    sum.constant = sum.constant + ends.Forms().front().constant;
  }
  return LeastOf(sum);
}

ColumnId LinearSupInf::NewColumn(const LinearForm& j, const std::set<ColumnId>& keep) const {
  int columns = std::max(columns_, j.coefficients.rbegin()->first.index() + 1);
  if (!keep.empty()) columns = std::max(columns, keep.rbegin()->index() + 1);
  return ColumnId(columns);
}

LeastOf LinearSupInf::SupOfTied(const LinearForm& j, const std::set<ColumnId>& keep) const {
  std::vector<LinearForm> rows = RelatedTo(j);
  const ColumnId w = NewColumn(j, keep);
  const bool is_column = j.coefficients.size() == 1;
  if (!is_column) rows.push_back(FormOf(w) - j);
  Recursion recursion(rows, most_steps_);
  const LeastOf sup = recursion.Sup(is_column ? j : FormOf(w), keep);
  return recursion.Exhausted() ? SupBySimplex(j, rows) : sup;
}

// Returns the rows that are connected with j: those that contain a column of j, or a column that is
// connected through other such rows.
std::vector<LinearForm> LinearSupInf::RelatedTo(const LinearForm& j) const {
  std::set<std::size_t> related;
  Keep seen;
  std::vector<ColumnId> pending;
  const auto reach = [&](const LinearForm& form) {
    for (const auto& [column, coefficient] : form.coefficients) {
      if (seen.insert(column).second) pending.push_back(column);
    }
  };
  reach(j);
  while (!pending.empty()) {
    const auto places = places_.find(pending.back());
    pending.pop_back();
    if (places == places_.end()) continue;
    for (const std::size_t row : places->second) {
      if (related.insert(row).second) reach(rows_[row]);
    }
  }
  std::vector<LinearForm> rows;
  for (const std::size_t row : related) rows.push_back(rows_[row]);
  return rows;
}

}  // namespace assay::algebra
