#pragma once

namespace assay {

// A closed interval of numbers with low <= high. An end may be infinite. Outward-rounded arithmetic
// is in planner/numeric/interval_arithmetic.h.
struct Interval {
  double low = 0;
  double high = 0;

  constexpr bool operator==(const Interval&) const = default;
};

}  // namespace assay
