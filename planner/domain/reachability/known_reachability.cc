#include "planner/domain/reachability/known_reachability.h"

#include <algorithm>

namespace assay::domain {
namespace {

template <class Answer, class Find>
bool Recall(std::vector<Answer>& known, const Pose& X_World, const Find& find) {
  const auto answer = std::ranges::find_if(
      known, [&](const Answer& other) { return other.X_World.matrix() == X_World.matrix(); });
  if (answer != known.end()) return answer->is_reachable;
  return known.emplace_back(X_World, find()).is_reachable;
}

}  // namespace

bool KnownReachability::IsReachableAt(PartId part, GraspId grasp, const Pose& X_WorldPart) {
  return Recall(parts_[{part, grasp}], X_WorldPart,
                [&] { return domain::IsReachableAt(problem_, part, grasp, X_WorldPart); });
}

bool KnownReachability::IsMateReachableAt(MatingId mating, GraspId grasp,
                                          const Pose& X_WorldFixed) {
  return Recall(matings_[{mating, grasp}], X_WorldFixed, [&] {
    return ClearsFixed(mating, grasp) &&
           IsMatingPlaceReachableAt(problem_, mating, grasp, X_WorldFixed);
  });
}

bool KnownReachability::IsMateReachableIn(MatingId mating, GraspId grasp,
                                          StablePoseId pose_of_fixed) {
  return ClearsFixed(mating, grasp) &&
         IsMatingPlaceReachableIn(problem_, mating, grasp, pose_of_fixed);
}

bool KnownReachability::ClearsFixed(MatingId mating, GraspId grasp) {
  const auto [known, is_new] = clears_fixed_.try_emplace({mating, grasp});
  if (is_new) known->second = HandClearsFixed(problem_, mating, grasp);
  return known->second;
}

}  // namespace assay::domain
