#pragma once

#include "planner/finemotion/contacts/primitive_contact.h"
#include "planner/finemotion/forward_projections/forward_projection.h"

namespace assay::finemotion {

// The answer to the question whether motions under uncertainty can meet a primitive contact.
struct Meeting {
  bool meets = true;
  // The distance between the projection and the contact. It is the Euclidean norm, in metres, of
  // the gap and the excesses over the limits. It is 0 if the two meet.
  double margin = 0;
};

inline constexpr double kMeetingTolerance = 1e-9;  // metres; anything nearer than this meets

// Decides whether the projection meets the contact. The answer is exact to `tolerance` metres:
// anything nearer counts as a meeting. The contact's rows, usually five at most, map the projection
// into a space with one dimension for each row. The nearest point there is found through support
// functions, so the cost is linear in the number of errors.
Meeting Meet(const ForwardProjection& projection, const PrimitiveContact& contact,
             double tolerance = kMeetingTolerance);

// Decides by the test of Dakin and Popplestone (section 4): the two meet where an edge of the
// projection meets the contact. Its cost is exponential in the number of errors, which is checked
// to be at most kMostEdgeTestErrors. It is unsound for two or more limits, since a projection can
// meet the contact with its inside alone.
bool MeetAtAnEdge(const ForwardProjection& projection, const PrimitiveContact& contact);
inline constexpr int kMostEdgeTestErrors = 24;

}  // namespace assay::finemotion
