#pragma once

#include <string>

#include "planner/kinematics/inverse/serial_chain.h"

namespace assay::kinematics {

// What the geometry of six axes says about the solutions of the inverse kinematics, the easiest
// first. Axes meet or
// are parallel if they do so to within 1e-9 m and 1e-9 rad (kFileTolerance).
enum class ArmKind {
  kConcurrent,  // three successive axes meet in one point: closed form
  kParallel,    // three successive axes are parallel: closed form
  kGeneral,     // neither: search for the values of one joint
};

struct ArmClass {
  ArmKind kind = ArmKind::kGeneral;
  int first = 0;                     // the first of the three axes, counted from 0
  Vector3 centre = Vector3::Zero();  // the point in which concurrent axes meet
  int pairs = 0;  // successive axes of the other joints that meet or are parallel
};

// Returns the class of a chain with six joints. If several classes apply, concurrent axes are
// preferred to parallel ones, and later axes to earlier ones, because most arms have a spherical
// wrist.
ArmClass ClassOf(const SerialChain& chain);

// Returns words for people, for example "spherical wrist: axes 4, 5 and 6 meet in one point".
// `axes` has the numbers of the six axes, counted from 1.
std::string Describe(const ArmClass& arm, const std::array<int, 6>& axes = {1, 2, 3, 4, 5, 6});

// Returns true if the solutions of a are harder to find than those of b.
bool IsHarder(const ArmClass& a, const ArmClass& b);

}  // namespace assay::kinematics
