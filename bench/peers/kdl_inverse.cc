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

// Returns KDL's chain. All frames have the base's orientation and origin at joint values 0, but for
// the last one, which is the tip.
KDL::Chain ChainOf(const kinematics::SerialChain& arm) {
  KDL::Chain chain;
  for (int i = 0; i < arm.size(); ++i) {
    const kinematics::JointAxis& axis = arm.axis(i);
    const std::string& name = arm.joints()[static_cast<std::size_t>(i)].name;
    const KDL::Vector point(axis.point.x(), axis.point.y(), axis.point.z());
    const KDL::Vector direction(axis.direction.x(), axis.direction.y(), axis.direction.z());
    chain.addSegment(
        KDL::Segment(name, KDL::Joint(name, point, direction, KDL::Joint::RotAxis),
                     i + 1 < arm.size() ? KDL::Frame::Identity() : FrameOf(arm.X_BaseTipAtZero())));
  }
  return chain;
}

}  // namespace

class KdlInverse::Solver {
 public:
  explicit Solver(const kinematics::SerialChain& arm)
      : chain_(ChainOf(arm)), solver_(chain_), start_(6), found_(6) {
    for (unsigned int i = 0; i < 6; ++i) {
      const kinematics::JointLimits& limits = arm.joints()[i].limits;
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

KdlInverse::KdlInverse(const kinematics::SerialChain& arm)
    : solver_(std::make_unique<Solver>(arm)) {}

KdlInverse::~KdlInverse() = default;

std::optional<kinematics::JointVector> KdlInverse::Solve(const geometry::Pose& X_BaseFlange) {
  return solver_->Solve(X_BaseFlange);
}

}  // namespace assay::peers
