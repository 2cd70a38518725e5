#pragma once

#include <memory>
#include <vector>

#include "planner/domain/problem.h"
#include "planner/posting/posting_planner.h"
#include "planner/posting/resolver.h"
#include "planner/posting/uncertainty_phase.h"

namespace assay::assembly {

// The resolvers of these kinds, in this order: sensing, squeezing, fine motion.
std::vector<std::shared_ptr<posting::Resolver>> Resolvers(
    const std::vector<domain::ResolverKind>& kinds, uncertainty::Propagation propagation);

// posting::MakeCertifiedPlan with the resolvers that the problem names, unless others are given.
plan::PlanResult MakeCertifiedPlan(const domain::Problem& problem,
                                   const posting::PlannerOptions& planner,
                                   posting::UncertaintyOptions uncertainty);

}  // namespace assay::assembly
