#pragma once

#include "planner/finemotion/strategy_search/mating.h"

namespace assay::finemotion {

// Stores with each unwanted contact of the plan's strategy the errors that it points to
// (plan::UnwantedContact::likely). Errors are drawn from a box twice as wide as the planned one,
// and replayed in exact geometry. The stored errors are the mean of those that lead to the contact.
// Dakin and Popplestone (section 5) recover from an error state by what is known about the state,
// but do not say what is known.
//
// `errors` and `options` must be those with which the plan was searched for.
void TellLikelyErrors(const MatingGeometry& geometry, const FineMotionPlan& plan,
                      const FineMotionErrors& errors, const StrategyOptions& options,
                      plan::Strategy& strategy);

}  // namespace assay::finemotion
