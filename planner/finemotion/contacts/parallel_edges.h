#pragma once

#include <Eigen/Core>
#include <array>

#include "planner/finemotion/contacts/primitive_contact.h"

namespace assay::finemotion {

// A point relative to an edge of the other part, to first order in generalized space: across the
// edge (2 coordinates) and along it from its start, metres.
struct PointAtEdge {
  Vector3 offset = Vector3::Zero();
  Eigen::Matrix<double, 3, kPoseDimensions> pose;
  Eigen::Matrix3Xd tolerances;  // a column each
};

// One edge as seen along the other: its ends, and how long the other is.
struct EdgeAlongEdge {
  std::array<PointAtEdge, 2> ends;
  double length = 0;           // metres
  Eigen::VectorXd elongation;  // at either end, for a metre of each tolerance, at most
};

// Convex edges of the two parts that are so nearly parallel that errors may make them quite so.
// Where they cross may then be anywhere along them, and no row tells when. They are no primitive
// contact, but they can touch before any corner of either does. What can be told is where they
// surely do not: in a plane across one of them it is a point, the other one a short segment, and
// both are linear in small motions.
struct ParallelEdges {
  int moving = 0;  // index in its polyhedron
  int stationary = 0;
  EdgeAlongEdge along_stationary;
  EdgeAlongEdge along_moving;
  // The gap where they are nearest to each other, halfway between the directions in which they can
  // press; without limits. To tell of them, not to decide by.
  PrimitiveContact contact;
};
ContactKey KeyOf(const ParallelEdges& edges);

// Numbers that a motion under uncertainty takes a linear function to: its value at the start, the
// change in a displacement, and what errors of the start and of the displacement change each.
template <int Rows>
struct SweptValues {
  Eigen::Matrix<double, Rows, 1> start;
  Eigen::Matrix<double, Rows, 1> motion;
  Eigen::Matrix<double, Rows, Eigen::Dynamic> start_errors;   // a column each
  Eigen::Matrix<double, Rows, Eigen::Dynamic> motion_errors;  // of a displacement
};

struct SweptEdge {
  std::array<SweptValues<3>, 2> ends;
  double length = 0;
  double elongation = 0;  // at either end, at most
};

// Whether edges can touch within `time` displacements; before `until` falls below 0, if there is
// one (else null). Conservative: a line through the one edge, on whose one side the other stays,
// must be found for each of a few stretches of the motion.
bool MayTouch(const SweptEdge& edge, const SweptValues<1>* until, double time);

}  // namespace assay::finemotion
