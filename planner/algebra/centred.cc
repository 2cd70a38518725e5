#include "planner/algebra/centred.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "planner/algebra/ascent.h"
#include "planner/algebra/interval_arithmetic.h"

namespace assay::algebra {
namespace {

constexpr std::size_t kMostVariablesForConcavity = 16;

// Where derivative.high * (high - c), the most to the right of c, equals what is to its left.
double BestCentre(const Interval& interval, const Interval& derivative) {
  if (derivative.low >= 0) return interval.high;
  if (derivative.high <= 0) return interval.low;
  const double right = derivative.high / (derivative.high - derivative.low);
  const double centre = right * interval.high + (1 - right) * interval.low;
  return std::clamp(centre, interval.low, interval.high);
}

// The form's value at c plus the most that the derivatives times the distances from c can be.
double ValuePlusSlopes(const Interval& value, std::span<const Interval> box,
                       std::span<const double> c, std::span<const Interval> gradient) {
  Interval sum = value;
  for (std::size_t i = 0; i < box.size(); ++i) {
    if (box[i].low == box[i].high) continue;
    sum = sum + gradient[i] * (box[i] - Interval{c[i], c[i]});
  }
  return sum.high;
}

// The entry of a symmetric family of matrices: its midpoint and by how much it may differ.
struct Entry {
  double centre = 0;
  double deviation = 0;
};

// Whether every symmetric matrix between the entries (a lower triangle, by rows) is positive
// definite. Taking from each diagonal entry of the centre the sum of its row's deviations gives a
// matrix that is less than all of the family (for a deviation d, 2*d*x*y >= -|d|*(x^2 + y^2)); it
// is positive definite if Gauss's elimination, outward-rounded, meets positive pivots only.
bool IsPositiveDefinite(const std::vector<std::vector<Entry>>& entries) {
  const std::size_t n = entries.size();
  std::vector<std::vector<Interval>> m(n, std::vector<Interval>(n));
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      m[i][j] = m[j][i] = {entries[i][j].centre, entries[i][j].centre};
    }
    for (std::size_t j = 0; j < n; ++j) {
      const double deviation = entries[std::max(i, j)][std::min(i, j)].deviation;
      m[i][i] = m[i][i] - Interval{deviation, deviation};
    }
  }
  for (std::size_t k = 0; k < n; ++k) {
    if (!(m[k][k].low > 0)) return false;
    for (std::size_t i = k + 1; i < n; ++i) {
      const Interval factor = m[i][k] / m[k][k];
      for (std::size_t j = k + 1; j < n; ++j) m[i][j] = m[i][j] - factor * m[k][j];
    }
  }
  return true;
}

// The variables with freedom, if the form can be strictly concave in them: none is affine, and
// there are not too many.
std::optional<std::vector<int>> VariablesThatBend(const CompiledForm& form,
                                                  std::span<const Interval> box) {
  std::vector<int> free;
  for (std::size_t i = 0; i < box.size(); ++i) {
    if (box[i].low == box[i].high) continue;
    if (form.affine[i] || free.size() == kMostVariablesForConcavity) return std::nullopt;
    free.push_back(static_cast<int>(i));
  }
  return free;
}

}  // namespace

double UpperBoundByDerivatives(Probe& probe, std::span<const Interval> box,
                               std::span<const Interval> gradient) {
  const double centred = CentredUpperBound(probe, box, gradient);
  if (centred <= probe.best_value()) return centred;
  const auto free = VariablesThatBend(probe.problem().objective, box);
  if (!free) return centred;
  probe.Range(box);
  probe.GradientOverBox();
  if (!IsConcave(probe, *free)) return centred;
  const std::vector<double> top = AscendFrom(CentreOf(box), probe, box);
  probe.Offer(top);
  const double tangent = TangentUpperBound(probe, box, top);
  return tangent < centred ? tangent : centred;
}

double CentredUpperBound(Probe& probe, std::span<const Interval> box,
                         std::span<const Interval> gradient) {
  std::vector<double> c;
  for (std::size_t i = 0; i < box.size(); ++i) {
    c.push_back(BestCentre(box[i], gradient[i]));
    if (!std::isfinite(c.back())) return kInfinity;
  }
  const Interval value = probe.RangeAt(c);
  if (!probe.over_box().DefinedEverywhere()) return kInfinity;
  return ValuePlusSlopes(value, box, c, gradient);
}

double TangentUpperBound(Probe& probe, std::span<const Interval> box, std::span<const double> c) {
  const Interval value = probe.RangeAt(c);
  return ValuePlusSlopes(value, box, c, probe.GradientOverBox());
}

bool IsConcave(Probe& probe, std::span<const int> variables) {
  std::vector<std::vector<Entry>> entries;
  for (std::size_t i = 0; i < variables.size(); ++i) {
    probe.CountSecondDerivatives();
    const std::vector<Interval>& row = probe.over_box().SecondDerivatives(variables[i]);
    if (!(row[variables[i]].high < 0)) return false;
    entries.emplace_back();
    for (std::size_t j = 0; j <= i; ++j) {
      const Interval minus = -row[variables[j]];
      const double centre = Midpoint(minus);
      const Interval difference = minus - Interval{centre, centre};
      entries.back().push_back({centre, std::max(-difference.low, difference.high)});
      if (!std::isfinite(entries.back().back().deviation)) return false;
    }
  }
  return IsPositiveDefinite(entries);
}

}  // namespace assay::algebra
