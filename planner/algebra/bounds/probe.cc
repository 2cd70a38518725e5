#include "planner/algebra/bounds/probe.h"

#include <algorithm>

#include "planner/numeric/interval_arithmetic.h"

namespace assay::algebra {

Probe::Probe(const Maximization& problem)
    : problem_(problem),
      over_box_(problem.objective),
      at_point_(problem.objective),
      slacks_(problem.slacks.begin(), problem.slacks.end()),
      slacks_at_point_(problem.slacks.begin(), problem.slacks.end()) {
  if (problem.as_written) as_written_.emplace(*problem.as_written);
}

Interval Probe::Range(std::span<const Interval> box) {
  ++evaluations_;
  return over_box_.Value(box);
}

const std::vector<Interval>& Probe::GradientOverBox() { return over_box_.Gradient(); }

const Box& Probe::BoxOf(std::span<const double> point) {
  point_box_.clear();
  for (double x : point) point_box_.push_back({x, x});
  return point_box_;
}

Interval Probe::RangeAt(std::span<const double> point) { return Range(BoxOf(point)); }

bool Probe::SurelyInfeasible(std::span<const Interval> box) {
  return std::any_of(slacks_.begin(), slacks_.end(), [&](Derivatives<Interval>& slack) {
    const Interval range = slack.Value(box);
    return range.high < 0 || !slack.DefinedSomewhere();
  });
}

bool Probe::SurelyFeasible(std::span<const double> point) {
  const Box& box = BoxOf(point);
  return std::all_of(slacks_.begin(), slacks_.end(), [&](Derivatives<Interval>& slack) {
    const Interval range = slack.Value(box);
    return range.low >= 0 && slack.DefinedEverywhere();
  });
}

double Probe::Value(std::span<const double> point) {
  ++evaluations_;
  return at_point_.Value(point);
}

const std::vector<double>& Probe::Gradient() { return at_point_.Gradient(); }

bool Probe::IsDefinedAsWritten(std::span<const double> point) {
  if (!as_written_) return true;
  as_written_->Value(BoxOf(FullPoint(problem_, point)));
  return as_written_->DefinedEverywhere();
}

bool Probe::Offer(std::span<const double> point) {
  if (!SurelyFeasible(point)) return false;
  const Interval range = RangeAt(point);
  if (!over_box_.DefinedEverywhere() || !(range.low > best_value_)) return false;
  if (!IsDefinedAsWritten(point)) return false;
  best_value_ = range.low;
  best_point_.assign(point.begin(), point.end());
  return true;
}

std::vector<double> CentreOf(std::span<const Interval> box) {
  std::vector<double> centre;
  for (const Interval& interval : box) centre.push_back(Midpoint(interval));
  return centre;
}

}  // namespace assay::algebra
