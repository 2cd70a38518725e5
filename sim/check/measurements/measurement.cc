#include "sim/check/measurements/measurement.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "planner/base/check.h"

namespace assay::check {

const std::vector<Measurement>& KnownMeasurements() {
  static const std::vector<Measurement> measurements = [] {
    std::vector<Measurement> all;
    for (const auto& some :
         {GraspMeasurements(), LandingMeasurements(), MatingMeasurements(), HandMeasurements()}) {
      std::ranges::copy(some, std::back_inserter(all));
    }
    return all;
  }();
  return measurements;
}

const Measurement& MeasurementOf(plan::Condition condition,
                                 const std::vector<Measurement>& measurements) {
  const auto found = std::ranges::find(measurements, condition, &Measurement::condition);
  ASSAY_CHECK(found != measurements.end(), "nothing says how '{}' is measured", condition.name());
  return *found;
}

void AddFinite(std::string subject, double observed, std::vector<MeasuredMargin>& measured) {
  if (std::isfinite(observed)) measured.push_back({std::move(subject), observed});
}

void AddClearance(std::string subject, double distance, std::vector<MeasuredMargin>& measured) {
  constexpr double kOverlap = 1e-3;  // metres, of unknown depth
  if (!std::isfinite(distance)) return;
  measured.push_back({.subject = std::move(subject),
                      .observed = distance > 0 ? distance : -kOverlap,
                      .is_at_least_the_margin = false});
}

std::vector<MeasuredMargin> OfAll(double observed) {
  std::vector<MeasuredMargin> measured;
  AddFinite({}, observed, measured);
  return measured;
}

}  // namespace assay::check
