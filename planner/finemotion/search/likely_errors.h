#pragma once

#include "planner/finemotion/contacts/mating.h"

namespace assay::finemotion {

// Tells of each unwanted contact of a plan's strategy the errors that it speaks of
// (plan::UnwantedContact::likely): the mean of those that lead to it, of errors drawn from a box
// twice as wide as planned for and replayed in exact geometry. Dakin and Popplestone (section 5)
// recover from an error state by what is known of it, and leave open what that is.
//
// `errors`, `options`: with which the plan was searched for.
void TellLikelyErrors(const MatingGeometry& geometry, const FineMotionPlan& plan,
                      const FineMotionErrors& errors, const StrategyOptions& options,
                      plan::Strategy& strategy);

}  // namespace assay::finemotion
