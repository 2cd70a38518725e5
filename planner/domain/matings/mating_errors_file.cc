#include "planner/domain/matings/mating_errors_file.h"

namespace assay::domain {

MatingErrors ReadMatingErrors(const Value& map, const Units& units) {
  map.AllowOnly({"displacement", "rotation", "velocity"});
  MatingErrors errors;
  if (const auto displacement = map.Find("displacement")) {
    errors.displacement = ReadWithin(*displacement, units.length, kMatingDisplacements);
  }
  if (const auto rotation = map.Find("rotation")) {
    errors.rotation = ReadWithin(*rotation, units.angle, kMatingRotations);
  }
  if (const auto velocity = map.Find("velocity")) {
    errors.velocity = ReadWithin(*velocity, kRatio, kMatingVelocities);
  }
  return errors;
}

}  // namespace assay::domain
