#pragma once

#include <string>
#include <vector>

#include "planner/kinematics/inverse/joint_axis.h"
#include "planner/kinematics/urdf_model.h"

namespace assay::kinematics {

inline constexpr int kMostChainJoints = 7;

// Joint values of a chain in radians, joint 1 first.
using ChainVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMostChainJoints, 1>;
// Rows 1 to 3 are velocities of the tip's origin (m/s), rows 4 to 6 are angular velocities of the
// tip (rad/s), both in the base frame, per rad/s of each joint.
using ChainJacobian = Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, kMostChainJoints>;

struct ChainJoint {
  std::string name;
  JointAxis axis;  // in the base frame, when all joint values are 0
  JointLimits limits = {};
};

// A chain of six or seven revolute joints from a base to a tip.
class SerialChain {
 public:
  // Reads the chain between two links of a model. With an empty `base`, the chain starts at the
  // root. With an empty `tip`, the chain follows the moving joints. It ends at the link where the
  // robot branches into two moving parts (the fingers of a gripper), or where a prismatic joint
  // follows. Otherwise it ends at the last link, behind the fixed joints that follow the last
  // moving joint. Throws InputError if the model has no link with these names, if several links can
  // be the tip, if a joint between base and tip is prismatic or mimics another, or if there are not
  // six or seven revolute joints.
  static SerialChain FromModel(const RobotModel& model, const std::string& base = "",
                               const std::string& tip = "");

  // A chain of any axes. Directions must be unit vectors.
  SerialChain(std::vector<ChainJoint> joints, const Pose& X_BaseTip);

  int size() const { return static_cast<int>(joints_.size()); }
  const std::vector<ChainJoint>& joints() const { return joints_; }
  const JointAxis& axis(int joint) const { return joints_[static_cast<std::size_t>(joint)].axis; }
  const std::string& base() const { return base_; }  // names of links; empty without a model
  const std::string& tip() const { return tip_; }
  const std::vector<LinkId>& links() const { return links_; }  // of the model, base to tip
  const Pose& X_BaseTipAtZero() const { return X_BaseTip_; }

  // Returns X_BaseTip as a product of exponentials. q has size() entries.
  Pose Forward(const ChainVector& q) const;
  // Returns the geometric Jacobian, and the tip's pose.
  ChainJacobian Jacobian(const ChainVector& q, Pose* X_BaseTip = nullptr) const;

  // Returns the chain without a joint, which stands at this value.
  SerialChain Locked(int joint, double value) const;

 private:
  std::vector<ChainJoint> joints_;
  Pose X_BaseTip_;
  std::string base_;
  std::string tip_;
  std::vector<LinkId> links_;
};

}  // namespace assay::kinematics
