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
  double greatest = 0;
  for (const geometry::MassProperties& mass : PossibleMasses(problem, part)) {
    greatest = std::max(greatest, mass.mass);
  }
  return greatest * kGravity;
}

}  // namespace assay::uncertainty
