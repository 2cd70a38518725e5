#include "planner/uncertainty/error_sets/uncertain_pose.h"

#include <cmath>

namespace assay::uncertainty {
namespace {

constexpr double kRightAngleRounding = 1e-15;

double WithoutRounding(double entry) {
  for (const double exact : {0.0, 1.0, -1.0}) {
    if (std::abs(entry - exact) <= kRightAngleRounding) return exact;
  }
  return entry;
}

}  // namespace

SymbolicVector AsVector(const Vector3& p) {
  return {WithoutRounding(p.x()), WithoutRounding(p.y()), WithoutRounding(p.z())};
}

Transform ManipulatorError::AsTransform() const {
  return algebra::Translation({x, y, z}) * algebra::RotationZ(theta);
}

Transform AsTransform(const Pose& pose) {
  Transform transform = algebra::Translation(AsVector(pose.translation()));
  for (int row = 0; row < 3; ++row) {
    transform.rotation[row] = AsVector(pose.linear().row(row));
  }
  return transform;
}

Transform PossiblePose(const Pose& X_WorldPart, const RestingError& error) {
  Pose R_O = X_WorldPart;
  R_O.translation().setZero();
  return algebra::Translation(error.displacement) *
         algebra::Translation(AsVector(X_WorldPart.translation())) *
         algebra::RotationZ(error.theta) * AsTransform(R_O);
}

Transform PossibleGrasp(const HeldError& error, const ManipulatorError& draw,
                        Propagation propagation) {
  const Transform offset = algebra::Translation({error.x, error.y, error.z});
  if (propagation == Propagation::kPaper) return offset * draw.AsTransform();
  return draw.AsTransform() * offset * algebra::RotationZ(error.skew) *
         algebra::RotationX(error.tip) * algebra::RotationY(error.twist);
}

Transform PossibleHeldPose(const Pose& X_WorldTool, const Transform& X_ToolGrasp,
                           const Pose& X_PartTool) {
  return AsTransform(X_WorldTool) * X_ToolGrasp * AsTransform(X_PartTool.inverse());
}

}  // namespace assay::uncertainty
