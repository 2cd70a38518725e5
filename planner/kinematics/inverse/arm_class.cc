#include "planner/kinematics/inverse/arm_class.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace assay::kinematics {
namespace {

// Axes that cross at a smaller angle (radians) have no clear common point.
constexpr double kLeastCrossing = 0.01;

double DistanceFrom(const JointAxis& axis, const Vector3& point) {
  return axis.direction.cross(point - axis.point).norm();
}

// Returns true if the axis i and the next two are of the kind, to within the tolerance of the
// class.
bool IsConcurrent(const SerialChain& chain, int i, ArmClass& arm) {
  const JointAxis& a = chain.axis(i);
  const JointAxis& b = chain.axis(i + 1);
  const JointAxis& c = chain.axis(i + 2);
  for (const JointAxis* outer : {&a, &c}) {
    if (outer->direction.cross(b.direction).norm() < kLeastCrossing) return false;
  }
  const Vector3 centre = (NearestPoint(b, a) + NearestPoint(b, c)) / 2;
  arm = {.kind = ArmKind::kConcurrent, .first = i, .centre = centre};
  for (const JointAxis* axis : {&a, &b, &c}) {
    arm.deviation = std::max(arm.deviation, DistanceFrom(*axis, centre));
  }
  return arm.deviation < kClassTolerance;
}

bool IsParallel(const SerialChain& chain, int i, ArmClass& arm) {
  arm = {.kind = ArmKind::kParallel, .first = i};
  for (const int outer : {i, i + 2}) {
    const Vector3 across = chain.axis(outer).direction.cross(chain.axis(i + 1).direction);
    arm.deviation = std::max(arm.deviation, across.norm());
  }
  return arm.deviation < kClassTolerance;
}

// Returns true if neither the axis i nor the next one is one of the special three.
bool IsOtherPair(const ArmClass& arm, int i) {
  return arm.kind == ArmKind::kGeneral || i + 1 < arm.first || i > arm.first + 2;
}

// Gives the axis the direction of the other, or the opposite one.
void Align(const JointAxis& other, JointAxis& axis) {
  axis.direction =
      axis.direction.dot(other.direction) > 0 ? other.direction : Vector3(-other.direction);
}

// Aligns an axis that is nearly parallel to the other, and moves an axis that nearly meets it.
void MeetOrAlign(const JointAxis& other, JointAxis& axis) {
  const double crossing = axis.direction.cross(other.direction).norm();
  if (crossing < kClassTolerance) {
    Align(other, axis);
  } else if (crossing > kLeastCrossing && DistanceBetween(axis, other) < kClassTolerance) {
    axis.point += NearestPoint(other, axis) - NearestPoint(axis, other);
  }
}

int SpecialPairs(const SerialChain& chain, const ArmClass& arm) {
  int pairs = 0;
  for (int i = 0; i < 5; ++i) {
    if (!IsOtherPair(arm, i)) continue;
    const JointAxis& a = chain.axis(i);
    const JointAxis& b = chain.axis(i + 1);
    if (AreParallel(a, b) || Meet(a, b)) ++pairs;
  }
  return pairs;
}

std::string Triple(const ArmClass& arm, const std::array<int, 6>& axes) {
  const auto at = static_cast<std::size_t>(arm.first);
  return fmt::format("axes {}, {} and {}", axes[at], axes[at + 1], axes[at + 2]);
}

}  // namespace

ArmClass ClassOf(const SerialChain& chain) {
  ArmClass best;
  for (const auto is_of_kind : {IsConcurrent, IsParallel}) {
    for (int i = 3; i >= 0; --i) {
      ArmClass arm;
      if (!is_of_kind(chain, i, arm)) continue;
      const bool is_first = best.kind == ArmKind::kGeneral;
      if (is_first || (arm.IsExact() && !best.IsExact())) best = arm;
    }
  }
  best.pairs = SpecialPairs(chain, best);
  return best;
}

SerialChain Idealized(const SerialChain& chain, const ArmClass& arm) {
  std::vector<ChainJoint> joints = chain.joints();
  const auto axis = [&](int i) -> JointAxis& { return joints[static_cast<std::size_t>(i)].axis; };
  for (int i = arm.first; i < arm.first + 3; ++i) {
    if (arm.kind == ArmKind::kConcurrent) axis(i).point = arm.centre;
    if (arm.kind == ArmKind::kParallel) Align(axis(arm.first + 1), axis(i));
  }
  for (int i = 0; i < 5; ++i) {
    if (IsOtherPair(arm, i)) MeetOrAlign(axis(i), axis(i + 1));
  }
  return SerialChain(std::move(joints), chain.X_BaseTipAtZero());
}

std::string Describe(const ArmClass& arm, const std::array<int, 6>& axes) {
  const bool is_parallel = arm.kind == ArmKind::kParallel;
  const std::string miss = arm.IsExact() ? ""
                                         : fmt::format(", to within {:.1e} {}", arm.deviation,
                                                       is_parallel ? "rad" : "m");
  if (is_parallel) {
    return fmt::format("three parallel axes: {}, as on the arms of Universal Robots{}",
                       Triple(arm, axes), miss);
  }
  if (arm.kind == ArmKind::kConcurrent) {
    const char* const names[] = {"spherical shoulder", "spherical elbow", "spherical elbow",
                                 "spherical wrist"};
    return fmt::format("{}: {} meet in one point{}", names[arm.first], Triple(arm, axes), miss);
  }
  if (arm.pairs == 0) {
    return "general: no three successive axes meet in one point or are parallel";
  }
  return fmt::format(
      "general, with {} of successive axes that meet or are parallel, but no three of them",
      arm.pairs == 1 ? "one pair" : fmt::format("{} pairs", arm.pairs));
}

bool IsHarder(const ArmClass& a, const ArmClass& b) {
  if (a.kind != b.kind) return static_cast<int>(a.kind) > static_cast<int>(b.kind);
  return a.pairs < b.pairs;
}

}  // namespace assay::kinematics
