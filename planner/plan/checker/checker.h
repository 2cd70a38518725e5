#pragma once

#include <string>
#include <vector>

#include "planner/base/input_files/input_error.h"
#include "planner/domain/problem/problem.h"
#include "planner/plan/data/plan.h"

namespace assay::plan {

// One thing that is wrong with a plan.
struct Flaw {
  StepId step;           // the step that is wrong; None: the plan as a whole
  std::string what;      // the broken precondition or geometric condition, with its values
  FilePlace place = {};  // place of the step in the file that it was read from, if any
};

struct CheckReport {
  std::vector<Flaw> flaws;
  int linearizations = 0;   // number of orders that were simulated
  bool all_orders = false;  // whether these were all orders
};

// Checks a plan from the scenario alone, with its own model of what the actions do and its own
// geometry: it shares no code with the planner and trusts no label. It simulates the linearizations
// of the ordering, up to `most_linearizations`, and always the order of execution. Goals must hold
// at the end of each. Of strategies, only the form is checked (FlawsOfForm). Of certificates, it is
// only checked which kinds of preconditions they cover (coverage.h). planner/assembly/plan_check.h
// replays the strategies, too, and planner/verify computes certificates anew and compares them.
CheckReport Check(const domain::Problem& problem, const Plan& plan, int most_linearizations);

// Returns which certificates lack something. Each certificate must have every kind of precondition
// that its step needs. If one step has a certificate, all must have one. The plan's list of effects
// that no precondition covers must be the true list. The proofs are not checked here.
std::vector<Flaw> FlawsOfCoverage(const domain::Problem& problem, const Plan& plan);

}  // namespace assay::plan
