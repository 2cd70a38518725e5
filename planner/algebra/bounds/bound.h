#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace assay::algebra {

// The ladder: each rung is conservative, and tried only where the one before it left a gap.
enum class Rung {
  kLinear,          // SUP/INF's exact linear core: linear expressions over inequalities
  kTermwise,        // the paper's: each product of the normal form bounded alone
  kMonotone,        // variables whose derivative has one sign are set to that end
  kCentred,         // value at a centre plus the range of the derivatives times the widths; where
                    // the expression is concave, the derivatives at the centre are enough
  kBranchAndBound,  // boxes split until the gap is met
};
std::string_view Name(
    Rung rung);  // "linear", "termwise", "monotone", "centred", "branch-and-bound"

struct BoundRequest {
  Rung highest = Rung::kBranchAndBound;
  double gap = 1e-6;                   // stop when the bound is known to be this tight
  std::int64_t evaluations = 200'000;  // budget, of the expression over a box or at a point
  std::optional<double> limit = {};    // also stop once the bound is on this side of it, or a
                                       // feasible point on the other: the question is answered
};

// A conservative bound, with how good it is. It speaks of the points where the constraints hold and
// the expression has a real value. If there surely are none, SUP is -infinity, INF is +infinity.
struct Bound {
  double value = 0;             // never crossed by the expression; may be infinite
  Rung rung = Rung::kTermwise;  // that gave it
  double gap = 0;               // value is at most this far from the true extremum: the
                                // distance to what the expression attains at `at`;
                                // infinite if the value is, or no point was found
  std::vector<double> at = {};  // a feasible point, by VariableId; empty if none was found
  std::int64_t evaluations = 0;
  std::int64_t splits = 0;  // of boxes
};

struct BothBounds {
  Bound inf, sup;
};

}  // namespace assay::algebra
