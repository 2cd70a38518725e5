#pragma once

#include "planner/kinematics/inverse/bounded_list.h"
#include "planner/kinematics/inverse/joint_axis.h"

namespace assay::kinematics {

// The subproblems of Paden and Kahan, and of Elias and Wen (IK-Geo, 2022), into which the inverse
// kinematics of an arm is decomposed. R(k, q) is the turn about the unit vector k by q radians.
// Angles are in [-pi, pi]. Vectors that are compared with lengths have the same units.

// The angles of a solution.
template <std::size_t N>
struct SubproblemAngles {
  std::array<double, N> q = {};
  // False if no angles satisfy the equation, and these have the least error.
  bool exact = true;
  // True if a continuum of angles satisfies the equation. Then the first free angle is that of the
  // reference, and the others follow.
  bool free = false;
};

// The greatest error of an exact solution, in the units of the vectors.
inline constexpr double kExactError = 1e-9;

// Subproblem 1: R(k, q) p1 = p2.
SubproblemAngles<1> TurnToVector(const Vector3& k, const Vector3& p1, const Vector3& p2,
                                 double reference = 0);

// Subproblem 2: R(k1, q1) p1 = R(k2, q2) p2.
BoundedList<SubproblemAngles<2>, 2> TurnTogether(const Vector3& k1, const Vector3& p1,
                                                 const Vector3& k2, const Vector3& p2,
                                                 const std::array<double, 2>& reference = {});

// Subproblem 3: |R(k, q) p1 - p2| = distance.
BoundedList<SubproblemAngles<1>, 2> TurnToDistance(const Vector3& k, const Vector3& p1,
                                                   const Vector3& p2, double distance,
                                                   double reference = 0);

// Subproblem 4: h . R(k, q) p = height.
BoundedList<SubproblemAngles<1>, 2> TurnToHeight(const Vector3& k, const Vector3& p,
                                                 const Vector3& h, double height,
                                                 double reference = 0);

// Subproblem 5: Turn(axes[0], q1) Turn(axes[1], q2) Turn(axes[2], q3) from = to. Angles that are
// not exact are given only where a double solution is nearly reached.
BoundedList<SubproblemAngles<3>, 4> TurnToPoint(const std::array<JointAxis, 3>& axes,
                                                const Vector3& from, const Vector3& to,
                                                const std::array<double, 3>& reference = {});

// One equation of subproblem 6: cosine1 cos(q1) + sine1 sin(q1) + cosine2 cos(q2) + sine2 sin(q2) =
// value.
struct TwoAngleEquation {
  double cosine1 = 0;
  double sine1 = 0;
  double cosine2 = 0;
  double sine2 = 0;
  double value = 0;
};

// Subproblem 6: two such equations. Angles that are not exact are given only where a double
// solution is nearly reached.
BoundedList<SubproblemAngles<2>, 4> SolveTwoAngles(const std::array<TwoAngleEquation, 2>& equations,
                                                   const std::array<double, 2>& reference = {});

// Solves cosine cos(q) + sine sin(q) = value.
BoundedList<SubproblemAngles<1>, 2> SolveOneAngle(double cosine, double sine, double value,
                                                  double reference = 0);

}  // namespace assay::kinematics
