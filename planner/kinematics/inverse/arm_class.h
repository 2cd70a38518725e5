#pragma once

#include <string>

#include "planner/kinematics/inverse/serial_chain.h"

namespace assay::kinematics {

// An arm belongs to a class even if its axes miss the common point or the common direction by up to
// this amount (metres, radians). Files round pi / 2 to 1.5708, and calibrated arms differ from
// their drawings.
inline constexpr double kClassTolerance = 1e-3;

// The kinds of arms with six axes, by how their inverse kinematics is solved. The kinds that are
// solved most easily come first.
enum class ArmKind {
  kConcurrent,  // three successive axes meet in one point: closed form
  kParallel,    // three successive axes are parallel: closed form
  kGeneral,     // neither: search for the values of one joint
};

struct ArmClass {
  ArmKind kind = ArmKind::kGeneral;
  int first = 0;                     // the first of the three axes, counted from 0
  Vector3 centre = Vector3::Zero();  // the point in which concurrent axes meet
  // How far the axes are away from the centre (metres), or from the direction of the middle one
  // (radians).
  double deviation = 0;
  int pairs = 0;  // successive axes of the other joints that meet or are parallel

  // Returns true if the closed form holds for the axes as they lie.
  bool IsExact() const { return deviation < kFileTolerance; }
};

// Returns the class of a chain with six joints. If several classes apply, exact ones are preferred
// to others, concurrent axes to parallel ones, and later axes to earlier ones, because most arms
// have a spherical wrist.
ArmClass ClassOf(const SerialChain& chain);

// Returns the chain with its three axes moved to the common point, or turned to the common
// direction. Other successive axes that nearly meet or are nearly parallel are made to do so, too,
// because the closed form is imprecise beside these cases.
SerialChain Idealized(const SerialChain& chain, const ArmClass& arm);

// Returns words for people, for example "spherical wrist: axes 4, 5 and 6 meet in one point".
// `axes` has the numbers of the six axes, counted from 1.
std::string Describe(const ArmClass& arm, const std::array<int, 6>& axes = {1, 2, 3, 4, 5, 6});

// Returns true if the solutions of a are harder to find than those of b.
bool IsHarder(const ArmClass& a, const ArmClass& b);

}  // namespace assay::kinematics
