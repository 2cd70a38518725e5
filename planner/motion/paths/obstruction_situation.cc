#include "planner/motion/paths/obstruction_situation.h"

#include "planner/motion/collision/collision_scene.h"
#include "planner/motion/paths/straight_line.h"

namespace assay::motion {

plan::Situation SituationAt(const JointVector& q, const domain::Workcell& workcell,
                            const Surroundings& surroundings) {
  const Pose X_WorldTool = ToolAt(workcell, q);
  plan::Situation situation{.parts = surroundings.parts,
                            .hand = plan::PlacedHand{.robot = workcell.acting(),
                                                     .X_WorldTool = X_WorldTool,
                                                     .opening = surroundings.opening,
                                                     .posture = q}};
  if (surroundings.held) {
    situation.parts.push_back(
        {surroundings.held->part, X_WorldTool * surroundings.held->X_PartTool.inverse()});
  }
  return situation;
}

plan::Situation SituationOf(const Obstruction& obstruction, const CollisionScene& scene,
                            const Surroundings& surroundings) {
  plan::Situation situation = SituationAt(obstruction.at, scene.workcell(), surroundings);
  if (obstruction.kind == Obstruction::Kind::kPair) {
    const BodyPair& pair = obstruction.pair;
    situation.colliding = {scene.body(pair.second).identity, scene.body(pair.first).identity};
  }
  return situation;
}

}  // namespace assay::motion
