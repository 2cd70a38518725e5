#pragma once

#include <limits>
#include <string>
#include <vector>

#include "planner/domain/problem/problem.h"

namespace assay::check {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The true motion of a held part to its seat, in the fixed part's frame.
struct Motion {
  geometry::Pose X_FixedHeld;   // pose at the start
  geometry::Vector3 direction;  // unit vector
};

// The margins by which shafts fit into their holes in a motion, in metres: the least over all pairs
// of a mating. They are infinite if the mating has no shaft in a hole.
struct FitMargins {
  // The distance of the tip's corners from the walls in the plane of the mouth, plus the bevels;
  // negative if a corner would not enter.
  double entry = 0;
  // The distance of the engaged shaft's corners from the walls, without bevels; negative outside.
  // It is the lesser of two values: with the shaft at its seat, and with the tip in the mouth.
  double slide_in = 0;
};
FitMargins MarginsOfFits(const domain::Problem& problem, const domain::Mating& mating,
                         const Motion& motion);

// The lean of a shaft across one slot of its hole.
struct Lean {
  std::string slot;  // the name from domain::NameOf
  double sine = 0;   // sine of the angle between the shaft's axis and the slot's walls
};
std::vector<Lean> LeansInSlots(const domain::Problem& problem, const domain::Mating& mating,
                               const Motion& motion);

}  // namespace assay::check
