#include "planner/domain/matings/mating_classes.h"

#include "planner/domain/actions/condition.h"
#include "planner/domain/reachability/reachability.h"

namespace assay::domain {

std::vector<int> GraspList(const Problem& problem, const Mating& mating) {
  std::vector<int> labels;
  for (int g = 0; g < GraspLabelCount(problem.part(mating.held)); ++g) {
    if (LeavesMatingFeaturesFree(problem, mating, GraspId(g))) labels.push_back(g);
  }
  return labels;
}

namespace {

bool AllowsMating(const Problem& problem, const Mating& mating, StablePoseId pose) {
  const Part& fixed = problem.part(mating.fixed);
  return !HidesMatingFeatures(problem, mating, pose) &&
         InFrictionCone(problem, mating, fixed.model->stable_poses()[pose.index()].X_TablePart);
}

}  // namespace

std::vector<int> PositionList(const Problem& problem, const Mating& mating) {
  const Part& fixed = problem.part(mating.fixed);
  std::vector<int> labels;
  for (int p = 0; p < InitialLabel(fixed); ++p) {
    if (AllowsMating(problem, mating, StablePoseId(p))) labels.push_back(p);
  }
  if (!fixed.position_class.IsNone() && AllowsMating(problem, mating, fixed.position_class)) {
    labels.push_back(InitialLabel(fixed));
  }
  return labels;
}

}  // namespace assay::domain
