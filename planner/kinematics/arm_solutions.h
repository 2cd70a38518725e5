#pragma once

#include <array>
#include <cstddef>

#include "planner/geometry/coordinates.h"

namespace assay::kinematics {

using JointVector = Eigen::Matrix<double, 6, 1>;  // radians, joint 1 first

// The actual or desired positions and velocities of the joints.
struct JointState {
  JointVector q = JointVector::Zero();   // rad
  JointVector qd = JointVector::Zero();  // rad/s
};

// The indicators that distinguish the solutions of most arms (Lee and Ziegler 1983). Each is the
// sign of a factor of the Jacobian's determinant, so it changes only at singular postures. The
// solver of an arm says what its factors are (lee_ziegler.h, branched_chain.h).
enum class Shoulder { kRight, kLeft };
enum class Elbow { kAbove, kBelow };
enum class Wrist { kNoFlip, kFlip };

// The configuration of an arm.
struct Indicators {
  Shoulder shoulder = Shoulder::kRight;
  Elbow elbow = Elbow::kAbove;
  Wrist wrist = Wrist::kNoFlip;

  bool operator==(const Indicators&) const = default;
};

struct InverseSolution {
  JointVector q;  // each in [-pi, pi]; joint limits are not tested
  Indicators indicators;
};

// No arm with six revolute joints has more solutions (Primrose 1986).
inline constexpr std::size_t kMostSolutions = 16;

// A list of solutions that needs no memory allocation.
class InverseSolutions {
 public:
  const InverseSolution* begin() const { return solutions_.data(); }
  const InverseSolution* end() const { return solutions_.data() + size_; }
  const InverseSolution& operator[](std::size_t i) const { return solutions_[i]; }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }

  // Adds a solution and returns it. It may be called at most kMostSolutions times.
  InverseSolution& Append() { return solutions_[size_++]; }

 private:
  std::array<InverseSolution, kMostSolutions> solutions_;
  std::size_t size_ = 0;
};

// Rows 1 to 3 are velocities (metres) of a point that is fixed to the flange, rows 4 to 6 are the
// axes of the joints, both per rate of each joint and in the base frame.
using ArmJacobian = Eigen::Matrix<double, 6, 6>;

}  // namespace assay::kinematics
