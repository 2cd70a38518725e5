#pragma once

#include <limits>
#include <string>
#include <vector>

#include "planner/domain/problem/problem.h"

namespace assay::check {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

// How a held part truly moves to its seat, in the frame of the fixed part.
struct Motion {
  geometry::Pose X_FixedHeld;   // where it starts
  geometry::Vector3 direction;  // unit
};

// By how much shafts fit into their holes in this motion, the worst of all pairs of a mating;
// infinite if it has none. Metres.
struct FitMargins {
  double entry = 0;     // of the tip's corners inside the walls, in the plane of the mouth
  double slide_in = 0;  // of the engaged shaft's corners inside the walls, at the seat and with the
                        // tip in the mouth, without bevels
};
FitMargins MarginsOfFits(const domain::Problem& problem, const domain::Mating& mating,
                         const Motion& motion);

// How far shafts lean across the slots of their holes.
struct Lean {
  std::string slot;  // domain::NameOf
  double sine = 0;   // of the angle between the shaft's axis and the slot's walls
};
std::vector<Lean> LeansInSlots(const domain::Problem& problem, const domain::Mating& mating,
                               const Motion& motion);

}  // namespace assay::check
