#include "planner/kinematics/inverse/serial_chain.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace assay::kinematics {
namespace {

// Finds a chain's links in the tree of a model.
class ChainFinder {
 public:
  ChainFinder(const RobotModel& model, const std::string& base, const std::string& tip)
      : model_(model), base_(base.empty() ? LinkId(0) : Named(base, "base")) {
    tip_ = tip.empty() ? FindTip() : Named(tip, "tip");
  }

  // Returns the joints from base to tip.
  std::vector<JointId> Joints() const {
    std::vector<JointId> joints;
    for (LinkId link = tip_; link != base_;) {
      const JointId joint = model_.link(link).parent_joint;
      if (joint == JointId::None()) {
        model_.Fail(fmt::format("link '{}' is not behind link '{}'", model_.link(tip_).name,
                                model_.link(base_).name),
                    "a tip that joints connect with the base");
      }
      joints.push_back(joint);
      link = model_.joint(joint).parent;
    }
    std::ranges::reverse(joints);
    return joints;
  }

  LinkId base() const { return base_; }
  LinkId tip() const { return tip_; }

 private:
  LinkId Named(const std::string& name, const char* what) const {
    const LinkId link = model_.FindLink(name);
    if (link == LinkId::None()) {
      model_.Fail(fmt::format("has no link '{}' for the {}", name, what),
                  "the name of one of its links");
    }
    return link;
  }

  std::vector<JointId> JointsFrom(LinkId link) const {
    std::vector<JointId> joints;
    for (std::size_t i = 0; i < model_.joints.size(); ++i) {
      if (model_.joints[i].parent == link) joints.push_back(JointId(i));
    }
    return joints;
  }

  // Returns true if the joint or a joint behind it moves.
  bool Moves(JointId id) const {
    const Joint& joint = model_.joint(id);
    return joint.type != JointType::kFixed ||
           std::ranges::any_of(JointsFrom(joint.child), [&](JointId next) { return Moves(next); });
  }

  LinkId FindTip() const {
    LinkId last_moved = base_;
    for (LinkId link = base_;;) {
      std::vector<JointId> moving = JointsFrom(link);
      std::erase_if(moving, [&](JointId joint) { return !Moves(joint); });
      if (moving.size() != 1) {
        // The hand of a gripper with two moving fingers is a link behind the last joint.
        return moving.empty() ? OnlyFixedLeaf(last_moved) : link;
      }
      const Joint& joint = model_.joint(moving.front());
      if (joint.type == JointType::kPrismatic) return link;
      link = joint.child;
      if (joint.type == JointType::kRevolute) last_moved = link;
    }
  }

  LinkId OnlyFixedLeaf(LinkId link) const {
    std::vector<LinkId> leaves;
    AddLeaves(link, leaves);
    if (leaves.size() == 1) return leaves.front();
    std::vector<std::string> names;
    for (const LinkId leaf : leaves) names.push_back(model_.link(leaf).name);
    model_.Fail(fmt::format("has several links that may be the tip: {}", fmt::join(names, ", ")),
                "the tip's name (--tip)");
  }

  void AddLeaves(LinkId link, std::vector<LinkId>& leaves) const {
    const std::vector<JointId> joints = JointsFrom(link);
    if (joints.empty()) leaves.push_back(link);
    for (const JointId joint : joints) AddLeaves(model_.joint(joint).child, leaves);
  }

  const RobotModel& model_;
  LinkId base_;
  LinkId tip_;
};

void RequireRevolute(const Joint& joint) {
  const bool prismatic = joint.type == JointType::kPrismatic;
  if (!prismatic && joint.mimics.empty()) return;
  throw InputError(joint.place,
                   fmt::format("joint '{}' is between base and tip and {}", joint.name,
                               prismatic ? "is prismatic" : "mimics another joint"),
                   "revolute and fixed joints that move by themselves");
}

}  // namespace

SerialChain::SerialChain(std::vector<ChainJoint> joints, const Pose& X_BaseTip)
    : joints_(std::move(joints)), X_BaseTip_(X_BaseTip) {}

SerialChain SerialChain::FromModel(const RobotModel& model, const std::string& base,
                                   const std::string& tip) {
  const ChainFinder finder(model, base, tip);
  std::vector<ChainJoint> joints;
  std::vector<LinkId> links = {finder.base()};
  Pose X_BaseLink = Pose::Identity();
  for (const JointId id : finder.Joints()) {
    const Joint& joint = model.joint(id);
    RequireRevolute(joint);
    X_BaseLink = X_BaseLink * joint.X_ParentJoint;
    links.push_back(joint.child);
    if (joint.type == JointType::kFixed) continue;
    joints.push_back({joint.name,
                      {(X_BaseLink.linear() * joint.axis).normalized(), X_BaseLink.translation()},
                      joint.limits});
  }
  if (joints.size() != 6 && joints.size() != 7) {
    model.Fail(fmt::format("has {} revolute joints between the links '{}' and '{}'", joints.size(),
                           model.link(finder.base()).name, model.link(finder.tip()).name),
               "six or seven; the links can be named (--base, --tip)");
  }
  SerialChain chain(std::move(joints), X_BaseLink);
  chain.base_ = model.link(finder.base()).name;
  chain.tip_ = model.link(finder.tip()).name;
  chain.links_ = std::move(links);
  return chain;
}

Pose SerialChain::Forward(const ChainVector& q) const {
  Pose X = X_BaseTip_;
  for (int i = size() - 1; i >= 0; --i) X = Turn(axis(i), q[i]) * X;
  return X;
}

ChainJacobian SerialChain::Jacobian(const ChainVector& q, Pose* X_BaseTip) const {
  std::array<JointAxis, kMostChainJoints> axes;
  Pose moved = Pose::Identity();
  for (int i = 0; i < size(); ++i) {
    axes[static_cast<std::size_t>(i)] = Moved(moved, axis(i));
    moved = moved * Turn(axis(i), q[i]);
  }
  moved = moved * X_BaseTip_;
  ChainJacobian J(6, size());
  for (int i = 0; i < size(); ++i) {
    const JointAxis& at = axes[static_cast<std::size_t>(i)];
    J.col(i) << at.direction.cross(moved.translation() - at.point), at.direction;
  }
  if (X_BaseTip) *X_BaseTip = moved;
  return J;
}

SerialChain SerialChain::Locked(int joint, double value) const {
  const Pose turn = Turn(axis(joint), value);
  SerialChain chain = *this;
  chain.joints_.erase(chain.joints_.begin() + joint);
  for (int i = joint; i < chain.size(); ++i) {
    JointAxis& moved = chain.joints_[static_cast<std::size_t>(i)].axis;
    moved = Moved(turn, moved);
  }
  chain.X_BaseTip_ = turn * X_BaseTip_;
  return chain;
}

}  // namespace assay::kinematics
