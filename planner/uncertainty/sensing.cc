#include "planner/uncertainty/sensing.h"

#include <fmt/format.h>

#include "planner/algebra/interval_arithmetic.h"
#include "planner/algebra/simplify.h"
#include "planner/base/check.h"

namespace assay::uncertainty {
namespace {

// The known error, or a new variable within the promise if that says more.
Expression Better(UncertainWorld& world, PartId part, const char* what, const Expression& known,
                  const Interval& promise) {
  if (algebra::Width(world.RangeOf(known)) <= algebra::Width(promise)) return known;
  return world.Declare(fmt::format("{}_{}", what, world.SymbolName(part)), promise, part);
}

}  // namespace

void ApplySensing(UncertainWorld& world, PartId part, const std::string& sensor) {
  const domain::Workcell& workcell = *world.problem().workcell;
  const domain::SensorModel* model = workcell.uncertainty_operations().FindSensor(sensor);
  ASSAY_CHECK(model != nullptr, "the workcell has no sensor '{}'", sensor);
  const RestingError& known = world.resting(part);
  RestingError sensed = {
      .displacement = {Better(world, part, "dx", known.displacement[0], model->x),
                       Better(world, part, "dy", known.displacement[1], model->y),
                       Better(world, part, "dz", known.displacement[2], model->z)},
      .theta = Better(world, part, "theta", known.theta, model->theta)};
  const bool turned = sensed.theta != known.theta;
  if (turned && world.propagation() == Propagation::kSound) {
    using algebra::operator+;
    using algebra::operator-;
    const Interval turn = world.RangeOf(known.theta) - world.RangeOf(sensed.theta);
    const Expression angle =
        world.Declare(fmt::format("turn_{}", world.SymbolName(part)), turn, part);
    sensed.displacement = algebra::Simplify(algebra::RotationZ(-angle) * sensed.displacement);
  }
  world.SetBelief(part, sensed);
}

}  // namespace assay::uncertainty
