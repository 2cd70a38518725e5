#pragma once

#include <array>

#include "planner/algebra/operators/operator.h"

namespace assay::algebra {

// The built-in functions, which every text may name.
inline constexpr std::array kFunctions = {Operator::kSin, Operator::kCos, Operator::kSqrt,
                                          Operator::kAbs, Operator::kMin, Operator::kMax};

}  // namespace assay::algebra
