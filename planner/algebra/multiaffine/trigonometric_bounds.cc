#include "planner/algebra/multiaffine/trigonometric_bounds.h"

namespace assay::algebra {

int TrigonometricBounds::Add(const NestedForm& form, const MultiaffineForm& whole,
                             std::span<const int> angles, double error, double reach) {
  if (count_ == static_cast<int>(polynomials_.size())) polynomials_.emplace_back();
  Polynomial& polynomial = polynomials_[count_];
  polynomial.angles.assign(angles.begin(), angles.end());
  cosines_.clear();
  for (const int angle : angles) cosines_.push_back(whole.AtomOf(angle));
  if (!polynomial.sum.Assign(form, cosines_)) return -1;
  // The error covers at least 64 roundings. The factors cover the rounding of the cosines'
  // arguments and the addition of the terms.
  polynomial.error = error * reach * (1 + polynomial.sum.term_count() / 64.0);
  return count_++;
}

const TrigonometricEvaluation& TrigonometricBounds::Evaluate(int number,
                                                             std::span<const Sector> part) {
  const Polynomial& polynomial = polynomials_[number];
  box_.clear();
  for (const int angle : polynomial.angles) box_.emplace_back(part[angle].low, part[angle].high);
  evaluation_.Enter(polynomial.sum, box_);
  return evaluation_;
}

double TrigonometricBounds::GreatestRise(int number, std::span<const Sector> part,
                                         std::span<const double> slopes) {
  const Polynomial& polynomial = polynomials_[number];
  widths_.clear();
  places_.clear();
  for (std::size_t i = 0; i < polynomial.angles.size(); ++i) {
    const Sector& sector = part[polynomial.angles[i]];
    if (!sector.IsFree()) continue;
    places_.push_back(static_cast<int>(i));
    widths_.push_back(sector.Width());
  }
  evaluation_.greatest_curvature().CopyTo(curvature_, places_);
  quadratic_bound_.SetCurvature(curvature_, polynomial.error, widths_);
  return quadratic_bound_.Most(slopes);
}

}  // namespace assay::algebra
