#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sim/check/claims/step_events.h"
#include "sim/check/claims/unit.h"

namespace assay::check {

// The geometric meaning of a precondition, measured where parts and hand truly were. It is the
// worst over all preconditions about one subject.
struct GeometricMeaning {
  std::string subject;  // plan::CertifiedPrecondition::meaning; empty: all of that name
  Unit unit = Unit::kMetre;
  double observed = 0;  // the margin by which they hold; negative if one does not
  // True if the observed value must be at least the certificate's margin. It is false for
  // clearances between bodies: their margin is certified for some corners only. Nothing is
  // certified about corners that no error can bring near, so bodies may come nearer to each other
  // than the margin.
  bool is_at_least_the_margin = true;
  // True if the certificate counts on a wrist that yields and on bevelled edges. Simulated arms and
  // parts have neither. If a shaft would need them, the trial proves nothing about the plan.
  bool counts_on_yielding = false;
};

// Returns the meanings of all preconditions called `condition` ("between fingers") in the step's
// certificate. The list is empty if the execution did not come to the point at which the condition
// can be measured. The geometry is computed from the parts' boxes and features alone, not from the
// planner's expressions. The conditions mean:
//
//   between fingers  both contacts lie between the pads when they begin to close
//   finger clear     the inner corners of the open pads lie outside the faces they close on
//   fingertip        the fingers end above the table
//   pad contact      the closed pads hold the grasped point, with the workcell's margin
//   landing height   the part meets the table within the guarded travel
//   footprint        the part stands on the table
//   neighbour clear  the part does not touch other parts
//   hand clear       hand and fingers touch no part, except the faces that the pads close on
//   passing clear    the held part, moved along the mating motion from where it was poised, touches
//                    nothing before its shafts reach the mouths of their holes
//   entry            the shaft, moved along the mating motion from where it was poised, is inside
//                    the walls of its hole when its tip is in the mouth
//   slide-in         the shaft, moved along the mating motion from where it was poised, is inside
//                    the walls of its hole at its seat
//   tilt             the shaft's axis leans across each pair of walls by less than the limit
//   tip shift        at the strategy's start, the tip is where it is believed to be, except for
//                    the shift that the strategy absorbs
//   tip turn         at the strategy's start, the tip is turned as it is believed to be, except
//                    for the turn that the strategy absorbs
//   seat             the part reaches its seat within the guarded travel
std::vector<GeometricMeaning> MeaningsOf(const std::string& condition,
                                         const domain::Problem& problem,
                                         const plan::PlannedStep& step, const StepEvents& events);

// Returns whether the condition is one of those that MeaningsOf measures. Others, for instance that
// pads hold a part or that a part stands, are not measured.
bool IsMeasured(std::string_view condition);

}  // namespace assay::check
