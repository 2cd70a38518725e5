#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "planner/algebra/bounds/bound_file.h"

namespace assay::workloads {

// An expression whose range is known, with the times that peers took for it elsewhere
// (bench/workloads/expressions/measured.yaml).
struct MeasuredExpression {
  std::string name;
  algebra::BoundProblem problem;           // a problem with one expression
  Interval range;                          // range of the expression, to six digits
  std::vector<algebra::Expression> waves;  // sines and cosines of its angles
  double boost_us = 0;  // microseconds of one evaluation with Boost.Interval, `waves` included
  double ibex_ms = 0;   // milliseconds for both ends with IBEX's optimizer

  const algebra::Expression& expression() const { return problem.questions[0].expression; }
};

// Returns the expressions in the order of the table. Throws InputError.
std::vector<MeasuredExpression> LoadMeasuredExpressions(const std::filesystem::path& folder);

}  // namespace assay::workloads
