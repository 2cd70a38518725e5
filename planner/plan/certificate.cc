#include "planner/plan/certificate.h"

#include <algorithm>
#include <array>
#include <optional>

namespace assay::plan {

bool IsRatio(std::string_view condition) {
  constexpr std::array<std::string_view, 6> kRatios = {"holding", "upright",      "standing",
                                                       "pressed", "fixed stands", "fixed stays"};
  return std::ranges::count(kRatios, condition) > 0;
}

double DoubtOfContact(const Certificate& certificate, double guarded_travel) {
  std::optional<double> margin;
  for (const CertifiedPrecondition& claim : certificate.preconditions) {
    if (claim.condition != "landing height" && claim.condition != "seat") continue;
    margin = std::min(margin.value_or(claim.margin), claim.margin);
  }
  return guarded_travel - std::clamp(margin.value_or(0), 0.0, guarded_travel);
}

}  // namespace assay::plan
