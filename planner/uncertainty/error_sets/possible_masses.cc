#include "planner/uncertainty/error_sets/possible_masses.h"

#include <algorithm>

#include "planner/domain/parts/part_file.h"
#include "planner/geometry/solids/mass_properties.h"

namespace assay::uncertainty {

std::vector<geometry::MassProperties> PossibleMasses(const domain::Problem& problem,
                                                     domain::PartId part) {
  const domain::PartModel& model = *problem.part(part).model;
  std::vector<geometry::MassProperties> masses = {model.mass()};
  if (problem.tolerances.clearance == 0) return masses;
  for (const double error : {-problem.tolerances.clearance, problem.tolerances.clearance}) {
    masses.push_back(domain::PartFile::MassWithClearance(model, problem.clearance + error));
  }
  return masses;
}

double GreatestWeight(const domain::Problem& problem, domain::PartId part) {
  return std::ranges::max(PossibleMasses(problem, part), {}, &geometry::MassProperties::mass).mass *
         kGravity;
}

double LeastWeight(const domain::Problem& problem, domain::PartId part) {
  return std::ranges::min(PossibleMasses(problem, part), {}, &geometry::MassProperties::mass).mass *
         kGravity;
}

}  // namespace assay::uncertainty
