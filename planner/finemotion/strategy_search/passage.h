#pragma once

#include <vector>

#include "planner/finemotion/contacts/contact_finder.h"

namespace assay::finemotion {

// The parts of a mating, and the way along which the moving part enters a hole, a slot, or a deeper
// step of a hole.
struct Passage {
  Polyhedron moving;  // the tip is its origin, and its axes are the stationary part's
  Polyhedron stationary;
  // The tip's pose at the first critical point, without errors.
  Pose X_StationaryEntry = Pose::Identity();
  Vector3 mating = -Vector3::UnitZ();  // unit vector along the way in
  // Metres from the first to each further critical point, ascending.
  std::vector<double> further = {};
  double depth = 0.003;  // metres from a critical point within which walls are searched for
  double seat = 0.003;   // metres from the last critical point to the end of the way in
  std::vector<ModelTolerance> tolerances = {};

  int critical_points() const { return 1 + static_cast<int>(further.size()); }
  // Returns the tip's pose at critical point i, without errors.
  Pose X_StationaryEntryAt(int i) const;
};

// Greatest cosine between the way in and a direction across it.
inline constexpr double kAcross = 0.1;

// Returns the contacts between a corner and a face that the tip can make at a critical point when
// it moves at right angles to the way in.
std::vector<PrimitiveContact> WallsAt(const Passage& passage, int critical_point,
                                      const ContactFinder& finder);

// Returns the greatest distance from the tip, across the way in, of a place where it can touch the
// walls of the entry, in metres.
double TipSize(const Passage& passage);

}  // namespace assay::finemotion
