#pragma once

#include <vector>

#include "planner/domain/problem/problem.h"
#include "planner/motion/collision/surroundings.h"
#include "planner/plan/checker/world_state.h"
#include "planner/plan/data/plan.h"

namespace assay::assembly {

// Bounds on how far parts are from their believed places. At first they come from the scenario's
// error bounds, and later from the certificates of the steps.
class PartErrorBounds {
 public:
  explicit PartErrorBounds(const domain::Problem& problem);

  void Take(const std::vector<plan::ErrorSet>& sets);
  // Returns, indexed by PartId, the errors that travels assume.
  std::vector<motion::PlaceError> In(const plan::WorldState& state) const;

  // The greatest shift, in metres, with which ways are searched for. It stands for all shifts that
  // are greater or not bounded, and nothing is proved about ways with such shifts.
  static constexpr double kMost = 0.05;

 private:
  const domain::Problem& problem_;
  std::vector<plan::ErrorSet> sets_;  // indexed by PartId
};

// Returns the bound in metres for any point of the hand, from the gripper's error bounds.
double HandDoubt(const domain::Problem& problem);

}  // namespace assay::assembly
