#include "planner/constraint_posting/uncertainty_phase/uncertainty_options.h"

#include <algorithm>
#include <iterator>

#include "planner/constraint_posting/resolvers/sensing_resolver.h"
#include "planner/constraint_posting/resolvers/squeezing_resolver.h"

namespace assay::constraint_posting {

std::vector<plan::Condition> UncertaintyOptions::Absorbable() const {
  std::vector<plan::Condition> conditions;
  for (const auto& resolver : resolvers) {
    std::ranges::move(resolver->absorbs(), std::back_inserter(conditions));
  }
  return conditions;
}

UncertaintyOptions WithDefaults(UncertaintyOptions options) {
  if (options.resolvers.empty()) {
    options.resolvers = {std::make_shared<SensingResolver>(),
                         std::make_shared<SqueezingResolver>()};
  }
  return options;
}

}  // namespace assay::constraint_posting
