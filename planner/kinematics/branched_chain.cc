#include "planner/kinematics/branched_chain.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace assay::kinematics {
namespace {

// Returns the greatest difference between two joint vectors, without whole turns.
double TurnsApart(const JointVector& a, const JointVector& b) {
  double greatest = 0;
  for (int i = 0; i < 6; ++i) {
    greatest = std::max(greatest, std::abs(std::remainder(a[i] - b[i], 2 * M_PI)));
  }
  return greatest;
}

}  // namespace

BranchedChain::BranchedChain(SerialChain chain) : inverse_(std::move(chain)) {
  const SerialChain& axes = inverse_.chain();
  const ArmClass& arm = inverse_.arm_class();
  const Pose X_FlangeBase = axes.X_BaseTipAtZero().inverse();
  const bool is_planar = AreParallel(axes.axis(1), axes.axis(2));
  if (arm.kind == ArmKind::kConcurrent && arm.first == 3 && arm.IsExact()) {
    has_spherical_wrist_ = true;
    has_factors_ = is_planar;
    p_FlangeLast_ = p_FlangeCenter_ = X_FlangeBase * arm.centre;
  } else if (is_planar && AreParallel(axes.axis(2), axes.axis(3)) &&
             Meet(axes.axis(4), axes.axis(5))) {
    has_factors_ = true;
    p_FlangeLast_ = X_FlangeBase * NearestPoint(axes.axis(5), axes.axis(4));
  }
}

InverseSolutions BranchedChain::Inverse(const Pose& X_BaseFlange,
                                        const JointVector& reference) const {
  InverseSolutions solutions;
  for (const SixAngles& q : inverse_.Solve(X_BaseFlange, reference)) {
    if (solutions.size() == kMostSolutions) break;
    solutions.Append() = {q, IndicatorsOf(q)};
  }
  return solutions;
}

std::optional<JointVector> BranchedChain::Inverse(const Pose& X_BaseFlange,
                                                  const Indicators& indicators,
                                                  const JointVector& reference) const {
  std::optional<JointVector> nearest;
  double least = std::numeric_limits<double>::infinity();
  for (const SixAngles& q : inverse_.Solve(X_BaseFlange, reference)) {
    const double apart = TurnsApart(q, reference);
    if (apart >= least || IndicatorsOf(q) != indicators) continue;
    least = apart;
    nearest = q;
  }
  return nearest;
}

Indicators BranchedChain::IndicatorsOf(const JointVector& q) const {
  // The signs are those of Lee and Ziegler's indicators for an arm that satisfies their convention.
  const auto wrist = [](double factor) { return factor <= 0 ? Wrist::kNoFlip : Wrist::kFlip; };
  if (!has_factors_) return {.wrist = wrist(JacobianAt(q).determinant())};
  const ArmJacobian J = JacobianAbout(p_FlangeLast_, q);
  const auto velocity = [&](int k) { return Vector3(J.col(k).head<3>()); };
  const auto axis = [&](int k) { return Vector3(J.col(k).tail<3>()); };
  const Vector3 n = axis(1);
  // Axis 4 does not move the point if the wrist is spherical.
  const Vector3 lever = velocity(3);
  const double shoulder = velocity(0).dot(n);
  const double elbow = (velocity(1) - lever).cross(velocity(2) - lever).dot(n);
  const Vector3 first = has_spherical_wrist_ ? axis(3) : n;
  return {shoulder <= 0 ? Shoulder::kRight : Shoulder::kLeft,
          (shoulder <= 0) == (elbow <= 0) ? Elbow::kAbove : Elbow::kBelow,
          wrist(first.cross(axis(4)).dot(axis(5)))};
}

ArmJacobian BranchedChain::JacobianAt(const JointVector& q) const {
  ArmJacobian J = JacobianAbout(p_FlangeCenter_, q);
  if (has_spherical_wrist_) J.topRightCorner<3, 3>().setZero();  // but for rounding
  return J;
}

ArmJacobian BranchedChain::JacobianAbout(const Vector3& p_Flange, const JointVector& q) const {
  Pose X_BaseFlange;
  ArmJacobian J = inverse_.chain().Jacobian(q, &X_BaseFlange);
  const Vector3 offset = X_BaseFlange.linear() * p_Flange;
  for (int k = 0; k < 6; ++k) {
    J.col(k).head<3>() += J.col(k).tail<3>().cross(offset);
  }
  return J;
}

}  // namespace assay::kinematics
