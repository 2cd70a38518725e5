#include "planner/domain/parts/feature.h"

#include "planner/geometry/planar_region.h"

namespace assay::domain {

bool Face::Covers(const geometry::Polygon& polygon) const {
  return geometry::Fills(patches, polygon);
}

}  // namespace assay::domain
