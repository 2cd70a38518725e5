#include "planner/domain/actions/actions.h"

#include <array>

namespace assay::domain {

std::span<const ActionRule> ActionRules() {
  static const std::array rules = {kPickupRule, kPutdownRule, kAssembleRule};
  return rules;
}

}  // namespace assay::domain
