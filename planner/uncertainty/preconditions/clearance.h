#pragma once

#include <string>
#include <vector>

#include "planner/base/interval.h"
#include "planner/geometry/hull.h"
#include "planner/uncertainty/preconditions/precondition.h"

namespace assay::uncertainty {

// A frame as seen from a reference frame, which is the world or the hand: its planned pose, its
// possible pose, and the greatest angle by which it may be turned.
struct PossibleFrame {
  Pose planned;
  Transform possible;
  double angle = 0;  // about any axis, radians
};
// Returns the greatest displacement, along each axis and in metres, of the origin of one frame
// against the origin of the other.
Vector3 DisplacementBetween(const UncertainWorld& world, const PossibleFrame& a,
                            const PossibleFrame& b);
// Both return the frame of a resting part in the world, with its errors. FrameOf gives the errors
// relative to the planned pose. BelievedFrameOf gives them relative to the pose that the hand
// believes when it works on the part (UncertainWorld::resting).
PossibleFrame FrameOf(const UncertainWorld& world, PartId part);
PossibleFrame BelievedFrameOf(const UncertainWorld& world, PartId part);
// Returns the frame of a body that follows a believed pose, after that pose has moved by `shift`.
PossibleFrame Shifted(const UncertainWorld& world, const PossibleFrame& frame,
                      const BelievedShift& shift);

// A straight way along which a body moves with its frame, without turning.
struct StraightWay {
  Vector3 planned = Vector3::Zero();  // metres
  SymbolicVector possible = {0, 0, 0};
  double doubt = 0;  // greatest distance of its end from the planned end, metres
};
// Returns a way that is turned about the world's z by `turn`, the turn of a believed pose.
StraightWay WayOf(const UncertainWorld& world, const Vector3& planned, const Expression& turn);

// The convex hull of a solid that moves with a frame, and of the same solid at the other end of a
// way.
class Body {
 public:
  // `frame` must outlive the body.
  Body(const PossibleFrame& frame, const geometry::ConvexHull& solid, const StraightWay& way = {});

  // A corner of the solid, at one end of the way.
  struct Point {
    Vector3 local;    // position in the frame
    Vector3 planned;  // planned position
    bool at_far_end = false;
  };
  SymbolicVector Possible(const Point& point) const;
  // Returns the corners that may be the farthest along a direction.
  std::vector<Point> Foremost(const Vector3& direction) const;

  // These functions describe the body as planned.
  // Normals of the solid's facets, without opposite ones.
  const std::vector<Vector3>& normals() const { return normals_; }
  const std::vector<Vector3>& edges() const { return edges_; }  // directions of the hull's edges
  bool has_way() const { return way_.planned.norm() > 0; }
  Interval ReachAlong(const Vector3& direction) const;  // range of the body along a direction
  // Returns how far the body's points may be off, in any direction, apart from the displacement of
  // the frame: metres.
  double turned() const { return turned_; }

 private:
  const PossibleFrame* frame_;
  geometry::ConvexHull solid_;  // in the frame
  StraightWay way_;
  std::vector<Vector3> normals_;
  std::vector<Vector3> edges_;
  geometry::ConvexHull planned_;  // in the world or the hand, where the frames are seen from
  double turned_ = 0;
};

// The text of a precondition that keeps two bodies apart.
struct Statement {
  plan::Condition condition;
  std::string meaning;
};

struct Clearance {
  Statement statement;
  Vector3 displacement;  // possible displacement between the bodies' frames, metres
  Vector3 slack;         // other movement of one against the other, along each axis, metres
  PartId neighbour = PartId::None();  // see Precondition::neighbour
};

// Requires that a plane keeps the two bodies apart. The candidates are planes along the faces of
// each body, and planes along an edge of each; one of these separates any two convex bodies that
// are apart. The plane is chosen for which the gap is widest after the possible displacements are
// subtracted. Nothing is required where no error is great enough to close the gap.
void RequireApart(const Body& a, const Body& b, const Clearance& clearance,
                  Preconditions& conditions);

}  // namespace assay::uncertainty
