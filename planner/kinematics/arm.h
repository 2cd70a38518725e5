#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "planner/geometry/coordinates.h"
#include "planner/kinematics/arm_geometry.h"
#include "planner/kinematics/arm_model.h"
#include "planner/kinematics/arm_solver.h"
#include "planner/kinematics/urdf_model.h"

namespace assay::kinematics {

// Which links and joints of a URDF file are the arm.
struct ArmInFile {
  // The links between which the arm lies. Empty names are found if there is only one choice
  // (SerialChain::FromModel).
  std::string base = {};
  std::string flange = {};
  // The arm has six other joints.
  LockedJoints locked = {};
};

// An arm with six revolute joints that move.
class Arm {
 public:
  // Reads an arm from a URDF file. Links that are fixed to each other become one link, so that the
  // arm has a base and six moving links. `packages` are folders with meshes (ReadUrdf). Throws
  // InputError if the file is not URDF, if the joints between base and flange that are not locked
  // are not six revolute ones, if other joints move, or if the flange cannot move in all
  // directions.
  static Arm FromUrdf(const std::filesystem::path& file, const ArmInFile& arm = {},
                      std::span<const std::filesystem::path> packages = {});
  static Arm FromModel(const RobotModel& model, const ArmInFile& arm = {});

  // The base and the six moving links, each in the frame of its joint. The last link has the
  // flange's frame.
  const RobotModel& model() const { return model_; }
  const std::array<JointLimits, 6>& limits() const { return limits_; }

  // The lengths of an arm that satisfies Lee and Ziegler's convention (arm_geometry.h). Null for
  // other arms.
  const ArmGeometry* geometry() const { return geometry_ ? &*geometry_ : nullptr; }

  // Forward and inverse kinematics, as ArmSolver and its two classes (lee_ziegler.h,
  // branched_chain.h) describe them.
  Pose Forward(const JointVector& q) const { return solver_->Forward(q); }
  InverseSolutions Inverse(const Pose& X_BaseFlange,
                           const JointVector& reference = JointVector::Zero()) const {
    return solver_->Inverse(X_BaseFlange, reference);
  }
  std::optional<JointVector> Inverse(const Pose& X_BaseFlange, const Indicators& indicators,
                                     const JointVector& reference) const {
    return solver_->Inverse(X_BaseFlange, indicators, reference);
  }
  Indicators IndicatorsOf(const JointVector& q) const { return solver_->IndicatorsOf(q); }
  bool IndicatorsTellAllApart() const { return solver_->TellsAllApart(); }
  bool HasSphericalWrist() const { return solver_->HasSphericalWrist(); }
  Vector3 p_FlangeCenter() const { return solver_->p_FlangeCenter(); }
  ArmJacobian JacobianAt(const JointVector& q) const { return solver_->JacobianAt(q); }

  // Returns the poses of all seven links in the base, in the order of model().links: the base is
  // first, the flange is last.
  std::array<Pose, 7> LinkPoses(const JointVector& q) const;

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
  explicit Arm(RobotModel model);

  RobotModel model_;
  std::optional<ArmGeometry> geometry_;
  std::shared_ptr<const ArmSolver> solver_;
  std::array<JointLimits, 6> limits_;
};

// Returns the joint vector that differs from q by whole turns and is nearest to the reference in
// every joint. Joint limits are ignored.
JointVector NearestByTurns(const JointVector& q, const JointVector& reference);

}  // namespace assay::kinematics
