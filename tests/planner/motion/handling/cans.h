#pragma once

#include "planner/domain/problem/problem_file.h"
#include "planner/geometry/pose.h"
#include "planner/motion/collision/collision_scene.h"

namespace assay::motion {

constexpr PartId kCan(0);
constexpr PartId kOtherCan(1);
constexpr PartId kPost(2);

// Returns the scenario with two cans on the first of two tables, and a post beside the gap between
// the tables.
inline const domain::Problem& Cans() {
  static const domain::Problem problem = domain::ReadProblem(
      Document::Load(ASSAY_SOURCE_DIR "/scenarios/post.yaml"), ASSAY_SOURCE_DIR "/models");
  return problem;
}

inline const domain::Table& SecondTable() { return Cans().workcell->tables().back(); }

// The pose of the tool on a can that the hand holds from above.
inline const Pose kFromAbove =
    geometry::PoseFromColumns({1, 0, 0}, {0, -1, 0}, {0, 0, -1}, {0, 0, 0.09});

// Returns surroundings in which the hand holds the first can, and the other can and the post stand
// at their places.
inline Surroundings CanInTheHand() {
  Surroundings surroundings{.opening = 0.06};
  for (const PartId part : {kOtherCan, kPost}) {
    surroundings.parts.push_back({part, Cans().part(part).X_WorldPart});
  }
  surroundings.held = HeldPart{kCan, kFromAbove};
  return surroundings;
}

}  // namespace assay::motion
