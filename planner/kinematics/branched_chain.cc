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

// Changes the velocities of a Jacobian to those of the point at this vector from its point.
void TakeVelocitiesAt(const Vector3& offset, ArmJacobian& J) {
  for (int k = 0; k < 6; ++k) J.col(k).head<3>() += J.col(k).tail<3>().cross(offset);
}

bool MeetInOnePoint(const JointAxis& a, const JointAxis& b, const JointAxis& c) {
  return Meet(a, b) && Meet(b, c) &&
         (NearestPoint(b, a) - NearestPoint(b, c)).norm() < kFileTolerance;
}

}  // namespace

BranchedChain::BranchedChain(SerialChain chain) : inverse_(std::move(chain)) {
  const SerialChain& axes = inverse_.chain();
  const ArmClass& arm = inverse_.arm_class();
  if (arm.kind == ArmKind::kConcurrent && arm.first == 3 && arm.IsExact()) {
    has_spherical_wrist_ = true;
    p_FlangeCenter_ = axes.X_BaseTipAtZero().inverse() * arm.centre;
  }
  factors_ = FactorsOf(axes, false);
  if (!factors_) factors_ = FactorsOf(axes, true);
}

std::optional<BranchedChain::Factors> BranchedChain::FactorsOf(const SerialChain& chain,
                                                               bool from_flange) {
  const auto axis = [&](int k) { return chain.axis(from_flange ? 5 - k : k); };
  const bool is_spherical = MeetInOnePoint(axis(3), axis(4), axis(5));
  const bool is_planar = AreParallel(axis(1), axis(2));
  if (!is_spherical && !(is_planar && AreParallel(axis(2), axis(3)) && Meet(axis(4), axis(5)))) {
    return std::nullopt;
  }
  if (!is_planar && !Meet(axis(0), axis(1))) return std::nullopt;
  const Pose X_FlangeBase = chain.X_BaseTipAtZero().inverse();
  const Vector3 last = NearestPoint(axis(5), axis(4));
  Factors factors{.from_flange = from_flange,
                  .is_spherical = is_spherical,
                  .c = from_flange ? last : X_FlangeBase * last};
  if (!is_planar) {
    const Vector3 first = NearestPoint(axis(0), axis(1));
    factors.o = from_flange ? X_FlangeBase * first : first;
  }
  return factors;
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
  Pose X_BaseFlange;
  ArmJacobian J = inverse_.chain().Jacobian(q, &X_BaseFlange);
  if (!factors_) return {.wrist = wrist(J.determinant())};
  const bool from_flange = factors_->from_flange;
  const Vector3 c = from_flange ? factors_->c : X_BaseFlange * factors_->c;
  TakeVelocitiesAt(c - X_BaseFlange.translation(), J);
  const auto joint = [&](int k) { return from_flange ? 5 - k : k; };
  const auto velocity = [&](int k) { return Vector3(J.col(joint(k)).head<3>()); };
  const auto axis = [&](int k) { return Vector3(J.col(joint(k)).tail<3>()); };
  const Vector3 n = axis(1);
  // Axis 4 does not move the point if the last three axes meet.
  const Vector3 lever = velocity(3);
  const double shoulder = velocity(0).dot(n);
  double elbow = (velocity(1) - lever).cross(velocity(2) - lever).dot(n);
  if (factors_->o) {
    const Vector3 o = from_flange ? X_BaseFlange * *factors_->o : *factors_->o;
    elbow = -velocity(2).dot(c - o);
  }
  const Vector3 first = factors_->is_spherical ? axis(3) : n;
  return {shoulder <= 0 ? Shoulder::kRight : Shoulder::kLeft,
          (shoulder <= 0) == (elbow <= 0) ? Elbow::kAbove : Elbow::kBelow,
          wrist(first.cross(axis(4)).dot(axis(5)))};
}

ArmJacobian BranchedChain::JacobianAt(const JointVector& q) const {
  Pose X_BaseFlange;
  ArmJacobian J = inverse_.chain().Jacobian(q, &X_BaseFlange);
  TakeVelocitiesAt(X_BaseFlange.linear() * p_FlangeCenter_, J);
  if (has_spherical_wrist_) J.topRightCorner<3, 3>().setZero();  // but for rounding
  return J;
}

}  // namespace assay::kinematics
