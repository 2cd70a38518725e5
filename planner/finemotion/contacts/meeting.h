#pragma once

#include "planner/finemotion/contacts/primitive_contact.h"
#include "planner/finemotion/graph/forward_projection.h"

namespace assay::finemotion {

// Whether motions under uncertainty can meet a primitive contact.
struct Meeting {
  bool meets = true;
  // The distance between the projection and the contact, in metres of its gap and of the excesses
  // of its limits taken together (Euclidean norm); 0 where they meet.
  double margin = 0;
};

inline constexpr double kMeetingTolerance = 1e-9;  // metres

// Exact to `tolerance` metres, and what is nearer than that is said to meet. The at most five rows
// of the contact map the projection into at most five dimensions, where the nearest point is found
// through support functions: the cost is linear in the number of errors.
Meeting Meet(const ForwardProjection& projection, const PrimitiveContact& contact,
             double tolerance = kMeetingTolerance);

// The test of Dakin and Popplestone (section 4): they meet where an edge of the projection does.
// Exponential in the number of errors (at most kMostEdgeTestErrors, checked), and unsound for two
// or more limits: a projection can meet the contact with its inside alone.
bool MeetAtAnEdge(const ForwardProjection& projection, const PrimitiveContact& contact);
inline constexpr int kMostEdgeTestErrors = 24;

}  // namespace assay::finemotion
