#include "planner/uncertainty/release.h"

#include <fmt/format.h>

#include <cmath>

#include "planner/algebra/simplify.h"
#include "planner/domain/part_model.h"
#include "planner/uncertainty/axis_angle.h"

namespace assay::uncertainty {
namespace {

Interval PlusMinus(double half_width) { return {-half_width, half_width}; }

Expression SameOrOppositeSense(const Vector3& up, const Expression& theta) {
  return up.z() < 0 ? -theta : theta;
}

// Adds what a leaning tool does to the part when the table sets it upright.
void SetUpright(UncertainWorld& world, PartId part, const Vector3& up, const ManipulatorError& draw,
                RestingError& error) {
  const double hand = Magnitude(world.RangeOf(draw.theta));
  const double twist = Magnitude(world.RangeOf(world.held().twist));
  const std::string name = world.SymbolName(part);
  error.theta = world.Declare(fmt::format("theta_{}", name),
                              PlusMinus(TwistOf(hand, up.z()) + TwistOf(twist, up.y())), part);
  const double tilt = SwingOf(hand, up.z()) + SwingOf(twist, up.y());
  const Interval settled = PlusMinus(world.problem().part(part).model->shape().radius() * tilt);
  for (int axis : {0, 1}) {
    error.displacement[axis] =
        error.displacement[axis] + world.Declare(fmt::format("settle_{}", name), settled, part);
  }
}

}  // namespace

RestingError Release(UncertainWorld& world, PartId part, const plan::Hold& hold,
                     const Transform& X_ToolGrasp, const ManipulatorError& draw,
                     const Pose& X_WorldPart) {
  const Pose X_WorldTool = X_WorldPart * hold.X_PartTool;
  const Transform released = PossibleHeldPose(X_WorldTool, X_ToolGrasp, hold.X_PartTool);
  RestingError error;
  error.displacement =
      algebra::Simplify(released.translation - AsTransform(X_WorldPart).translation);
  const Vector3 up = VerticalInTool(X_WorldTool);
  error.theta = SameOrOppositeSense(up, draw.theta);
  const bool stays_upright = std::abs(up.z()) == 1 && world.held().twist.IsConstant(0);
  if (world.propagation() == Propagation::kSound && !stays_upright) {
    SetUpright(world, part, up, draw, error);
  }
  return error;
}

}  // namespace assay::uncertainty
