#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "planner/domain/problem/problem_file.h"
#include "planner/geometry/pose.h"
#include "planner/plan/data/plan.h"

// The workload of the growth test and of its benchmark: one part, picked up and put down n times.
namespace assay::bench {

struct PickAndPlace {
  domain::Problem problem;
  std::vector<plan::Action> actions;  // a pickup and a putdown for each of the n times
};

// Returns the workload for the block of Spar's worked example. The block stands on its end and is
// held across its sides, from straight above or with the tool leaning by `lean` radians. Each place
// is a little beside the previous place, and turned. The block's errors of 1 mm and 0.03 radians
// grow with each step. All preconditions of the first steps can be proved.
inline PickAndPlace MakePickAndPlace(int n, double lean) {
  const std::string root = ASSAY_SOURCE_DIR;
  PickAndPlace work{
      domain::ReadProblem(Document::Load(root + "/scenarios/spar-example.yaml"), root + "/models"),
      {}};
  const domain::PartId block(0);
  const geometry::Vector3 approach(-std::sin(lean), 0, -std::cos(lean));
  const geometry::Vector3 closing = geometry::Vector3::UnitY();
  const plan::Hold hold = {"across the block",
                           geometry::PoseFromColumns(closing.cross(approach), closing, approach,
                                                     geometry::Vector3(0.04, 0, 0.14)),
                           0.0762};
  geometry::Pose at = geometry::Translation(0.6, 0.1, 0);
  domain::Part& part = work.problem.parts[block.index()];
  part.X_WorldPart = at;
  part.error = {{-0.001, 0.001}, {-0.001, 0.001}, {-0.001, 0.001}, {-0.03, 0.03}};
  // The friction of the table stops no turn of the block in a grip that is as strong as this.
  domain::WorkcellRules rules = work.problem.workcell->rules();
  rules.grip_force = 10000;
  work.problem.workcell = work.problem.workcell->WithRules(rules);
  for (int i = 0; i < n; ++i) {
    const geometry::Pose next = geometry::Translation(0.5 + 0.02 * (i % 8), 0.015 * (i % 11), 0) *
                                geometry::RotationZ(0.4 * i);
    work.actions.push_back(
        {.kind = &domain::kPickup, .part = block, .hold = hold, .place = {"on-end", at}});
    work.actions.push_back(
        {.kind = &domain::kPutdown, .part = block, .hold = hold, .place = {"on-end", next}});
    at = next;
  }
  return work;
}

}  // namespace assay::bench
