#include "sim/check/falsification/attack_result.h"

#include "planner/base/check.h"

namespace assay::check {

std::string_view Name(AttackPhase phase) {
  switch (phase) {
    case AttackPhase::kWithoutNoise:
      return "without-noise";
    case AttackPhase::kVertices:
      return "vertices";
    case AttackPhase::kLikely:
      return "likely-corners";
    case AttackPhase::kLowDiscrepancy:
      return "low-discrepancy";
    case AttackPhase::kLocalSearch:
      return "local-search";
  }
  ASSAY_CHECK(false, "a phase that the switch does not know");
  return {};
}

}  // namespace assay::check
