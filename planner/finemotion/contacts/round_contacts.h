#pragma once

#include <optional>
#include <vector>

#include "planner/finemotion/contacts/contact_range.h"
#include "planner/finemotion/contacts/primitive_contact.h"

namespace assay::finemotion {

// Adds the cylinder to the shape, and marks the features of the polygon that it stands for. The
// sides of this polygon are along the axis, at `apothem` metres from it. Sets the cylinder's length
// or depth. The axis must be a unit vector.
void AddRoundShaft(RoundShaft shaft, double apothem, Polyhedron& shape);
void AddRoundHole(RoundHole hole, double apothem, Polyhedron& shape);

// A contact of a round shaft at one pose. It is not linearized.
struct RoundContact {
  double gap = 0;                    // metres
  Vector3 normal = Vector3::Zero();  // unit vector from the stationary part into free space
  Vector3 at = Vector3::Zero();      // the contact point, in the stationary part's axes, metres
  // How far the contact is inside each of its ends. Ends of features are in metres. The first
  // `turns` ones are ends of the shaft's orientation, in radians.
  std::vector<double> inside;
  int turns = 0;
};

// The contacts between the round shafts of the moving part (Polyhedron::shafts) and the stationary
// part, whose holes may be round. They do not depend on how a shaft is turned about its axis. The
// places where they touch move along the rims when the shaft tilts, but their gaps are smooth
// functions of the pose. The gaps of a polygon's contacts are not smooth, because other corners
// touch after a small turn.
//
// Contacts with the side of a hole, or of a shaft, are modelled in kRoundDirections directions u
// across the hole. In each direction u, the shaft must stay before the plane that touches the hole
// there. These planes surround the circle in which the shaft's axis can move, so they leave a
// little more room than the hole does: 1 / cos(180 degrees / kRoundDirections) - 1 of the
// clearance.
class RoundContacts {
 public:
  RoundContacts(const Polyhedron& moving, const Polyhedron& stationary);

  // All contacts that can exist. The contact kRimFace of a shaft with a face has a key for the
  // lowest point of the rim, and one for each direction, for shafts that are nearly upright on the
  // face.
  const std::vector<ContactKey>& keys() const { return keys_; }

  // Returns the contact, or none if its features cannot touch near this pose, for a part that may
  // be turned by at most `turn` radians from there.
  std::optional<RoundContact> At(const ContactKey& key, const Pose& X_StationaryMoving,
                                 double turn) const;

  // Returns the contact linearized at the pose, with zeros for the tolerances.
  std::optional<PrimitiveContact> Linearized(const ContactKey& key, const Pose& X_StationaryMoving,
                                             const ContactRange& range,
                                             Eigen::Index tolerances) const;

 private:
  // A face of the stationary part, with the corners of the convex hull of its region.
  struct Ground {
    Vector3 normal;
    double height = 0;
    std::vector<Vector3> outline;
    bool is_round = false;
  };
  bool IsKnown(const ContactKey& key) const;
  std::optional<RoundContact> RimOnFace(const ContactKey& key, const Pose& X, double turn) const;

  std::vector<RoundShaft> shafts_;
  std::vector<RoundHole> holes_;
  std::vector<Ground> faces_;
  std::vector<ContactKey> keys_;
};

// The number of directions, which divide the circle evenly.
inline constexpr int kRoundDirections = 8;

}  // namespace assay::finemotion
