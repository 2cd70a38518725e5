#include "planner/domain/part/feature.h"

#include "planner/domain/grasp/planar_region.h"

namespace assay::domain {

bool Face::Covers(const geometry::Polygon& polygon) const { return Fills(patches, polygon); }

}  // namespace assay::domain
