#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <vector>

#include "planner/geometry/coordinates.h"
#include "planner/kinematics/arm_geometry.h"
#include "planner/kinematics/urdf_model.h"

namespace assay::kinematics {

using JointVector = Eigen::Matrix<double, 6, 1>;  // radians, joint 1 first

// The actual or desired positions and velocities of the joints.
struct JointState {
  JointVector q = JointVector::Zero();   // rad
  JointVector qd = JointVector::Zero();  // rad/s
};

// The indicators that distinguish the up to eight solutions (Lee and Ziegler 1983). Their
// convention of joint values is used throughout.
enum class Shoulder { kRight, kLeft };  // ARM = +1, -1: the wrist is behind or before axis 1
enum class Elbow { kAbove, kBelow };    // ELBOW = +1, -1
// The paper's FLIP toggle as a property of the joint values: sin(q5) >= 0 (kNoFlip) or < 0 (kFlip).
// The paper's indicator WRIST is different: it compares the hand with axis 5, and depends on how
// the hand is mounted.
enum class Wrist { kNoFlip, kFlip };

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

// A list of at most eight solutions that needs no memory allocation.
class InverseSolutions {
 public:
  const InverseSolution* begin() const { return solutions_.data(); }
  const InverseSolution* end() const { return solutions_.data() + size_; }
  const InverseSolution& operator[](std::size_t i) const { return solutions_[i]; }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }

  // Adds a solution and returns it. It may be called at most eight times.
  InverseSolution& Append() { return solutions_[size_++]; }

 private:
  std::array<InverseSolution, 8> solutions_;
  std::size_t size_ = 0;
};

// The Jacobian about the wrist centre, in the base frame. The last three joints do not move this
// point.
struct WristJacobian {
  Matrix3 center;    // velocities of the centre per rate of the first three joints, metres
  Matrix3 shoulder;  // the axes of the first three joints
  Matrix3 wrist;     // the axes of the last three joints
};

// A six-axis arm with parallel shoulder and elbow axes and a spherical wrist, like the Puma robots.
class Arm {
 public:
  // Reads an arm from a URDF file. Throws InputError if the file is not URDF, or if the arm does
  // not satisfy Lee and Ziegler's convention (arm_geometry.h).
  static Arm FromUrdf(const std::filesystem::path& file);

  const RobotModel& model() const { return model_; }
  const ArmGeometry& geometry() const { return geometry_; }
  const std::array<JointLimits, 6>& limits() const { return limits_; }

  // Returns X_BaseFlange, the pose of the flange in the base.
  Pose Forward(const JointVector& q) const;

  // Returns the poses of all seven links in the base, in the order of model().links: the base is
  // first, the flange is last.
  std::array<Pose, 7> LinkPoses(const JointVector& q) const;

  WristJacobian JacobianAt(const JointVector& q) const;

  // Returns all joint vectors that put the flange at X_BaseFlange, without regard to joint limits.
  // There are eight inside the reach and none outside. Singular poses are special:
  // - Shoulder (the wrist centre is at its least distance from axis 1): the two shoulder solutions
  //   coincide and are given once, as kRight. Without an offset d2, q1 is free and is taken from
  //   `reference`.
  // - Elbow (the arm is stretched or folded): the two elbow solutions coincide and are given once.
  // - Wrist (axes 4 and 6 are in line): q4 is free. kNoFlip takes q4 of `reference`, and kFlip
  //   takes that plus pi. q6 follows from the pose.
  // - Wrist centre on axis 2 (only if the upper arm is as long as the forearm): q2 is free and is
  //   taken from `reference`.
  // A pose counts as singular if the quantity that vanishes at such poses (a distance in metres, or
  // the sine of q5) is below 1e-10. Every solution therefore reproduces the pose to better than
  // 1e-9. Solutions that coincide only up to rounding are all given.
  InverseSolutions Inverse(const Pose& X_BaseFlange,
                           const JointVector& reference = JointVector::Zero()) const;
  // Returns the solution with the given indicators, or nothing if there is none. This takes less
  // work than computing all solutions.
  std::optional<JointVector> Inverse(const Pose& X_BaseFlange, const Indicators& indicators,
                                     const JointVector& reference) const;

  // Returns the indicators of q: ARM = sign(-(d4 s23 + a3 c23 + a2 c2)) and ELBOW = ARM sign(d4 c3
  // - a3 s3), where sign(0) = +1.
  Indicators IndicatorsOf(const JointVector& q) const;

  // Returns true if every joint is within its limits, or beyond them by no more than rounding (1e-9
  // rad).
  bool InRange(const JointVector& q) const;

  // Considers the joint vectors that differ from q by whole turns and are within the limits.
  // Returns the one in which every joint is nearest to the reference, or nothing if there is none.
  std::optional<JointVector> NearestInRange(const JointVector& q,
                                            const JointVector& reference) const;

  // Returns all joint vectors that differ from q by whole turns and are within the limits, in
  // lexicographic order.
  std::vector<JointVector> Representatives(const JointVector& q) const;

 private:
  Arm(RobotModel model, const ArmGeometry& geometry);

  RobotModel model_;
  ArmGeometry geometry_;
  std::array<JointLimits, 6> limits_;
};

// Returns the joint vector that differs from q by whole turns and is nearest to the reference in
// every joint. Joint limits are ignored.
JointVector NearestByTurns(const JointVector& q, const JointVector& reference);

}  // namespace assay::kinematics
