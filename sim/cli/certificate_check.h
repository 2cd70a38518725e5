#pragma once

#include <string>
#include <vector>

#include "planner/domain/problem.h"
#include "planner/plan/checker.h"
#include "planner/plan/plan.h"

namespace assay::cli {

// What in a plan's certificates does not hold up, found out from the plan alone: each expression is
// bounded anew over its certificate's variables. Found are preconditions that are said to be proved
// and are not; margins that are not from the bound to the limit; bounds that the expression
// crosses, or is further from at the worst corner than the gap says; corners outside of the ranges;
// an error count that is not the number of steps with unproved preconditions; such steps without a
// verification, if the workcell has one for their action; and strategies of whose errors nothing is
// claimed, or with wider limits than they are certain for. What a strategy absorbs need not be
// proved. None for a plan without certificates.
//
// That an expression is the one which the step needs cannot be seen here.
//
// `file`: where the plan comes from. Throws InputError if an expression or a variable of a
// certificate does not read.
std::vector<plan::Flaw> CertificateFlaws(const domain::Problem& problem, const plan::Plan& plan,
                                         const std::string& file);

}  // namespace assay::cli
