#include "planner/plan/certificates/certificate.h"

#include <algorithm>
#include <array>
#include <optional>

#include "planner/plan/certificates/condition_table.h"

namespace assay::plan {

std::span<const ErrorComponent> ErrorComponents() {
  using enum domain::Dimension;
  static constexpr auto kComponents =
      std::to_array<ErrorComponent>({{"x", kLength, &ErrorSet::x},
                                     {"y", kLength, &ErrorSet::y},
                                     {"z", kLength, &ErrorSet::z},
                                     {"theta", kAngle, &ErrorSet::theta},
                                     {"tip", kAngle, &ErrorSet::tip, true},
                                     {"twist", kAngle, &ErrorSet::twist, true}});
  return kComponents;
}

double DoubtOfContact(const Certificate& certificate, double guarded_travel) {
  std::optional<double> margin;
  for (const CertifiedPrecondition& claim : certificate.preconditions) {
    const bool is_of_contact =
        claim.condition == condition::kLandingHeight || claim.condition == condition::kSeat;
    if (!is_of_contact) continue;
    margin = std::min(margin.value_or(claim.margin), claim.margin);
  }
  return guarded_travel - std::clamp(margin.value_or(0), 0.0, guarded_travel);
}

}  // namespace assay::plan
