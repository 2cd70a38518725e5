#include "planner/uncertainty/possible_masses.h"

namespace assay::uncertainty {

std::vector<geometry::MassProperties> PossibleMasses(const domain::Problem& problem,
                                                     domain::PartId part) {
  const domain::PartModel& model = *problem.part(part).model;
  std::vector<geometry::MassProperties> masses = {model.mass()};
  if (problem.tolerances.clearance == 0) return masses;
  for (const double error : {-problem.tolerances.clearance, problem.tolerances.clearance}) {
    masses.push_back(model.MassWithClearance(problem.clearance + error));
  }
  return masses;
}

}  // namespace assay::uncertainty
