#include "sim/execution/trace/trace.h"

#include <cmath>

#include "planner/base/check.h"

namespace assay::execution {

bool GraspFact::holds() const {
  return pads_touch && std::abs(opening - expected_width) <= kGraspTolerance;
}

std::string_view Name(Stage stage) {
  switch (stage) {
    case Stage::kPoised:
      return "poised";
    case Stage::kReached:
      return "reached";
    case Stage::kActed:
      return "acted";
  }
  ASSAY_CHECK(false, "a stage that the switch does not know");
  return {};
}

}  // namespace assay::execution
