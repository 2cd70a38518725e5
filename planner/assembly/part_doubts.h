#pragma once

#include <vector>

#include "planner/domain/problem/problem.h"
#include "planner/plan/check/world_state.h"
#include "planner/plan/data/plan.h"

namespace assay::assembly {

// How far the points of parts may be from where they are believed to be: at first by the scenario's
// errors, then by what the certificates of the steps say.
class PartDoubts {
 public:
  explicit PartDoubts(const domain::Problem& problem);

  void Take(const std::vector<plan::ErrorSet>& sets);
  // Of each part by PartId, metres, for any of its points.
  std::vector<double> In(const plan::WorldState& state) const;

  // What is not bounded, or by more, counts as so much.
  static constexpr double kMost = 0.05;

 private:
  const domain::Problem& problem_;
  std::vector<plan::ErrorSet> sets_;  // by PartId
};

// The same of the points of the hand, by the error of the gripper.
double HandDoubt(const domain::Problem& problem);

}  // namespace assay::assembly
