#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "planner/base/random.h"
#include "planner/domain/problem/problem_file.h"
#include "planner/motion/collision/motion_check.h"

namespace assay::motion {

// Returns the scenario with the brick in the way, in which the tests of gross motion take place.
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

// Returns surroundings with the peg in the hand, in its first grasp. The other parts are at their
// places.
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

// Returns whether every pair of bodies keeps the clearance at one posture. The arm's own links and
// the hand keep the lower clearance of a robot's own bodies.
inline bool IsClear(const CollisionScene& scene, const JointVector& q, double clearance) {
  const LinkPoses X_BaseLink = scene.arm().LinkPoses(q);
  return std::ranges::all_of(scene.pairs(), [&](const BodyPair& pair) {
    const bool is_own = scene.IsOfRobot(pair.first) && scene.IsOfRobot(pair.second);
    const double needed = is_own ? std::min(kOwnClearance, clearance) : clearance;
    return scene.Separation(pair, X_BaseLink, needed) >= needed;
  });
}

// Returns a posture at rest with the tool above the table, so low that parts can be in the way.
inline JointVector RandomPostureAtTheTable(const CollisionScene& scene, double clearance,
                                           RandomStream& random) {
  const domain::Workcell& workcell = scene.workcell();
  while (true) {
    const JointVector q = RandomPosture(scene.arm(), random);
    const Vector3 tool = workcell.X_WorldBase() * scene.arm().Forward(q) *
                         workcell.gripper().X_FlangeTool().translation();
    const bool near = tool.x() > 0.3 && tool.x() < 1.05 && std::abs(tool.y()) < 0.6 &&
                      tool.z() > 0 && tool.z() < 0.35;
    if (near && IsClear(scene, q, clearance)) return q;
  }
}

}  // namespace assay::motion
