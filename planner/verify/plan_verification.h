#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "planner/domain/problem/problem.h"
#include "planner/plan/check/checker.h"
#include "planner/plan/data/plan.h"

namespace assay::verify {

// A plan and where it comes from.
struct Submitted {
  const domain::Problem& problem;
  const plan::Plan& plan;
  std::string file;         // names the plan in messages
  bool is_of_file = false;  // it was read from the file, and not planned in this process
  // Receives the name of each part of the verification as it begins; may be empty.
  std::function<void(std::string_view)> progress = {};
};

// Verifies everything that a plan says: that its actions can be executed in each order of its steps
// (at most `most_linearizations`), that strategies and travels hold up (assembly::Check), that the
// certificates do not contradict themselves (certificate_check.h) and, if the plan was read from a
// file, that they come out the same when they are computed anew (certificate_comparison.h). Throws
// InputError if an expression of a certificate cannot be read.
plan::CheckReport Verify(const Submitted& submitted, int most_linearizations);

// Verifies only what a plan says of itself: strategies, certificates, and which conditions the
// certificates cover.
std::vector<plan::Flaw> FlawsOfClaims(const Submitted& submitted);

}  // namespace assay::verify
