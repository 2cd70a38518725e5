#include "planner/uncertainty/error_sets/tool_error_box.h"

namespace assay::uncertainty {

plan::ToolErrorBox ToolErrorBoxAt(const UncertainWorld& world, PartId guide,
                                  const Pose& X_WorldTool) {
  const domain::PoseError& hand = world.problem().gripper_error;
  const Vector3 errs(Magnitude(hand.x), Magnitude(hand.y), Magnitude(hand.z));
  const BelievedShift believed =
      guide.IsNone() ? BelievedShift{} : world.ShiftAt(guide, X_WorldTool.translation());
  const double turn = Magnitude(world.RangeOf(believed.turn));
  plan::ToolErrorBox doubt{.turn = turn, .spin = Magnitude(hand.theta)};
  for (int axis = 0; axis < 3; ++axis) {
    doubt.shift[axis] = Magnitude(world.RangeOf(believed.displacement[axis]));
  }
  // The hand errs along its own axes, which are turned with the believed pose.
  doubt.shift += X_WorldTool.linear().cwiseAbs() * errs;
  doubt.shift.head<2>().array() += turn * errs.norm();
  return doubt;
}

}  // namespace assay::uncertainty
