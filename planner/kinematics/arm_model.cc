#include "planner/kinematics/arm_model.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/SVD>
#include <algorithm>
#include <functional>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "planner/kinematics/branched_chain.h"
#include "planner/kinematics/derived_inertia.h"
#include "planner/kinematics/fixed_links.h"

namespace assay::kinematics {
namespace {

constexpr double kRoundedAngle = 1e-5;  // radians by which files round right angles
constexpr int kTriedPostures = 20;
constexpr double kSingularDeterminant = 1e-9;  // cubic metres

// Returns the rotation with the entries that are rounded zeros set to zero.
Pose WithoutRounding(const Pose& pose) {
  Matrix3 R = pose.linear();
  if ((R.array().abs() >= kRoundedAngle || R.array() == 0).all()) return pose;
  R = (R.array().abs() < kRoundedAngle).select(0, R);
  const Eigen::JacobiSVD<Matrix3> svd(R, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Pose exact = pose;
  exact.linear() = svd.matrixU() * svd.matrixV().transpose();
  exact.linear() = (exact.linear().array().abs() < kFileTolerance).select(0, exact.linear());
  return exact;
}

// Puts the links of a model together to a base and six moving links.
class ArmBuilder {
 public:
  ArmBuilder(const RobotModel& model, const SerialChain& chain)
      : model_(model), places_(model.links.size()) {
    arm_.place = model.place;
    arm_.name = model.name;
    FollowChain(chain);
    for (std::size_t turn = 0; turn < model.links.size(); ++turn) PlaceNeighbours();
    RequireNothingElseMoves();
  }

  RobotModel Build(LinkId flange) {
    for (std::size_t i = 0; i < model_.links.size(); ++i) {
      if (!places_[i]) continue;
      AddFixedLink(model_.links[i], places_[i]->X_BodyLink, arm_.links[places_[i]->body]);
    }
    SetFlange(places_[static_cast<std::size_t>(flange.index())]->X_BodyLink);
    for (auto link = arm_.links.begin() + 1; link != arm_.links.end(); ++link) {
      if (link->inertial) continue;
      link->inertial = DerivedInertial(*link);
      link->inertial_is_derived = true;
      if (link->inertial) continue;
      throw InputError(
          link->place,
          fmt::format("link '{}' has neither a mass nor a collision shape", link->name),
          "an element 'inertial' or 'collision' in each link that moves");
    }
    return std::move(arm_);
  }

 private:
  // The place of a link in the body (base or moving link) that it belongs to.
  struct Placement {
    std::size_t body = 0;
    Pose X_BodyLink = Pose::Identity();
  };

  std::optional<Placement>& PlaceOf(LinkId link) {
    return places_[static_cast<std::size_t>(link.index())];
  }

  void FollowChain(const SerialChain& chain) {
    PlaceOf(chain.links().front()) = Placement{};
    AddBody(chain.links().front());
    for (auto link = chain.links().begin() + 1; link != chain.links().end(); ++link) {
      const JointId id = model_.link(*link).parent_joint;
      const Joint& joint = model_.joint(id);
      const Placement& parent = *PlaceOf(joint.parent);
      const Pose X_BodyJoint = parent.X_BodyLink * WithoutRounding(joint.X_ParentJoint);
      if (joint.type == JointType::kFixed) {
        PlaceOf(*link) = Placement{parent.body, X_BodyJoint};
        continue;
      }
      AddBody(*link);
      Joint& moving = arm_.joints.emplace_back(joint);
      moving.parent = LinkId(parent.body);
      moving.child = LinkId(arm_.links.size() - 1);
      moving.X_ParentJoint = X_BodyJoint;
      arm_.links.back().parent_joint = JointId(arm_.joints.size() - 1);
      PlaceOf(*link) = Placement{arm_.links.size() - 1};
    }
  }

  void AddBody(LinkId link) {
    arm_.links.push_back({.name = model_.link(link).name, .place = model_.link(link).place});
  }

  void PlaceNeighbours() {
    for (const Joint& joint : model_.joints) {
      if (joint.type != JointType::kFixed) continue;
      const Pose X_ParentChild = WithoutRounding(joint.X_ParentJoint);
      std::optional<Placement>& parent = PlaceOf(joint.parent);
      std::optional<Placement>& child = PlaceOf(joint.child);
      if (parent && !child) child = Placement{parent->body, parent->X_BodyLink * X_ParentChild};
      if (child && !parent) {
        parent = Placement{child->body, child->X_BodyLink * X_ParentChild.inverse()};
      }
    }
  }

  void RequireNothingElseMoves() const {
    for (const Joint& joint : model_.joints) {
      const bool is_of_arm = std::ranges::count(arm_.joints, joint.name, &Joint::name) > 0;
      if (joint.type == JointType::kFixed || is_of_arm) continue;
      throw InputError(
          joint.place,
          fmt::format("joint '{}' moves, but is not between base and flange", joint.name),
          "an arm's file without its gripper, or other names of base and flange");
    }
  }

  // Gives the last link the flange's frame. The last joint turns about the flange's origin then.
  void SetFlange(const Pose& X_LastFlange) {
    Joint& last = arm_.joints.back();
    const Vector3 off_axis = X_LastFlange.translation().cross(last.axis);
    if (off_axis.norm() > kFileTolerance) {
      model_.Fail(fmt::format("the flange's origin is {:.6g} m off axis 6 (joint '{}')",
                              off_axis.norm(), last.name),
                  "a flange on axis 6");
    }
    last.X_ParentJoint = last.X_ParentJoint * X_LastFlange;
    last.axis = X_LastFlange.linear().transpose() * last.axis;
    Link& link = arm_.links.back();
    const Pose X_FlangeLast = X_LastFlange.inverse();
    for (Visual& visual : link.visuals) visual.X_LinkShape = X_FlangeLast * visual.X_LinkShape;
    for (Collision& shape : link.collisions) shape.X_LinkShape = X_FlangeLast * shape.X_LinkShape;
    if (link.inertial) link.inertial = Moved(X_FlangeLast, *link.inertial);
  }

  const RobotModel& model_;
  std::vector<std::optional<Placement>> places_;  // by LinkId
  RobotModel arm_;
};

// Returns the mean magnitude of the determinant of the Jacobian of an arm with six joints, over
// some postures.
double MeanDeterminant(const SerialChain& chain) {
  double sum = 0;
  ChainVector q = ChainVector::Zero(6);
  for (int posture = 0; posture < kTriedPostures; ++posture) {
    for (int joint = 0; joint < 6; ++joint) q[joint] += 0.7 + 0.4 * joint;
    const Eigen::Matrix<double, 6, 6> jacobian = chain.Jacobian(q);
    sum += std::abs(jacobian.determinant());
  }
  return sum / kTriedPostures;
}

bool FlangeIsOnLastAxis(const SerialChain& chain) {
  const JointAxis& last = chain.axis(5);
  const Vector3 flange = chain.X_BaseTipAtZero().translation();
  return (flange - last.point).cross(last.direction).norm() < kFileTolerance;
}

// Returns multiples of 30 degrees within the limits, or else the middle of the range.
std::vector<double> LockedValues(const JointLimits& limits) {
  std::vector<double> values;
  for (const int steps : {0, 1, -1, 2, -2, 3, -3}) {
    const double value = steps * std::numbers::pi / 6;
    if (value >= limits.lower && value <= limits.upper) values.push_back(value);
  }
  if (values.empty()) values.push_back(std::midpoint(limits.lower, limits.upper));
  return values;
}

// A way to lock a joint, and what is good about it.
struct RatedLocking {
  LockedJoints locked;
  bool tells_apart = false;
  double determinant = 0;
};

std::vector<std::string> RevoluteJoints(const RobotModel& model) {
  std::vector<std::string> names;
  for (const Joint& joint : model.joints) {
    if (joint.type == JointType::kRevolute) names.push_back(joint.name);
  }
  return names;
}

}  // namespace

RobotModel WithLocked(RobotModel model, const LockedJoints& locked) {
  for (const auto& [name, value] : locked) {
    const JointId id = model.FindJoint(name);
    if (id.IsNone() || model.joint(id).type != JointType::kRevolute) {
      model.Fail(fmt::format("has no revolute joint '{}', which the workcell locks", name),
                 fmt::format("{}", fmt::join(RevoluteJoints(model), ", ")));
    }
    Joint& joint = model.joints[static_cast<std::size_t>(id.index())];
    if (value < joint.limits.lower || value > joint.limits.upper) {
      throw InputError(
          joint.place,
          fmt::format("joint '{}' is locked at {:.6g} rad, outside its limits", name, value),
          fmt::format("{:.6g} to {:.6g} rad", joint.limits.lower, joint.limits.upper));
    }
    joint.X_ParentJoint = joint.X_ParentChild(value);
    joint.type = JointType::kFixed;
    joint.limits = {};
  }
  return model;
}

std::vector<LockedJoints> Lockings(const RobotModel& model, const std::string& base,
                                   const std::string& flange) {
  RobotModel exact = model;
  for (Joint& joint : exact.joints) joint.X_ParentJoint = WithoutRounding(joint.X_ParentJoint);
  const SerialChain chain = SerialChain::FromModel(exact, base, flange);
  if (chain.size() == 6) return {{}};
  std::vector<RatedLocking> rated;
  for (int joint = 0; joint < chain.size(); ++joint) {
    const ChainJoint& one = chain.joints()[static_cast<std::size_t>(joint)];
    for (const double value : LockedValues(one.limits)) {
      const SerialChain rest = chain.Locked(joint, value);
      const double determinant = MeanDeterminant(rest);
      if (determinant < kSingularDeterminant || !FlangeIsOnLastAxis(rest)) continue;
      rated.push_back({{{one.name, value}}, BranchedChain(rest).TellsAllApart(), determinant});
    }
  }
  std::ranges::stable_sort(rated, std::greater(), [](const RatedLocking& locking) {
    return std::pair(locking.tells_apart, locking.determinant);
  });
  std::vector<LockedJoints> lockings;
  for (RatedLocking& locking : rated) lockings.push_back(std::move(locking.locked));
  return lockings;
}

RobotModel ArmModel(const RobotModel& model, const std::string& base, const std::string& flange) {
  const SerialChain chain = SerialChain::FromModel(model, base, flange);
  if (chain.size() == 7) {
    model.Fail("has seven revolute joints between base and flange",
               "six, and the value of a seventh one that does not move (key 'locked' of a "
               "workcell's robot)");
  }
  return ArmBuilder(model, chain).Build(chain.links().back());
}

SerialChain MovableChain(const RobotModel& arm) {
  SerialChain chain = SerialChain::FromModel(arm);
  if (MeanDeterminant(chain) > kSingularDeterminant) return chain;
  arm.Fail("the axes let the flange move in fewer than six ways, in every posture",
           "an arm whose flange can move in all directions");
}

}  // namespace assay::kinematics
