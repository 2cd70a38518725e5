#include "planner/uncertainty/preconditions/precondition.h"

#include <algorithm>

namespace assay::uncertainty {

void Preconditions::Less(std::string condition, std::string meaning, const Expression& expression,
                         double limit, PartId neighbour) {
  Add({std::move(condition), std::move(meaning), expression, plan::Relation::kLess, limit,
       neighbour});
}

void Preconditions::Greater(std::string condition, std::string meaning,
                            const Expression& expression, double limit, PartId neighbour) {
  Add({std::move(condition), std::move(meaning), expression, plan::Relation::kGreater, limit,
       neighbour});
}

void Preconditions::Within(const std::string& condition, const std::string& meaning,
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
