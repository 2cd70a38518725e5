#include "planner/uncertainty/preconditions/bounded_claim.h"

#include <algorithm>
#include <string>

namespace assay::uncertainty {

using algebra::Bound;
using plan::CertifiedPrecondition;
using plan::Relation;

namespace {

Bound BoundBy(const Precondition& precondition, const UncertainWorld& world,
              const algebra::BoundRequest& request) {
  return precondition.relation == Relation::kLess
             ? BoundAbove(precondition.expression, world.constraints(), request)
             : BoundBelow(precondition.expression, world.constraints(), request);
}

}  // namespace

Bound BoundOf(const Precondition& precondition, const UncertainWorld& world,
              const algebra::BoundRequest& request) {
  algebra::BoundRequest deciding = request;
  deciding.limit = precondition.limit;
  return BoundBy(precondition, world, deciding);
}

Bound ToldBound(const Precondition& precondition, const UncertainWorld& world,
                const algebra::BoundRequest& request) {
  Bound bound = BoundOf(precondition, world, request);
  if (ClaimOf(precondition, bound).holds()) return bound;
  algebra::BoundRequest cheap = request;
  cheap.highest = std::min(request.highest, algebra::BoundingMethod::kMonotone);
  cheap.limit.reset();
  Tighten(BoundBy(precondition, world, cheap), precondition.relation, bound);
  return bound;
}

CertifiedPrecondition ClaimOf(const Precondition& precondition, const Bound& bound) {
  const bool less = precondition.relation == Relation::kLess;
  return {.condition = precondition.condition,
          .meaning = precondition.meaning,
          .expression = {},
          .relation = precondition.relation,
          .limit = precondition.limit,
          .bound = bound.value,
          .margin = less ? precondition.limit - bound.value : bound.value - precondition.limit,
          .gap = bound.gap,
          .method = std::string(algebra::Name(bound.method)),
          .worst = {},
          .circumstance = precondition.circumstance};
}

void Tighten(const Bound& other, Relation relation, Bound& bound) {
  const double gain =
      relation == Relation::kLess ? bound.value - other.value : other.value - bound.value;
  if (!(gain > 0)) return;
  bound.value = other.value;
  bound.method = other.method;
  bound.gap = std::max(0., bound.gap - gain);
}

std::optional<CertifiedPrecondition> Seen(const Precondition& precondition,
                                          const algebra::Glance& glance) {
  const bool less = precondition.relation == Relation::kLess;
  const double limit = precondition.limit;
  const bool holds = less ? glance.bound < limit : glance.bound > limit;
  const bool fails = less ? glance.attained >= limit : glance.attained <= limit;
  if (!holds && !fails) return std::nullopt;
  return ClaimOf(precondition, {.value = glance.bound});
}

}  // namespace assay::uncertainty
