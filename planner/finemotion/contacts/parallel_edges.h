#pragma once

#include <Eigen/Core>
#include <array>

#include "planner/finemotion/contacts/primitive_contact.h"

namespace assay::finemotion {

// The position of a point relative to an edge of the other part, to first order in generalized
// space. Its coordinates in metres are two across the edge, then one along the edge from its start.
struct PointAtEdge {
  Vector3 offset = Vector3::Zero();
  Eigen::Matrix<double, 3, kPoseDimensions> pose;
  Eigen::Matrix3Xd tolerances;  // one column for each tolerance
};

// One edge as seen along the other: the positions of its ends, and the other edge's length.
struct EdgeAlongEdge {
  std::array<PointAtEdge, 2> ends;
  double length = 0;           // length of the edge along which the other one is seen, metres
  Eigen::VectorXd elongation;  // greatest motion of either end for one metre of each tolerance
};

// Two convex edges of the two parts that are so nearly parallel that errors may make them exactly
// parallel. The point where they cross may then be anywhere along them, so no linear row gives
// their gap. They are no primitive contact, but they can touch before any corner of either part
// does. It can be shown where they surely do not touch: in a plane across one edge, that edge is a
// point and the other is a short segment, and both are linear in small motions.
struct ParallelEdges {
  int moving = 0;  // index in its polyhedron's edges
  int stationary = 0;
  EdgeAlongEdge along_stationary;
  EdgeAlongEdge along_moving;
  // The gap between the nearest points of the edges, measured halfway between the directions in
  // which they can press. It has no limits. It serves for reports, not for decisions.
  PrimitiveContact contact;
};
ContactKey KeyOf(const ParallelEdges& edges);

// The values of linear functions along a motion under uncertainty: the values at the start, the
// change of these values over the whole displacement, and how much each error of the start and of
// the displacement changes them.
template <int Rows>
struct SweptValues {
  Eigen::Matrix<double, Rows, 1> start;
  Eigen::Matrix<double, Rows, 1> motion;
  Eigen::Matrix<double, Rows, Eigen::Dynamic> start_errors;  // one column for each error
  // One column for each error of a displacement.
  Eigen::Matrix<double, Rows, Eigen::Dynamic> motion_errors;
};

struct SweptEdge {
  std::array<SweptValues<3>, 2> ends;
  double length = 0;
  double elongation = 0;  // greatest motion of either end, metres
};

// Returns whether the edges can touch within `time` displacements. If `until` is not null, touches
// count only before its value falls below 0. The answer is conservative. The motion is divided into
// a few pieces. The answer is "no" only if in each piece a line through one edge has the other edge
// wholly on one side.
bool MayTouch(const SweptEdge& edge, const SweptValues<1>* until, double time);

}  // namespace assay::finemotion
