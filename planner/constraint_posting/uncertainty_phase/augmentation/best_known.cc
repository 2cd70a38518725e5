#include "planner/constraint_posting/uncertainty_phase/augmentation/best_known.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "planner/base/check.h"

namespace assay::constraint_posting {
namespace {

using uncertainty::Propagation;
using uncertainty::SnapshotId;
using uncertainty::UncertainWorld;
using uncertainty::Unproved;

const domain::SensorModel& SensorNamed(const domain::Problem& problem, const std::string& name) {
  const auto* sensor = problem.workcell->uncertainty_operations().FindSensor(name);
  ASSAY_CHECK(sensor != nullptr, "the workcell has no sensor '{}'", name);
  return *sensor;
}

bool HoldsZero(const Interval& range) { return range.low <= 0 && range.high >= 0; }
template <class Error>
bool HoldsZero(const Error& error) {
  return HoldsZero(error.x) && HoldsZero(error.y) && HoldsZero(error.z) && HoldsZero(error.theta);
}

bool MeasuresHeights(const domain::Problem& problem) {
  return std::ranges::any_of(problem.sensors, [&](const std::string& name) {
    const Interval& promise = SensorNamed(problem, name).z;
    return std::isfinite(promise.low) && std::isfinite(promise.high);
  });
}

}  // namespace

bool BestKnown::Bounds(const domain::Problem& problem, Propagation propagation) {
  const auto sensor_holds_zero = [&](const std::string& name) {
    return HoldsZero(SensorNamed(problem, name));
  };
  return propagation == Propagation::kSound && HoldsZero(problem.gripper_error) &&
         std::ranges::all_of(problem.sensors, sensor_holds_zero) &&
         std::ranges::all_of(problem.parts,
                             [](const domain::Part& part) { return HoldsZero(part.error); });
}

BestKnown::BestKnown(const domain::Problem& problem, Propagation propagation,
                     const algebra::BoundRequest& bound)
    : problem_(problem),
      worlds_(problem, propagation, bound, [heights = MeasuresHeights(problem)](UncertainWorld& w) {
        w.TellWherePartsRest(heights);
      }) {}

SnapshotId BestKnown::After(SnapshotId before, const plan::Action& action,
                            const plan::Strategy* strategy) {
  return worlds_.After(FirstAlike(before), action, strategy);
}

SnapshotId BestKnown::FirstAlike(SnapshotId snapshot) {
  const auto [known, is_new] = first_alike_.try_emplace(snapshot, snapshot);
  if (is_new) known->second = FindAlike(snapshot);
  return known->second;
}

SnapshotId BestKnown::FindAlike(SnapshotId snapshot) {
  const UncertainWorld& world = worlds_.WorldAt(snapshot);
  if (!world.in_hand().IsNone()) return snapshot;
  const auto is_alike = [&](SnapshotId other) {
    const UncertainWorld& known = worlds_.WorldAt(other);
    for (std::size_t p = 0; p < problem_.parts.size(); ++p) {
      const domain::PartId part(p);
      if (known.X_WorldPart(part).matrix() != world.X_WorldPart(part).matrix()) return false;
    }
    return true;
  };
  const auto known = std::ranges::find_if(with_empty_hand_, is_alike);
  if (known != with_empty_hand_.end()) return *known;
  return with_empty_hand_.emplace_back(snapshot);
}

std::vector<Unproved> BestKnown::UnprovedAt(SnapshotId after,
                                            const std::vector<plan::Condition>& absorbable) {
  std::vector<Unproved> unproved;
  std::ranges::copy_if(worlds_.UnprovedAt(after), std::back_inserter(unproved),
                       [&](const Unproved& goal) {
                         return std::ranges::count(absorbable, goal.claim.condition) == 0;
                       });
  return unproved;
}

Shortfall BestKnown::LeastShortfall(SnapshotId after,
                                    const std::vector<plan::Condition>& absorbable) {
  Shortfall least;
  for (const Unproved& unproved : worlds_.UnprovedAt(after)) {
    if (std::ranges::count(absorbable, unproved.claim.condition) > 0) continue;
    ++least.goals;
    least.violation += uncertainty::LeastViolation(unproved, worlds_.WorldAt(after));
  }
  return least;
}

}  // namespace assay::constraint_posting
