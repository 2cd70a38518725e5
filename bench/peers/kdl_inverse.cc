#include "bench/peers/kdl_inverse.h"

#include <kdl/chain.hpp>
#include <kdl/chainiksolverpos_lma.hpp>

namespace assay::peers {
namespace {

KDL::Frame FrameOf(const geometry::Pose& X) {
  const geometry::Matrix3& R = X.linear();
  const geometry::Vector3& p = X.translation();
  return {KDL::Rotation(R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2), R(2, 0), R(2, 1),
                        R(2, 2)),
          KDL::Vector(p.x(), p.y(), p.z())};
}

// Returns KDL's chain. A segment of KDL has its joint at its root. The frame that leads to a joint
// therefore belongs to the previous segment.
KDL::Chain ChainOf(const kinematics::RobotModel& model) {
  KDL::Chain chain;
  for (const kinematics::Joint& joint : model.joints) {
    const KDL::Frame X_ParentJoint = FrameOf(joint.X_ParentJoint);
    const KDL::Vector axis =
        X_ParentJoint.M * KDL::Vector(joint.axis.x(), joint.axis.y(), joint.axis.z());
    chain.addSegment(
        KDL::Segment(joint.name, KDL::Joint(joint.name, X_ParentJoint.p, axis, KDL::Joint::RotAxis),
                     X_ParentJoint));
  }
  return chain;
}

}  // namespace

class KdlInverse::Solver {
 public:
  explicit Solver(const kinematics::RobotModel& model)
      : chain_(ChainOf(model)), solver_(chain_), start_(6), found_(6) {
    for (unsigned int i = 0; i < 6; ++i) {
      const kinematics::JointLimits& limits = model.joints[i].limits;
      start_(i) = (limits.lower + limits.upper) / 2 + 0.1;
    }
  }

  std::optional<kinematics::JointVector> Solve(const geometry::Pose& X_BaseFlange) {
    if (solver_.CartToJnt(start_, FrameOf(X_BaseFlange), found_) < 0) return std::nullopt;
    return kinematics::JointVector(found_.data);
  }

 private:
  KDL::Chain chain_;
  KDL::ChainIkSolverPos_LMA solver_;
  KDL::JntArray start_;
  KDL::JntArray found_;
};

KdlInverse::KdlInverse(const kinematics::RobotModel& model)
    : solver_(std::make_unique<Solver>(model)) {}

KdlInverse::~KdlInverse() = default;

std::optional<kinematics::JointVector> KdlInverse::Solve(const geometry::Pose& X_BaseFlange) {
  return solver_->Solve(X_BaseFlange);
}

}  // namespace assay::peers
