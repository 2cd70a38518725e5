#pragma once

#include "planner/base/random.h"
#include "planner/numeric/interval_arithmetic.h"
#include "tests/oracle/linear_program.h"

namespace assay::algebra {

// Returns a system with small integers and eighths. About a third of the ends of intervals are
// finite. The system may be unbounded or contradictory.
inline oracle::LinearProgram RandomLinearProgram(RandomStream& random, int variables, int rows) {
  const auto is_one_in = [&](int n) { return random.Index(n) == 0; };
  const auto number = [&](int most) {
    return (random.Index(2 * most + 1) - most) * (is_one_in(3) ? 0.125 : 1.0);
  };
  oracle::LinearProgram program;
  for (int v = 0; v < variables; ++v) {
    const double low = is_one_in(3) ? number(4) - 5 : -kInfinity;
    const double high = is_one_in(3) ? number(4) + 5 : kInfinity;
    program.box.push_back({low, high});
    program.objective.push_back(number(3));
  }
  for (int i = 0; i < rows; ++i) {
    oracle::LinearProgram::Row row;
    for (int v = 0; v < variables; ++v) {
      row.coefficients.push_back(is_one_in(2) ? 0 : number(4));
    }
    row.upper = number(6) + 4;
    program.rows.push_back(row);
  }
  return program;
}

}  // namespace assay::algebra
