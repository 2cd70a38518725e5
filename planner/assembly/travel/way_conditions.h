#pragma once

#include <vector>

#include "planner/motion/collision/sway.h"
#include "planner/plan/data/certificate.h"

namespace assay::assembly {

// Bounds for the arm's way to a step's work and for the straight lines of the work, for all
// possible errors.
struct WayCertainty {
  motion::Sway sway;
  // the clearance of bodies from each other in metres, or 0 if they are not known to be clear
  double kept = 0;

  bool Reaches() const { return sway.is_bounded && sway.room > 0; }
};

enum class Whither { kWork, kHome };

// Returns the proved preconditions of a step about the arm (sound mode): kReach and kWayClear of
// plan::condition. If one is missing, plan::NotCovered reports it.
std::vector<plan::CertifiedPrecondition> WayConditions(const WayCertainty& certainty,
                                                       Whither whither);
bool IsWayCondition(plan::Condition condition);
// Removes from a certificate all claims about ways, and the statements that such claims are
// missing.
void RemoveWayConditions(plan::Certificate& certificate);
Whither WhitherOf(const plan::CertifiedPrecondition& way_condition);

}  // namespace assay::assembly
