#pragma once

#include <vector>

#include "planner/uncertainty/error_sets/uncertain_world.h"

namespace assay::uncertainty {

using geometry::Vector2;

// The contact of a part with one thing that it stands on: corners of a region, in the world.
struct Standing {
  PartId on;  // None: a table
  std::vector<Vector3> at;
};

// Returns the contacts on which a part stands at X_WorldPart, without errors. The part stands on a
// table with its lowest vertices, and on other parts with those of its faces that look down. The
// other parts are at their planned poses at that time. Parts in the hand carry nothing.
std::vector<Standing> StandingsOf(const UncertainWorld& world, PartId part,
                                  const Pose& X_WorldPart);

// Returns contacts on which the part stands whatever the errors are. `error` is the part's error at
// X_WorldPart: about_plan if it rests, and what it will have if it is in the hand. A point of
// contact with another part is sure if the faces below it still cover it after they have been
// displaced against the part as far as the errors allow, and after the tolerance of the clearance
// has moved the rims of holes. The contacts are in the frame of the planned part, so the place of
// its centre of mass above them is certain, too.
std::vector<Standing> SureStandingsOf(const UncertainWorld& world, PartId part,
                                      const Pose& X_WorldPart, const RestingError& error);

// Returns the support of a part, in world x and y: the convex hull of its contacts.
geometry::Polygon SupportOf(const std::vector<Standing>& standings);

// An edge of a part's support, about which it could tip: outward . p == offset, in world x and y.
struct TippingEdge {
  Vector2 outward;  // unit
  double offset = 0;

  // Returns how far p is beyond the edge, in metres; negative if it is inside.
  double Beyond(const Vector3& p) const { return outward.dot(p.head<2>()) - offset; }
};
// Returns the edges. There are none where the part stands on a line or a point.
std::vector<TippingEdge> TippingEdgesOf(const std::vector<Standing>& standings);

// A push that presses a part down at some point of the hull of these points, and may also push it
// aside there.
struct Push {
  std::vector<Vector3> at;
  double down = 0;   // newtons
  double aside = 0;  // newtons, in any direction
};

// Returns the moment with which the pushes tip a part, divided by the moment with which its weight
// resists. The result is the greatest ratio over all edges of this part and of the parts that it
// stands on. If it is below 1, none of these parts tips. The weights of other parts that stand on
// them count as pushes. The part's fixture (domain::Part::clamp) helps to press it down. `off` is
// the greatest distance, in metres, of the pushes from their planned places.
double TippingRatio(const UncertainWorld& world, PartId part, const std::vector<Push>& pushes,
                    double off);

// Returns the weights of what already stands on a part; each acts somewhere in a patch of contact.
// The part `except` is left out, with what stands on it.
std::vector<Push> WeightsOn(const UncertainWorld& world, PartId part,
                            PartId except = PartId::None());
// Returns the ratio of the force that pushes the part aside to the friction that keeps it. The
// friction is the least within its tolerance. The result is the greatest ratio of this part and of
// the parts that it stands on. If it is below 1, none of these parts slides.
double SlidingRatio(const UncertainWorld& world, PartId part, const std::vector<Push>& pushes);

}  // namespace assay::uncertainty
