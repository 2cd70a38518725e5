#include <cmath>

#include "planner/constraint_posting/posting_planner.h"
#include "planner/domain/problem/problem_file.h"
#include "planner/geometry/box.h"
#include "planner/geometry/collision.h"
#include "planner/geometry/pose.h"
#include "planner/motion/paths/tree_search.h"

namespace {

bool Plans() {
  const std::filesystem::path data = DATA_DIR;
  const auto scenario = assay::Document::Load(data / "scenarios/spar-fig15.yaml");
  const auto problem = assay::domain::ReadProblem(scenario, data / "models");
  const auto result = assay::constraint_posting::MakePlan(problem, {});
  return result.plan.steps.size() == 2;  // pickup, assemble
}

// Tests the module that links FCL.
bool TellsDistances() {
  using namespace assay::geometry;
  const Box cube{Pose::Identity(), Vector3(0.5, 0.5, 0.5)};
  const CollisionShape shape({&cube, 1});
  return std::abs(Distance(shape, Pose::Identity(), shape, Translation(3, 0, 0)) - 2) < 1e-6;
}

// Tests the module that links OMPL.
bool FindsPaths() {
  using assay::kinematics::JointVector;
  const JointVector one = JointVector::Ones();
  const auto path = assay::motion::TreeSearchOfOmpl().FindPath(
      {.lower = -one,
       .upper = one,
       .start = -0.5 * one,
       .goal = 0.5 * one,
       .longest_motion = 4,
       .draw = [] { return JointVector(JointVector::Zero()); },
       .is_free = [](const JointVector&, const JointVector&) { return true; },
       .is_over = [] { return false; }});
  return path.size() >= 2;
}

}  // namespace

int main() { return Plans() && TellsDistances() && FindsPaths() ? 0 : 1; }
