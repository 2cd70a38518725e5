#include "sim/check/falsification/falsification_result.h"

#include "planner/base/check.h"

namespace assay::check {

std::string_view Name(FalsificationPhase phase) {
  switch (phase) {
    case FalsificationPhase::kWithoutNoise:
      return "without-noise";
    case FalsificationPhase::kVertices:
      return "vertices";
    case FalsificationPhase::kLikely:
      return "likely-corners";
    case FalsificationPhase::kLowDiscrepancy:
      return "low-discrepancy";
    case FalsificationPhase::kLocalSearch:
      return "local-search";
  }
  ASSAY_CHECK(false, "a phase that the switch does not know");
  return {};
}

}  // namespace assay::check
