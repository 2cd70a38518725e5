#include "planner/domain/matings/mating_classes.h"

#include <algorithm>
#include <cmath>

#include "planner/domain/actions/condition.h"

namespace assay::domain {

double LeastMatingFriction(const Problem& problem) {
  return problem.workcell->rules().friction - problem.tolerances.friction;
}

Limited MatingLean(const Problem& problem, const Mating& mating, const Pose& X_WorldFixed) {
  return {.value = LeanOf(X_WorldFixed.linear() * mating.mating_vector),
          .limit = std::atan(LeastMatingFriction(problem))};
}

// -v_z >= |v| cos(atan(mu)): the vector points into the cone about the downward direction.
bool InFrictionCone(const Problem& problem, const Mating& mating, const Pose& X_WorldFixed) {
  return MatingLean(problem, mating, X_WorldFixed).excess() <= kRounding;
}

bool HidesMatingFeatures(const Problem& problem, const Mating& mating, StablePoseId pose_of_fixed) {
  const auto& hidden =
      problem.part(mating.fixed).model->stable_poses()[pose_of_fixed.index()].hidden;
  return std::ranges::any_of(mating.features, [&](const auto& pair) {
    return std::ranges::binary_search(hidden, pair.second);
  });
}

bool LeavesMatingFeaturesFree(const Problem& problem, const Mating& mating, GraspId grasp) {
  const auto& hidden = (*problem.part(mating.held).grasps)[grasp.index()].hidden;
  return std::ranges::none_of(mating.features, [&](const auto& pair) {
    return std::ranges::binary_search(hidden, pair.first);
  });
}

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
