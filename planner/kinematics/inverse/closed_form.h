#pragma once

#include "planner/kinematics/inverse/arm_class.h"
#include "planner/kinematics/inverse/bounded_list.h"

namespace assay::kinematics {

using SixAngles = Eigen::Matrix<double, 6, 1>;  // radians, joint 1 first
using SixAxes = std::array<JointAxis, 6>;       // of joints 1 to 6 at zero, in the base frame
// Three axes have up to four solutions for a point, and the other three have up to two for each.
using ClosedFormSolutions = BoundedList<SixAngles, 8>;

// Returns all joint values for which the product of the six turns is `motion`, up to rounding and
// up to vectors that do not solve the equations exactly. The caller tests them. Three axes meet in
// arm.centre (SolveConcurrent) or are parallel (SolveParallel).
//
// The product is read as a cycle. The other three joints are taken in its order: first the joints
// behind the special three, and then the joints before them, whose axes are transformed by the
// inverse of `motion`. One formula then serves special axes at any place of the chain.
ClosedFormSolutions SolveConcurrent(const SixAxes& axes, const ArmClass& arm, const Pose& motion,
                                    const SixAngles& reference);
ClosedFormSolutions SolveParallel(const SixAxes& axes, const ArmClass& arm, const Pose& motion,
                                  const SixAngles& reference);

}  // namespace assay::kinematics
