#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "planner/domain/reachability/reachability.h"

namespace assay::domain {

// Remembers reachability (reachability.h) for a planner that asks about the same few places again:
// no answer is computed twice. The problem must outlive it.
class KnownReachability {
 public:
  explicit KnownReachability(const Problem& problem) : problem_(problem) {}

  bool IsReachableAt(PartId part, GraspId grasp, const Pose& X_WorldPart);
  bool IsMateReachableAt(MatingId mating, GraspId grasp, const Pose& X_WorldFixed);
  bool IsMateReachableIn(MatingId mating, GraspId grasp, StablePoseId pose_of_fixed);

 private:
  struct Answer {
    Pose X_World;
    bool is_reachable = false;
  };
  template <class Which>
  using Answers = std::map<std::pair<Which, GraspId>, std::vector<Answer>>;

  bool ClearsFixed(MatingId mating, GraspId grasp);

  const Problem& problem_;
  Answers<PartId> parts_;
  Answers<MatingId> matings_;
  std::map<std::pair<MatingId, GraspId>, bool> clears_fixed_;
};

}  // namespace assay::domain
