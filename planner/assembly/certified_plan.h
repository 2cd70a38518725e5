#pragma once

#include "planner/constraint_posting/posting_planner.h"
#include "planner/constraint_posting/uncertainty_phase/uncertainty_phase.h"
#include "planner/domain/problem/problem.h"
#include "planner/plan/data/plan.h"

namespace assay::assembly {

// Makes a plan as constraint_posting::MakeCertifiedPlan does, and adds the travels that the plan
// needs (AddTravels). If no resolvers are given, the resolvers are those that the problem names. If
// no travels are found for the best plan instance, the best instance with travels is returned,
// among those whose straight lines the arm can follow (WorkJudge). If none of the first
// UncertaintyOptions::instances of these has travels, the outcome is kBudget, and the result names
// the obstruction of the first plan. The budget of partial plans also limits how many postures all
// searches for paths visit.
plan::PlanResult MakeCertifiedPlan(const domain::Problem& problem,
                                   const constraint_posting::PlannerOptions& planner,
                                   constraint_posting::UncertaintyOptions uncertainty);

}  // namespace assay::assembly
