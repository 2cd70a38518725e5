#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "planner/algebra/sup_inf/constraint_set.h"

namespace assay::algebra {

// The expressions that `assay bound` reads in order to bound them.
struct BoundProblem {
  struct Question {
    std::string text;  // the expression as it is written in the file
    Expression expression;
  };

  std::unique_ptr<ExpressionPool> pool;  // owns all expressions
  ConstraintSet constraints;
  std::vector<Question> questions;
};

// Reads a problem in JSON or YAML, for example:
//   {"variables": {"x": [0, "inf"], "t": ["-5.5 deg", "5.5 deg"]},
//    "constraints": ["x <= y + 1"],
//    "expressions": ["3*cos(t) + x"]}
// At least one expression is required. The ends of a variable are numbers, "N deg" (converted to
// radians and rounded outward), "inf" or "-inf". A constraint compares two expressions (text.h) by
// <=, >=, <, > or ==. Strict comparisons count as closed, so that the bounds are the same or
// larger. Constraints are optional. Throws InputError with the place of the error.
BoundProblem ReadBoundProblem(const std::string& text, const std::string& file_name);
BoundProblem LoadBoundProblem(const std::filesystem::path& file);

}  // namespace assay::algebra
