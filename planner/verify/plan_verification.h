#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "planner/domain/problem/problem.h"
#include "planner/plan/checker/checker.h"
#include "planner/plan/data/plan.h"

namespace assay::verify {

// A plan and where it comes from.
struct Submitted {
  const domain::Problem& problem;
  const plan::Plan& plan;
  std::string file;  // names the plan in messages
  // True if the plan was read from the file, and false if it was made in this process.
  bool is_of_file = false;
  // Receives the name of each part of the verification as it begins; may be empty.
  std::function<void(std::string_view)> progress = {};
};

// Verifies all claims of a plan. Its actions must be possible in each order of its steps (at most
// `most_linearizations` orders are tried), and its strategies and travels must be valid
// (assembly::Check). Its certificates must not contradict themselves (certificate_check.h). If the
// plan was read from a file, certificates that are computed anew must be the same
// (certificate_comparison.h). Throws InputError if an expression of a certificate cannot be read.
plan::CheckReport Verify(const Submitted& submitted, int most_linearizations);

}  // namespace assay::verify
