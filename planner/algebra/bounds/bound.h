#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace assay::algebra {

// The bounding methods, from the cheapest to the tightest. Each method is conservative, and is
// tried only if the method before it left a gap.
enum class BoundingMethod {
  kLinear,    // SUP/INF's exact linear core: linear expressions over inequalities
  kTermwise,  // the paper's method: each product of the normal form is bounded alone
  kMonotone,  // each variable whose derivative has one sign is set to its best end
  kCentred,   // The value at a centre plus the range of the derivatives times the widths. For a
              // concave expression the derivatives at the centre suffice.
  kBranchAndBound,  // boxes are split until the gap is small enough
};
std::string_view Name(
    BoundingMethod method);  // "linear", "termwise", "monotone", "centred", "branch-and-bound"

struct BoundRequest {
  BoundingMethod highest = BoundingMethod::kBranchAndBound;
  double gap = 1e-6;                   // the work ends when the bound is known to be this tight
  std::int64_t evaluations = 200'000;  // budget: evaluations over a box or at a point
  std::optional<double> limit = {};
};

// A conservative bound and its quality. It holds at the points where the constraints hold and the
// expression has a real value. If there surely are no such points, SUP is -infinity and INF is
// +infinity.
struct Bound {
  double value = 0;  // never crossed by the expression; may be infinite
  BoundingMethod method = BoundingMethod::kTermwise;  // the method that gave the value
  double gap = 0;
  std::vector<double> at = {};  // a feasible point, by VariableId; empty if none was found
  std::int64_t evaluations = 0;
  std::int64_t splits = 0;  // number of boxes that were split
};

struct BothBounds {
  Bound inf, sup;
};

}  // namespace assay::algebra
