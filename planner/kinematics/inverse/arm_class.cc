#include "planner/kinematics/inverse/arm_class.h"

#include <fmt/format.h>

namespace assay::kinematics {
namespace {

bool Meet(const JointAxis& a, const JointAxis& b) {
  return DistanceBetween(a, b) < kFileTolerance && !AreParallel(a, b);
}

// Returns the point of a that is nearest to b. The axes must not be parallel.
Vector3 NearestPoint(const JointAxis& a, const JointAxis& b) {
  const Vector3 normal = a.direction.cross(b.direction);
  const double along = (b.point - a.point).cross(b.direction).dot(normal) / normal.squaredNorm();
  return a.point + along * a.direction;
}

bool FindCentre(const JointAxis& a, const JointAxis& b, const JointAxis& c, Vector3& centre) {
  if (!Meet(a, b) || !Meet(b, c)) return false;
  centre = NearestPoint(b, a);
  return (NearestPoint(b, c) - centre).norm() < kFileTolerance;
}

int SpecialPairs(const SerialChain& chain, const ArmClass& arm) {
  int pairs = 0;
  for (int i = 0; i < 5; ++i) {
    const bool other = arm.kind == ArmKind::kGeneral || i + 1 < arm.first || i > arm.first + 2;
    if (!other) continue;
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
  ArmClass arm;
  for (int i = 3; i >= 0; --i) {
    const JointAxis& a = chain.axis(i);
    const JointAxis& b = chain.axis(i + 1);
    const JointAxis& c = chain.axis(i + 2);
    Vector3 centre;
    if (arm.kind != ArmKind::kConcurrent && FindCentre(a, b, c, centre)) {
      arm = {.kind = ArmKind::kConcurrent, .first = i, .centre = centre};
    } else if (arm.kind == ArmKind::kGeneral && AreParallel(a, b) && AreParallel(b, c)) {
      arm = {.kind = ArmKind::kParallel, .first = i};
    }
  }
  arm.pairs = SpecialPairs(chain, arm);
  return arm;
}

std::string Describe(const ArmClass& arm, const std::array<int, 6>& axes) {
  if (arm.kind == ArmKind::kParallel) {
    return fmt::format("three parallel axes: {}, as on the arms of Universal Robots",
                       Triple(arm, axes));
  }
  if (arm.kind == ArmKind::kConcurrent) {
    const char* const names[] = {"spherical shoulder", "spherical elbow", "spherical elbow",
                                 "spherical wrist"};
    return fmt::format("{}: {} meet in one point", names[arm.first], Triple(arm, axes));
  }
  return arm.pairs == 0
             ? std::string("general: no three successive axes meet in one point or are parallel")
             : fmt::format(
                   "general, with {} of successive axes that meet or are parallel, but no "
                   "three of them",
                   arm.pairs == 1 ? "one pair" : fmt::format("{} pairs", arm.pairs));
}

bool IsHarder(const ArmClass& a, const ArmClass& b) {
  if (a.kind != b.kind) return static_cast<int>(a.kind) > static_cast<int>(b.kind);
  return a.pairs < b.pairs;
}

}  // namespace assay::kinematics
