#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "planner/algebra/bounds/bound_file.h"

namespace assay::workloads {

// An expression whose range is known, with what peers took for it elsewhere
// (bench/workloads/expressions/measured.yaml).
struct MeasuredExpression {
  std::string name;
  algebra::BoundProblem problem;           // of one expression
  Interval range;                          // to six digits
  std::vector<algebra::Expression> waves;  // sines and cosines of its angles
  double boost_us = 0;                     // one evaluation with Boost.Interval, and of the waves
  double ibex_ms = 0;                      // both ends with IBEX's optimizer

  const algebra::Expression& expression() const { return problem.questions[0].expression; }
};

// In the order of the table. Throws InputError.
std::vector<MeasuredExpression> LoadMeasuredExpressions(const std::filesystem::path& folder);

}  // namespace assay::workloads
