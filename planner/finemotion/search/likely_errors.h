#pragma once

#include "planner/finemotion/contacts/mating.h"

namespace assay::finemotion {

// Stores with each unwanted contact of the plan's strategy the errors that it points to
// (plan::UnwantedContact::likely). They are the mean of the errors that lead to the contact, among
// errors drawn from a box twice as wide as planned for and replayed in exact geometry. Dakin and
// Popplestone (section 5) recover from an error state by what is known of it, and leave open what
// that is.
//
// `errors` and `options` must be those with which the plan was searched for.
void TellLikelyErrors(const MatingGeometry& geometry, const FineMotionPlan& plan,
                      const FineMotionErrors& errors, const StrategyOptions& options,
                      plan::Strategy& strategy);

}  // namespace assay::finemotion
