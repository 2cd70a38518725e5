#include "planner/algebra/bounds/bound.h"

#include "planner/base/check.h"

namespace assay::algebra {

std::string_view Name(Rung rung) {
  switch (rung) {
    case Rung::kLinear:
      return "linear";
    case Rung::kTermwise:
      return "termwise";
    case Rung::kMonotone:
      return "monotone";
    case Rung::kCentred:
      return "centred";
    case Rung::kBranchAndBound:
      return "branch-and-bound";
  }
  ASSAY_CHECK(false, "no such rung");
}

}  // namespace assay::algebra
