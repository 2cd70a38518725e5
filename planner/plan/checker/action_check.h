#pragma once

#include <string>
#include <vector>

#include "planner/domain/problem/problem.h"
#include "planner/geometry/box.h"
#include "planner/plan/checker/world_state.h"
#include "planner/plan/data/plan.h"

namespace assay::plan {

// Examines one action at a time in a given state of the world. It checks that the hold is a grasp,
// that the hand and the part in it are clear of everything, that the arm gets there, and that the
// part rests or mates. It works on the boxes of parts and gripper, the table, and the arm. It uses
// the parts' features only to know which faces they have.
//
// Motions above the retreated or pre-mating pose (at safe height, and straight down to there) are
// not examined.
class ActionChecker {
 public:
  explicit ActionChecker(const domain::Problem& problem);

  // Returns the geometric conditions that the action breaks, in words with their values.
  std::vector<std::string> BrokenConditions(const WorldState& before, const Action& action) const;

 private:
  class Examination;

  const domain::Problem& problem_;
  std::vector<geometry::Vector3> centers_;  // centres of mass, by PartId
};

}  // namespace assay::plan
