#pragma once

#include <string>
#include <vector>

#include "planner/plan/data/plan.h"
#include "sim/check/claims/unit.h"
#include "sim/exec/execution/trace.h"

namespace assay::check {

// One component of an error set, and what it truly was.
struct ObservedError {
  std::string name;  // "x of block"
  Unit unit = Unit::kMetre;
  Interval predicted;
  double observed = 0;
};

// The components of what a certificate says of a part, measured at a moment at which that is to
// hold.
std::vector<ObservedError> ObservedErrors(const domain::Problem& problem,
                                          const plan::Action& action, const plan::ErrorSet& set,
                                          const exec::Moment& moment);

// How the action holds its part; not for a look, which holds none.
const plan::Hold& HoldOf(const plan::Action& action);

// The angle about the world's vertical by which a nearly upright rotation turns.
double YawOf(const geometry::Matrix3& rotation);

}  // namespace assay::check
