#include "planner/uncertainty/error_sets/sensing.h"

#include <array>

#include "planner/algebra/expression/simplify.h"
#include "planner/base/check.h"
#include "planner/numeric/interval_arithmetic.h"

namespace assay::uncertainty {
namespace {

// Replaces `error` by a new variable if the promise is narrower. The believed pose shifts by the
// difference, because the part stays where it is.
void Measure(UncertainWorld& world, PartId part, const plan::ErrorKind& kind,
             const ErrorSource& sensor, const Interval& promise, Expression& error,
             Expression& shift) {
  if (!TakesOver(world.TightRangeOf(error), promise)) return;
  const Expression measured = world.Declare(kind, promise, part, sensor);
  shift = algebra::Simplify(shift + error - measured);
  error = measured;
}

}  // namespace

bool TakesOver(const Interval& known, const Interval& promise) {
  return Width(promise) < Width(known);
}

void ApplySensing(UncertainWorld& world, PartId part, const std::string& sensor) {
  const domain::Workcell& workcell = *world.problem().workcell;
  const domain::SensorModel* model = workcell.uncertainty_operations().FindSensor(sensor);
  ASSAY_CHECK(model != nullptr, "the workcell has no sensor '{}'", sensor);
  const auto index =
      static_cast<std::size_t>(model - workcell.uncertainty_operations().sensors.data());
  const ErrorSource source = {ErrorSource::Of::kSensor, index};
  RestingError error = world.resting_in_world(part);
  BelievedShift shift = world.shift(part);
  constexpr std::array<const plan::ErrorKind*, 3> kAlong = {&plan::error::kX, &plan::error::kY,
                                                            &plan::error::kZ};
  const std::array<Interval, 3> promises = {model->x, model->y, model->z};
  for (const int axis : {0, 1, 2}) {
    Measure(world, part, *kAlong[axis], source, promises[axis], error.displacement[axis],
            shift.displacement[axis]);
  }
  Measure(world, part, plan::error::kTheta, source, model->theta, error.theta, shift.turn);
  if (world.propagation() == Propagation::kPaper) shift = {};
  world.SetBelieved(part, shift, error);
}

}  // namespace assay::uncertainty
