#pragma once

#include <optional>

#include "planner/algebra/bounding_methods/glance.h"
#include "planner/algebra/bounds/bounds.h"
#include "planner/plan/certificates/certificate.h"
#include "planner/uncertainty/error_sets/uncertain_world.h"
#include "planner/uncertainty/preconditions/precondition.h"

namespace assay::uncertainty {

// Returns a bound of the precondition's expression on the side of its limit. The work ends as soon
// as the bound, or a point, decides whether the precondition is true for all errors.
algebra::Bound BoundOf(const Precondition& precondition, const UncertainWorld& world,
                       const algebra::BoundRequest& request);

// Returns the same bound for a precondition that it proves. For any other precondition, the bound
// tells better by how much the precondition fails: the cheap methods go on where a point has
// decided.
algebra::Bound ToldBound(const Precondition& precondition, const UncertainWorld& world,
                         const algebra::BoundRequest& request);

// Takes the value and the method of another bound if it is tighter.
void Tighten(const algebra::Bound& other, plan::Relation relation, algebra::Bound& bound);

// Returns what a certificate says of a precondition with this bound, except for its expression and
// its worst corner.
plan::CertifiedPrecondition ClaimOf(const Precondition& precondition, const algebra::Bound& bound);

// Returns the claim, if quick bounds (algebra/bounding_methods/glance.h) tell whether it holds.
std::optional<plan::CertifiedPrecondition> Seen(const Precondition& precondition,
                                                const algebra::Glance& glance);

}  // namespace assay::uncertainty
