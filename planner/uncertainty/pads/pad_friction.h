#pragma once

#include <vector>

#include "planner/geometry/coordinates.h"

namespace assay::uncertainty {

using geometry::Vector2;

// A load in the plane of the pads: a force (newtons), and a moment about the pads' normal (newton
// metres, positive from the plane's first axis to its second).
struct PlaneLoad {
  Vector2 force = Vector2::Zero();
  double torsion = 0;
};

// A small piece of a pad, and the greatest friction that it exerts, in newtons.
struct PadCell {
  Vector2 at;  // metres, in the plane of the pads
  double friction = 0;
};

// The forces and torsions that the friction of pads bears without slipping. They are the inside of
// the limit surface of Goyal, Ruina and Papadopoulos (1991), under Coulomb's law and a pressure
// that is even over each pad's touching patch. Each cell's pressure is taken to act in its middle.
// Such pressures bear less than the same pressures spread over the cells, since friction's power in
// a rotation is a convex function of the place.
class PadFriction {
 public:
  explicit PadFriction(std::vector<PadCell> cells);

  const Vector2& center() const { return center_; }  // the center of the friction

  // Returns the ratio of the load to the greatest bearable load of the same kind, or more. Below 1
  // the pads do not slip. The limit surface is convex, so the loads at which the pads turn about
  // points on one line span a polygon inside it. The part of the load that is off the line counts
  // as a separate force. The ratio is infinite without friction.
  double RatioOf(const PlaneLoad& load) const;  // the torsion is about the center

 private:
  struct Node {
    double force = 0;    // force along the given direction, newtons
    double aside = 0;    // force across the given direction, newtons
    double torsion = 0;  // newton metres
  };
  Node TurningAbout(double distance, const Vector2& along) const;

  std::vector<PadCell> cells_;  // positions are from the center
  Vector2 center_ = Vector2::Zero();
  double friction_ = 0;  // sum over all cells, newtons
  double reach_ = 0;     // mean distance of the friction from the center, metres
};

}  // namespace assay::uncertainty
