#include "planner/domain/problem/problem.h"

#include <map>

namespace assay::domain {
namespace {

using SharedGrasps = std::shared_ptr<const std::vector<Grasp>>;

// Computes all grasps anew. Parts of one model share their grasps.
void FindGraspsAnew(Problem& problem) {
  std::map<const PartModel*, SharedGrasps> found;
  for (Part& part : problem.parts) {
    SharedGrasps& grasps = found[part.model.get()];
    if (!grasps) {
      grasps = std::make_shared<const std::vector<Grasp>>(
          ComputeGrasps(*part.model, problem.workcell->gripper(), GraspsIn(*problem.workcell)));
    }
    part.grasps = grasps;
  }
}

}  // namespace

GraspSearch GraspsIn(const Workcell& workcell) {
  return {.approach_step = workcell.rules().approach_step,
          .widest = workcell.gripper().max_opening()};
}

Problem WorkedBy(const Problem& problem, RobotId robot) {
  Problem other = problem;
  other.workcell = problem.workcell->WorkedBy(robot);
  if (other.workcell->robot().gripper_in_file != problem.workcell->robot().gripper_in_file) {
    FindGraspsAnew(other);
  }
  return other;
}

}  // namespace assay::domain
