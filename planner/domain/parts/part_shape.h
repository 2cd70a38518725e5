#pragma once

#include <map>
#include <mutex>
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
  // The masses with other clearances for which PartFile::MassWithClearance was asked. Pockets have
  // to be cut anew for each clearance, and certificates ask for the same ones thousands of times.
  mutable std::map<double, geometry::MassProperties> mass_with_clearance;
  mutable std::mutex mass_mutex;

  // `density` is in kg/m^3.
  PartShape(std::vector<geometry::ConvexHull> solids, std::vector<geometry::RoundSolid> round,
            double density);
};

}  // namespace assay::domain
