#pragma once

#include <string>
#include <vector>

#include "planner/base/document/input_error.h"
#include "planner/domain/problem/problem.h"
#include "planner/plan/data/plan.h"

namespace assay::plan {

// One thing that is wrong with a plan.
struct Flaw {
  StepId step;           // where; None: of the plan as a whole
  std::string what;      // the broken precondition or geometric condition, with its values
  FilePlace place = {};  // of the step in the file that it was read from, if it was
};

struct CheckReport {
  std::vector<Flaw> flaws;
  int linearizations = 0;   // how many orders were gone through
  bool all_orders = false;  // whether that was all of them
};

// Checks a plan from the scenario alone, with its own model of what the actions do and its own
// geometry: it shares no code with the planner and trusts no label. Every linearization of the
// ordering is gone through, up to `most_linearizations`; the order of execution always is. Goals
// must hold at the end of each. Of strategies the form alone is checked (FlawsOfForm), and of
// certificates what they cover (condition_kind.h); planner/assembly/plan_check.h replays the
// strategies, too, and planner/uncertainty/preconditions/certify.h computes certificates anew.
CheckReport Check(const domain::Problem& problem, const Plan& plan, int most_linearizations);

// Of certificates: whether each covers what its step needs. If one step has one, all have.
std::vector<Flaw> FlawsOfCoverage(const Plan& plan);

}  // namespace assay::plan
