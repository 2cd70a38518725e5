#include "planner/uncertainty/preconditions/precondition.h"

#include <algorithm>

namespace assay::uncertainty {

void Preconditions::Less(plan::Condition condition, std::string meaning,
                         const Expression& expression, double limit, PartId neighbour) {
  Add({condition, std::move(meaning), expression, plan::Relation::kLess, limit, neighbour});
}

void Preconditions::Greater(plan::Condition condition, std::string meaning,
                            const Expression& expression, double limit, PartId neighbour) {
  Add({condition, std::move(meaning), expression, plan::Relation::kGreater, limit, neighbour});
}

void Preconditions::Within(plan::Condition condition, const std::string& meaning,
                           const Expression& expression, double limit) {
  Less(condition, meaning, expression, limit);
  Greater(condition, meaning, expression, -limit);
}

void Preconditions::Add(Precondition precondition) {
  const bool known = std::ranges::any_of(preconditions_, [&](const Precondition& other) {
    return other.condition == precondition.condition &&
           other.expression == precondition.expression && other.relation == precondition.relation &&
           other.limit == precondition.limit;
  });
  if (!known) preconditions_.push_back(std::move(precondition));
}

}  // namespace assay::uncertainty
