#pragma once

#include <span>
#include <string>
#include <vector>

#include "planner/algebra/expression/expression.h"

namespace assay::algebra {

// Returns e as text, for example "2 + 3*cos(tg)*dx^2 - min(x, sqrt(y))/4". Each number is written
// with enough digits to be read back as the same double. Parse(Text(e)) == e (parse.h) holds in the
// same pool if the numbers are finite and Parse accepts the nesting and the exponents.
std::string Text(const Expression& e);

// The texts of several expressions of one pool. A sub-expression that occurs more than once is
// written only once, in `shared`. The text at place i of `shared` is called #i in the later texts
// of `shared` and in `expressions`.
struct SharedTexts {
  std::vector<std::string> shared;
  std::vector<std::string> expressions;  // as many as the given expressions
};
SharedTexts TextsOf(std::span<const Expression> expressions);

}  // namespace assay::algebra
