#pragma once

#include "planner/geometry/pose.h"
#include "planner/geometry/solids/mass_properties.h"
#include "tests/planner/uncertainty/action_lists.h"

// Test data: Spar's block on its end, with its axes parallel to the world's, and poses of the hand
// above the block.
namespace assay::uncertainty {

constexpr PartId kBlock(0);

struct Errors {
  double length = 0.002;  // error of the part, metres
  double angle = 0.05;    // error of the part, radians
  double hand = 1e-4;     // error of the hand, metres; its angle errs by ten times as many radians
};

// Returns a problem with this block. Its pads do not jam, because their friction cone of 3 degrees
// is smaller than the angle at which their contacts can lie aside.
inline domain::Problem UprightBlock(const Errors& errors) {
  domain::Problem problem = LoadScenario("spar-example");
  domain::Part& block = problem.parts[kBlock.index()];
  block.X_WorldPart = geometry::Translation(0.6, 0.1, 0);
  block.error = Symmetric(errors.length, errors.angle);
  problem.gripper_error = Symmetric(errors.hand, 10 * errors.hand);
  domain::WorkcellRules rules = problem.workcell->rules();
  rules.pad_friction = 0.05;
  problem.workcell = problem.workcell->WithRules(rules);
  return problem;
}

// Returns a hold from straight above the centre of mass, midway between two faces. The pads close
// along `closing`, a direction of the part.
inline plan::Hold HoldFromAbove(const domain::Problem& problem, const Vector3& closing) {
  const Vector3 down = -Vector3::UnitZ();
  Vector3 above = problem.part(kBlock).model->mass().center + Vector3(0, 0, 0.05);
  const Vector3 middle(1.5 * kInch, 0, 0);  // of the block's lower end
  above += closing * closing.dot(middle - above);
  return {"from above", geometry::PoseFromColumns(closing.cross(down), closing, down, above),
          3 * kInch};
}

inline plan::Place PlaceOf(const domain::Problem& problem) {
  return {"on-end", problem.part(kBlock).X_WorldPart};
}

}  // namespace assay::uncertainty
