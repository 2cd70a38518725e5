#include "planner/algebra/multiaffine/wave_bounds.h"

namespace assay::algebra {

int WaveBounds::Add(const NestedForm& form, const MultiaffineForm& whole,
                    std::span<const int> angles, double error, double reach) {
  if (count_ == static_cast<int>(waves_.size())) waves_.emplace_back();
  Waves& waves = waves_[count_];
  waves.angles.assign(angles.begin(), angles.end());
  cosines_.clear();
  for (const int angle : angles) cosines_.push_back(whole.AtomOf(angle));
  if (!waves.sum.Assign(form, cosines_)) return -1;
  // The error covers at least 64 roundings. The factors cover the rounding of the cosines'
  // arguments and the addition of the terms.
  waves.error = error * reach * (1 + waves.sum.wave_count() / 64.0);
  return count_++;
}

const WaveEvaluation& WaveBounds::Evaluate(int number, std::span<const Sector> part) {
  const Waves& waves = waves_[number];
  box_.clear();
  for (const int angle : waves.angles) box_.emplace_back(part[angle].low, part[angle].high);
  evaluation_.Enter(waves.sum, box_);
  return evaluation_;
}

double WaveBounds::GreatestRise(int number, std::span<const Sector> part,
                                std::span<const double> slopes) {
  const Waves& waves = waves_[number];
  widths_.clear();
  places_.clear();
  for (std::size_t i = 0; i < waves.angles.size(); ++i) {
    const Sector& sector = part[waves.angles[i]];
    if (!sector.IsFree()) continue;
    places_.push_back(static_cast<int>(i));
    widths_.push_back(sector.Width());
  }
  evaluation_.greatest_curvature().CopyTo(curvature_, places_);
  quadratic_bound_.SetCurvature(curvature_, waves.error, widths_);
  return quadratic_bound_.Most(slopes);
}

}  // namespace assay::algebra
