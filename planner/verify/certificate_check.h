#pragma once

#include <string>
#include <vector>

#include "planner/plan/checker/checker.h"
#include "planner/plan/data/plan.h"

namespace assay::verify {

// Returns whether verification finds a precondition of the step that is not proved, and that the
// step's strategy does not make unnecessary.
bool IsUnproved(const plan::PlannedStep& step);

// Returns the contradictions within a plan's certificates, found from the plan alone. Each
// expression is bounded anew over its certificate's variables. The flaws found are:
//
// - a precondition that is said to be proved and is not, unless a strategy makes it unnecessary
// - a margin that is not the distance from the bound to the limit
// - a bound that the expression crosses, or a worst corner at which the expression is farther from
//   the bound than the gap says
// - a corner outside of the ranges
// - an error count that is not the number of steps with unproved preconditions
// - a strategy without claims about the tip errors, or with claims that allow greater errors than
//   the strategy is certain for
//
// A plan without certificates has no flaws.
//
// certificate_comparison.h checks that sets and expressions are those that the step needs.
//
// `file` is the plan's path. Throws InputError if an expression or a variable of a certificate
// cannot be read.
std::vector<plan::Flaw> CertificateFlaws(const plan::Plan& plan, const std::string& file);

}  // namespace assay::verify
