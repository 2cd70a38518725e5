#pragma once

#include <string>
#include <vector>

#include "planner/domain/problem/problem.h"
#include "planner/geometry/box.h"
#include "planner/plan/check/world_state.h"
#include "planner/plan/data/plan.h"

namespace assay::plan {

// Examines one action at a time in a given state of the world: whether the hold is a grasp, the
// hand and what it carries are clear of everything, the arm gets there, the part rests or mates.
// Works on the boxes of parts and gripper, the table, and the arm; of the parts' features it takes
// only which faces they are.
//
// Motions above the retreated or pre-mating pose (at safe height, and straight down to there) are
// not examined.
class ActionChecker {
 public:
  explicit ActionChecker(const domain::Problem& problem);

  // The geometric conditions that the action breaks, in words with their values.
  std::vector<std::string> BrokenConditions(const WorldState& before, const Action& action) const;

 private:
  class Examination;

  const domain::Problem& problem_;
  std::vector<geometry::Vector3> centers_;  // of mass, by PartId
};

}  // namespace assay::plan
