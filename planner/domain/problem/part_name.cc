#include "planner/domain/problem/part_name.h"

#include <string>
#include <vector>

namespace assay::domain {

PartId ReadPartName(const Value& value, const Problem& problem) {
  std::vector<std::string> names;
  for (const Part& part : problem.parts) names.push_back(part.name);
  return PartId(value.OneOf(names));
}

}  // namespace assay::domain
