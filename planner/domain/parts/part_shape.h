#pragma once

#include <vector>

#include "planner/geometry/collision.h"
#include "planner/geometry/hull.h"
#include "planner/geometry/solids/mass_properties.h"
#include "planner/geometry/solids/round_solid.h"

namespace assay::domain {

// The solid shape of a part, in the part frame.
struct PartShape {
  std::vector<geometry::ConvexHull> pieces;  // disjoint or overlapping
  geometry::CollisionShape collision;        // the pieces, prepared for queries
  geometry::ConvexHull hull;                 // of all pieces
  geometry::MassProperties mass;
  std::vector<geometry::RoundSolid> round_solids;  // what pieces with many sides stand for

  // `density` is in kg/m^3.
  PartShape(std::vector<geometry::ConvexHull> solids, std::vector<geometry::RoundSolid> round,
            double density);
};

}  // namespace assay::domain
