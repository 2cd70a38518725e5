#pragma once

namespace assay {

// A closed interval of numbers, low <= high; an end may be infinite. Its arithmetic, rounded
// outward, is in planner/algebra/numeric/interval_arithmetic.h.
struct Interval {
  double low = 0;
  double high = 0;

  constexpr bool operator==(const Interval&) const = default;
};

}  // namespace assay
