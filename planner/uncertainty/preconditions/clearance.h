#pragma once

#include <string>
#include <vector>

#include "planner/base/interval.h"
#include "planner/geometry/box.h"
#include "planner/uncertainty/preconditions/precondition.h"

namespace assay::uncertainty {

// Of a frame, as seen from another in which all is told, the world or the hand: where the plan has
// it, where it may be, and by how much it may be turned.
struct PossibleFrame {
  Pose planned;
  Transform possible;
  double angle = 0;  // about any axis, radians
};
// By how much the origin of one may be displaced against that of the other, along each axis,
// metres.
Vector3 DisplacementBetween(const UncertainWorld& world, const PossibleFrame& a,
                            const PossibleFrame& b);
// Of a part that rests, in the world: about where the plan has it; and about where it is believed
// to be, as what the hand does with it sees it (UncertainWorld::resting).
PossibleFrame FrameOf(const UncertainWorld& world, PartId part);
PossibleFrame BelievedFrameOf(const UncertainWorld& world, PartId part);
// The frame moved like the belief that it goes by.
PossibleFrame Shifted(const UncertainWorld& world, const PossibleFrame& frame,
                      const BeliefShift& shift);

// A straight way along which a body goes with its frame, without turning.
struct StraightWay {
  Vector3 planned = Vector3::Zero();  // metres
  SymbolicVector possible = {0, 0, 0};
  double doubt = 0;  // how far its end may be from the plan's, at most
};
// Turned about the world's z by an angle that is a belief's.
StraightWay WayOf(const UncertainWorld& world, const Vector3& planned, const Expression& turn);

// The convex hull of a box that goes with a frame, and of the same box at the other end of a way.
class Body {
 public:
  // `frame` must outlive it.
  Body(const PossibleFrame& frame, const geometry::Box& box, const StraightWay& way = {});

  // A corner of the box, at one end of the way.
  struct Point {
    Vector3 local;    // in the frame
    Vector3 planned;  // where the plan has it
    bool at_far_end = false;
  };
  SymbolicVector Possible(const Point& point) const;
  // Those that may be the farthest along a direction.
  std::vector<Point> Foremost(const Vector3& direction) const;

  // As planned.
  const geometry::Matrix3& axes() const { return axes_; }  // of the box
  std::vector<Vector3> Edges() const;                      // their directions
  Interval ReachAlong(const Vector3& direction) const;     // from where to where it reaches
  // How far its points may be off, in any direction, for other reasons than that the frame is
  // displaced.
  double turned() const { return turned_; }

 private:
  const PossibleFrame* frame_;
  geometry::Box box_;
  StraightWay way_;
  geometry::Matrix3 axes_;
  Vector3 middle_;  // of the box, as planned
  double turned_ = 0;
};

// What two bodies that stay apart are a precondition of.
struct Statement {
  std::string condition;  // of Precondition, as is
  std::string meaning;
};

struct Clearance {
  Statement statement;
  Vector3 displacement;  // between the bodies' frames
  Vector3 slack;         // what else may move one against the other, along each axis, metres
  PartId neighbour = PartId::None();  // Precondition::neighbour
};

// Requires that a plane keeps the two bodies apart: of those along their faces, and along an edge
// of each, the one that leaves most beyond what displacements may take. One of these separates
// convex bodies that are apart. Where no error is great enough, nothing is required.
void RequireApart(const Body& a, const Body& b, const Clearance& clearance,
                  Preconditions& conditions);

}  // namespace assay::uncertainty
