#include "planner/algebra/bounds/bound.h"

#include "planner/base/check.h"

namespace assay::algebra {

std::string_view Name(BoundingMethod method) {
  switch (method) {
    case BoundingMethod::kLinear:
      return "linear";
    case BoundingMethod::kTermwise:
      return "termwise";
    case BoundingMethod::kMonotone:
      return "monotone";
    case BoundingMethod::kCentred:
      return "centred";
    case BoundingMethod::kBranchAndBound:
      return "branch-and-bound";
  }
  ASSAY_CHECK(false, "no such rung");
}

}  // namespace assay::algebra
