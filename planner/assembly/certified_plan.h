#pragma once

#include "planner/domain/problem/problem.h"
#include "planner/plan/data/plan.h"
#include "planner/posting/posting_planner.h"
#include "planner/posting/uncertainty_phase/uncertainty_phase.h"

namespace assay::assembly {

// posting::MakeCertifiedPlan with the resolvers that the problem names, unless others are given,
// and with the travels that the plan needs (AddTravels). If the arm cannot execute the best plan
// instance, as far as paths were looked for, the best of those that it can; if there is none among
// UncertaintyOptions::instances, the outcome is kBudget, with what was in the way.
plan::PlanResult MakeCertifiedPlan(const domain::Problem& problem,
                                   const posting::PlannerOptions& planner,
                                   posting::UncertaintyOptions uncertainty);

}  // namespace assay::assembly
