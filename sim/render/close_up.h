#pragma once

#include <array>
#include <vector>

#include "sim/render/framing.h"
#include "sim/render/sight.h"

namespace assay::render {

// A point that is to be seen when what moves (Sight) has moved so far; world frame, metres.
struct Glimpse {
  Vector3 point;
  Vector3 moved = Vector3::Zero();
};

// What a close-up is of.
struct Subject {
  std::vector<Ball> framed;  // that are to be in the picture
  Vector3 out;               // unit: the side that it opens to, from which the hand comes
  // Between `out` and where it is looked at from, radians; the first is the best.
  std::array<double, 3> from_out;
  std::vector<Glimpse> seen = {};
};

// From where most of what is to be seen is seen: of directions all around `out`, those above the
// table; of equal ones that which is nearest to the usual one.
FreeCamera CloseUp(const Subject& subject, const Sight& sight, double aspect);

// From where pictures are taken for which nothing says otherwise: before the table, a little aside,
// the lamp behind; unit.
Vector3 UsualDirection();

}  // namespace assay::render
