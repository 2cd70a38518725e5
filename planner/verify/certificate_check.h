#pragma once

#include <string>
#include <vector>

#include "planner/plan/check/checker.h"
#include "planner/plan/data/plan.h"

namespace assay::verify {

// Whether any step has a certificate: else the plan was made without regard to uncertainty.
bool IsCertified(const plan::Plan& plan);

// Whether some precondition of the step is not proved, and not absorbed by its strategy.
bool IsUnproved(const plan::PlannedStep& step);

// What in a plan's certificates contradicts itself, found out from the plan alone: each expression
// is bounded anew over its certificate's variables. Found are preconditions that are said to be
// proved and are not; margins that are not from the bound to the limit; bounds that the expression
// crosses, or is further from at the worst corner than the gap says; corners outside of the ranges;
// an error count that is not the number of steps with unproved preconditions; and strategies of
// whose errors nothing is claimed, or with wider limits than they are certain for. What a strategy
// absorbs need not be proved. None for a plan without certificates.
//
// Whether sets and expressions are those that the step needs: certificate_comparison.h.
//
// `file`: where the plan comes from. Throws InputError if an expression or a variable of a
// certificate does not read.
std::vector<plan::Flaw> CertificateFlaws(const plan::Plan& plan, const std::string& file);

}  // namespace assay::verify
