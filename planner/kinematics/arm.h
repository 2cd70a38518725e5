#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <vector>

#include "planner/geometry/pose.h"
#include "planner/kinematics/urdf_model.h"

namespace assay::kinematics {

using JointVector = Eigen::Matrix<double, 6, 1>;  // radians, joint 1 first

// Where the joints are, or are to be, and how fast.
struct JointState {
  JointVector q = JointVector::Zero();   // rad
  JointVector qd = JointVector::Zero();  // rad/s
};

// The indicators that name the up to eight solutions (Lee and Ziegler 1983, whose convention of
// joint values is used throughout).
enum class Shoulder { kRight, kLeft };  // ARM = +1, -1: the wrist behind or before axis 1
enum class Elbow { kAbove, kBelow };    // ELBOW = +1, -1
// The paper's FLIP toggle, as a property of the joint values: sin(q5) >= 0, or < 0. (The paper's
// WRIST compares the hand with axis 5 instead, and depends on the mounting of the hand.)
enum class Wrist { kNoFlip, kFlip };

struct Indicators {
  Shoulder shoulder = Shoulder::kRight;
  Elbow elbow = Elbow::kAbove;
  Wrist wrist = Wrist::kNoFlip;

  bool operator==(const Indicators&) const = default;
};

struct InverseSolution {
  JointVector q;  // each in [-pi, pi]; limits are not looked at
  Indicators indicators;
};

// At most eight solutions, in place.
class InverseSolutions {
 public:
  const InverseSolution* begin() const { return solutions_.data(); }
  const InverseSolution* end() const { return solutions_.data() + size_; }
  const InverseSolution& operator[](std::size_t i) const { return solutions_[i]; }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }

  // A place for one more; at most eight times.
  InverseSolution& Append() { return solutions_[size_++]; }

 private:
  std::array<InverseSolution, 8> solutions_;
  std::size_t size_ = 0;
};

// Lengths of the Denavit-Hartenberg table alpha = (-90, 0, 90, -90, 90, 0) degrees,
// a = (0, a2, a3, 0, 0, 0), d = (0, d2, 0, d4, 0, d6), in metres.
struct ArmGeometry {
  double a2 = 0;  // shoulder axis to elbow axis, > 0
  double a3 = 0;  // elbow axis to the line of axis 4
  double d2 = 0;  // offset of the arm's plane from axis 1
  double d4 = 0;  // elbow to wrist centre, > 0
  double d6 = 0;  // wrist centre to flange
};

// The Jacobian about the wrist's center, which the last three joints leave where it is; in the
// base's frame.
struct WristJacobian {
  Matrix3 center;    // its velocities by the rates of the first three joints, metres
  Matrix3 shoulder;  // the axes of these
  Matrix3 wrist;     // and of the last three
};

// A six-axis arm with parallel shoulder and elbow axes and a spherical wrist, like the Pumas.
class Arm {
 public:
  // Throws InputError if the file is not URDF, or not an arm of this kind in Lee and Ziegler's
  // convention: at joint values 0, axes 1, 4, 6 point along the root's z, axes 2, 3, 5 along its
  // y, axes 1 and 2 meet in the root's origin, axes 4, 5, 6 in one point, and the last link's
  // frame, the flange, has the root's orientation and its origin on axis 6.
  static Arm FromUrdf(const std::filesystem::path& file);

  const RobotModel& model() const { return model_; }
  const ArmGeometry& geometry() const { return geometry_; }
  const std::array<JointLimits, 6>& limits() const { return limits_; }

  // X_BaseFlange.
  Pose Forward(const JointVector& q) const;

  // The poses of all seven links in the base, in the order of model().links: base first, flange
  // last.
  std::array<Pose, 7> LinkPoses(const JointVector& q) const;

  WristJacobian JacobianAt(const JointVector& q) const;

  // All joint vectors, without regard to limits, that put the flange at X_BaseFlange: eight
  // inside the reach, none outside. At a singular pose:
  // - shoulder (the wrist centre at its least distance from axis 1): the two shoulder solutions
  //   coincide, and are given once, as kRight. Without an offset d2, q1 is free: `reference`'s.
  // - elbow (stretched or folded): the two elbow solutions coincide, and are given once.
  // - wrist (axes 4 and 6 in line): q4 is free. kNoFlip takes q4 of `reference`, kFlip that
  //   plus pi; q6 makes up the rest.
  // - wrist centre on axis 2 (if the upper arm is as long as the forearm): q2 is free, and
  //   `reference`'s.
  // A direction counts as lost below 1e-10 (metres, or sine of q5), so that every solution gives
  // the pose back to better than 1e-9. Solutions that coincide only up to rounding are all given.
  InverseSolutions Inverse(const Pose& X_BaseFlange,
                           const JointVector& reference = JointVector::Zero()) const;
  // The one of these with the indicators, for a part of the work; none if none has them.
  std::optional<JointVector> Inverse(const Pose& X_BaseFlange, const Indicators& indicators,
                                     const JointVector& reference) const;

  // ARM = sign(-(d4 s23 + a3 c23 + a2 c2)), ELBOW = ARM sign(d4 c3 - a3 s3), where sign(0) = +1.
  Indicators IndicatorsOf(const JointVector& q) const;

  // Whether every joint is within its limits, or beyond by no more than rounding (1e-9 rad).
  bool InRange(const JointVector& q) const;

  // Of the joint vectors that differ from q by whole turns and are within the limits, the one
  // whose every joint is nearest to the reference's; none if there is none.
  std::optional<JointVector> NearestInRange(const JointVector& q,
                                            const JointVector& reference) const;

  // All joint vectors that differ from q by whole turns and are within the limits, in
  // lexicographic order.
  std::vector<JointVector> Representatives(const JointVector& q) const;

 private:
  Arm(RobotModel model, const ArmGeometry& geometry);

  RobotModel model_;
  ArmGeometry geometry_;
  std::array<JointLimits, 6> limits_;
};

// The joint vector that differs from q by whole turns and is the nearest to the reference's in
// every joint, whatever the limits.
JointVector NearestByTurns(const JointVector& q, const JointVector& reference);

}  // namespace assay::kinematics
