#pragma once

#include <optional>

#include "planner/base/random.h"
#include "planner/domain/problem_file.h"
#include "planner/motion/collision_scene.h"

namespace assay::motion {

// What the tests of gross motion stand in: the scenario with the brick in the way.
inline const domain::Problem& Clutter() {
  static const domain::Problem problem = domain::ReadProblem(
      Document::Load(ASSAY_SOURCE_DIR "/scenarios/clutter.yaml"), ASSAY_SOURCE_DIR "/models");
  return problem;
}

inline Surroundings PartsAtTheStart(double opening = 0.05) {
  Surroundings surroundings{.opening = opening};
  for (int i = 0; i < static_cast<int>(Clutter().parts.size()); ++i) {
    surroundings.parts.push_back({PartId(i), Clutter().part(PartId(i)).X_WorldPart});
  }
  return surroundings;
}

// The peg in the hand, by its first grasp; the other parts stand.
inline Surroundings PegInTheHand() {
  Surroundings surroundings = PartsAtTheStart();
  const PartId peg(1);
  std::erase_if(surroundings.parts, [&](const auto& placed) { return placed.part == peg; });
  const domain::Grasp& grasp = Clutter().part(peg).grasps->front();
  surroundings.held = HeldPart{peg, grasp.X_PartTool};
  surroundings.opening = grasp.width;
  return surroundings;
}

inline JointVector RandomPosture(const kinematics::Arm& arm, RandomStream& random) {
  JointVector q;
  for (int j = 0; j < 6; ++j) q[j] = random.Uniform(arm.limits()[j].lower, arm.limits()[j].upper);
  return q;
}

}  // namespace assay::motion
