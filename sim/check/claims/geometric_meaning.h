#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sim/check/claims/step_events.h"
#include "sim/check/claims/unit.h"

namespace assay::check {

// What preconditions mean, measured where parts and hand truly were: the worst of those about one
// subject.
struct GeometricMeaning {
  std::string subject;  // plan::CertifiedPrecondition::meaning; else all of the name
  Unit unit = Unit::kMetre;
  double observed = 0;  // by how much they hold; negative: one does not
  // Whether no error leaves less than the certificate's margin. Bodies may come nearer to each
  // other than a margin that is certified of some of their corners, where nothing is asked of
  // others since no error is as great as what keeps them apart.
  bool is_at_least_the_margin = true;
};

// Of the preconditions called `condition` in the step's certificate ("between fingers"). None: the
// execution did not come to where they mean something. The geometry is computed from the parts'
// boxes and features alone, not from the planner's expressions.
//   between fingers  both contacts lie between the pads when they begin to close
//   finger clear     the inner corners of the open pads lie outside the faces they close on
//   fingertip        the fingers end above the table
//   pad contact      the closed pads hold the grasped point, with the workcell's margin
//   landing height   the part meets the table on the guarded way
//   footprint        the part stands on the table
//   neighbour clear  the part does not come to other parts
//   hand clear       hand and fingers come to no part, but pads to the faces that they close on
//   passing clear    the held part, moved along the mating motion from where it was poised, comes
//                    to nothing before its shafts come to the mouths of their holes
//   entry, slide-in  the shaft, moved along the mating motion from where it was poised, is inside
//                    the walls of its hole: with its tip in the mouth; and at its seat
//   tilt             the shaft's axis leans across each pair of walls by less than the limit
//   tip shift, tip turn  the tip is where it is believed to be, where its strategy starts, but for
//                    what the strategy absorbs
//   seat             the motion meets its end on the guarded way
std::vector<GeometricMeaning> MeaningsOf(const std::string& condition,
                                         const domain::Problem& problem,
                                         const plan::PlannedStep& step, const StepEvents& events);

// Whether such conditions are among those above. Whether others hold (that pads hold a part, that
// it stands) is not measured.
bool IsMeasured(std::string_view condition);

}  // namespace assay::check
