#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "planner/algebra/linear/constraint_set.h"

namespace assay::algebra {

// Expressions to be bounded, as `assay bound` reads them.
struct BoundProblem {
  struct Question {
    std::string text;  // as the file has it
    Expression expression;
  };

  std::unique_ptr<ExpressionPool> pool;  // of all expressions
  ConstraintSet constraints;
  std::vector<Question> questions;
};

// Reads, in JSON or YAML:
//   {"variables": {"x": [0, "inf"], "t": ["-5.5 deg", "5.5 deg"]},
//    "constraints": ["x <= y + 1"],
//    "expressions": ["3*cos(t) + x"]}
// with one expression at least. A variable's ends are numbers, "N deg" (in radians, rounded
// outward), "inf" or "-inf".
// Constraints compare two expressions (text.h) by <=, >=, < or > (the strict ones count as closed:
// the bounds are the same or larger) or ==; there may be none. Throws InputError with the place of
// what is wrong.
BoundProblem ReadBoundProblem(const std::string& text, const std::string& file_name);
BoundProblem LoadBoundProblem(const std::filesystem::path& file);

}  // namespace assay::algebra
