#pragma once

#include <array>
#include <vector>

#include "sim/render/framing.h"
#include "sim/render/sight.h"

namespace assay::render {

// A point that should be visible when the moving shapes of a Sight are displaced by `moved`. Both
// vectors are in the world frame, in metres.
struct Glimpse {
  Vector3 point;
  Vector3 moved = Vector3::Zero();
};

// The subject of a close-up.
struct Subject {
  std::vector<Ball> framed;  // balls that must be in the picture
  Vector3 out;               // unit vector to the open side, from which the hand comes
  // Angles between `out` and the direction to the eye, radians, the preferred one first.
  std::array<double, 3> from_out;
  std::vector<Glimpse> seen = {};  // points that should be visible
};

// Returns the camera that sees most of the subject's points. It tries directions all around `out`
// that are above the table. Among equally good ones it takes the one nearest to UsualDirection.
FreeCamera CloseUp(const Subject& subject, const Sight& sight, double aspect);

// Returns the unit vector towards the default eye of pictures. The eye is in front of the table, a
// little to the side, with the lamp behind it.
Vector3 UsualDirection();

}  // namespace assay::render
