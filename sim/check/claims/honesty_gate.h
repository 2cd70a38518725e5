#pragma once

#include <string>
#include <vector>

#include "planner/plan/data/plan.h"
#include "sim/check/claims/claim.h"
#include "sim/scene/mjcf.h"

namespace assay::check {

// What the engine makes of a plan that is executed without any error: what is known of it is
// subtracted from what is observed under noise, and what is not known says nothing about a
// prediction.

// Of one claim, in its unit.
struct ComponentGate {
  Claimed about = Claimed::kAfter;
  std::string name;      // as in Claim
  double offset = 0;     // what is observed without noise; of a precondition 0
  double step_size = 0;  // by how much that is more than with half the timestep; has a sign
};

// Of one step. Lengths are metres, angles radians.
struct StepGate {
  std::vector<ComponentGate> components = {};
  double arm = 1;          // over which penetration turns a part: the pads' smaller half extent
  double penetration = 0;  // the deepest contact of a hand that is kept still
  double lag = 0;          // of the hand behind what it was told
  double lag_turn = 0;
};

struct HonestyGate {
  std::vector<StepGate> steps = {};  // by StepId; empty: nothing is known but rounding

  // The claim with what is known of the engine in its prediction, and with its gate. Penetration
  // and lag go either way. What the timestep does has a sign, and vanishes in proportion to the
  // timestep or faster: it is once to twice as much as half the timestep takes of it, so that once
  // is known, and once more cannot be told from nothing.
  Claim Passed(Claim claim) const;
  // By how much a false prediction may be left unnoticed: all of that at one end.
  double Floor(const Claim& claim) const;
  // Of a claim that has passed: whether that is more than the width of what the certificate says.
  // What has no width, preconditions and sets that are narrower than what goes either way, is held
  // against the clearance (metres; of angles: over the arm).
  bool Hides(const Claim& passed, double clearance) const;
};

}  // namespace assay::check
