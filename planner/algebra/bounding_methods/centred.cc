#include "planner/algebra/bounding_methods/centred.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "planner/algebra/bounds/ascent.h"
#include "planner/numeric/interval_arithmetic.h"
#include "planner/numeric/positive_definite.h"

namespace assay::algebra {
namespace {

constexpr std::size_t kMostVariablesForConcavity = 16;

// Returns the centre c at which derivative.high * (high - c), the greatest gain to the right of c,
// equals the greatest gain to the left of c.
double BestCentre(const Interval& interval, const Interval& derivative) {
  if (derivative.low >= 0) return interval.high;
  if (derivative.high <= 0) return interval.low;
  const double right = derivative.high / (derivative.high - derivative.low);
  const double centre = right * interval.high + (1 - right) * interval.low;
  return std::clamp(centre, interval.low, interval.high);
}

// Returns the form's value at c plus the greatest sum of the derivatives times the distances from
// c.
double ValuePlusSlopes(const Interval& value, std::span<const Interval> box,
                       std::span<const double> c, std::span<const Interval> gradient) {
  Interval sum = value;
  for (std::size_t i = 0; i < box.size(); ++i) {
    if (box[i].low == box[i].high) continue;
    sum = sum + gradient[i] * (box[i] - Interval{c[i], c[i]});
  }
  return sum.high;
}

// Returns the variables that are free in the box. Returns nothing if the form is affine in one of
// these variables, since it is then not strictly concave. Also returns nothing if there are too
// many free variables.
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

// Takes the tangent plane at c of a form that is concave over the box. Returns the greatest value
// of this plane over the box. A tangent plane is nowhere below a concave function. The bound is
// tight up to rounding if the form is largest at c.
double TangentUpperBound(Probe& probe, std::span<const Interval> box, std::span<const double> c) {
  const Interval value = probe.RangeAt(c);
  return ValuePlusSlopes(value, box, c, probe.GradientOverBox());
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

bool IsConcave(Probe& probe, std::span<const int> variables) {
  numeric::SymmetricMatrix centre, deviation;
  centre.Reset(static_cast<int>(variables.size()));
  deviation.Reset(centre.size());
  for (int i = 0; i < centre.size(); ++i) {
    probe.CountSecondDerivatives();
    const std::vector<Interval>& row = probe.over_box().SecondDerivatives(variables[i]);
    if (!(row[variables[i]].high < 0)) return false;
    for (int j = 0; j <= i; ++j) {
      const Interval minus = -row[variables[j]];
      centre(i, j) = Midpoint(minus);
      const Interval difference = minus - Interval{centre(i, j), centre(i, j)};
      deviation(i, j) = std::max(-difference.low, difference.high);
      if (!std::isfinite(deviation(i, j))) return false;
    }
  }
  return IsSurelyPositiveDefinite(centre, deviation);
}

}  // namespace assay::algebra
