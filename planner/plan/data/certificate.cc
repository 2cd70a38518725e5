#include "planner/plan/data/certificate.h"

#include <algorithm>
#include <optional>

namespace assay::plan {

double DoubtOfContact(const Certificate& certificate, double guarded_travel) {
  std::optional<double> margin;
  for (const CertifiedPrecondition& claim : certificate.preconditions) {
    if (claim.condition != "landing height" && claim.condition != "seat") continue;
    margin = std::min(margin.value_or(claim.margin), claim.margin);
  }
  return guarded_travel - std::clamp(margin.value_or(0), 0.0, guarded_travel);
}

}  // namespace assay::plan
