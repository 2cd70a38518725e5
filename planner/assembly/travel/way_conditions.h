#pragma once

#include <vector>

#include "planner/motion/collision/sway.h"
#include "planner/plan/certificates/certificate.h"
#include "planner/plan/data/plan.h"

namespace assay::assembly {

// Bounds for the arm's way to a step's work and for the straight lines of the work, for all
// possible errors.
struct WayCertainty {
  motion::Sway sway;
  // the clearance of bodies from each other in metres, or 0 if they are not known to be clear
  double kept = 0;

  bool Reaches() const { return sway.is_bounded && sway.room > 0; }
  bool IsComplete() const { return Reaches() && kept > 0; }
};

// Returns the proved preconditions of a step about the arm (sound mode): kReach and kWayClear of
// plan::condition, for the way to its work (kUsual) or for the way home. If one is missing,
// plan::NotCovered reports it.
std::vector<plan::CertifiedPrecondition> WayConditions(const WayCertainty& certainty,
                                                       plan::Circumstance circumstance);
// Returns the circumstance of the way to this step's work, or of the way home if the step is None.
inline plan::Circumstance WayOf(plan::StepId step) {
  return step.IsNone() ? plan::Circumstance::kWayHome : plan::Circumstance::kUsual;
}
bool IsWayCondition(plan::Condition condition);
// Returns whether the certificates of a plan claim anything about the arm's ways.
bool ClaimsWays(const plan::Plan& plan);
// Returns whether a plan says anything about errors as sound plans do, so that it has to say which
// ways are proved.
bool HasSoundCertificates(const plan::Plan& plan);
// Removes from a certificate all claims about ways, and the statements that such claims are
// missing.
void RemoveWayConditions(plan::Certificate& certificate);

}  // namespace assay::assembly
