#include "planner/domain/mating_errors_file.h"

namespace assay::domain {

MatingErrors ReadMatingErrors(const Value& map, const Units& units) {
  map.AllowOnly({"displacement", "rotation"});
  MatingErrors errors;
  if (const auto displacement = map.Find("displacement")) {
    errors.displacement = ReadWithin(*displacement, units.length, kMatingDisplacements);
  }
  if (const auto rotation = map.Find("rotation")) {
    errors.rotation = ReadWithin(*rotation, units.angle, kMatingRotations);
  }
  return errors;
}

}  // namespace assay::domain
