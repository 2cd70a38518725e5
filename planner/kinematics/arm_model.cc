#include "planner/kinematics/arm_model.h"

#include <fmt/format.h>

#include <Eigen/SVD>
#include <algorithm>
#include <optional>
#include <vector>

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

// The two bodies as one, with the first one's frame.
Inertial Joined(const Inertial& a, const Inertial& b) {
  const double mass = a.mass + b.mass;
  if (mass == 0) return a;
  Inertial joined{.mass = mass, .inertia = Matrix3::Zero()};
  const Vector3 center =
      (a.mass * a.X_LinkCenter.translation() + b.mass * b.X_LinkCenter.translation()) / mass;
  joined.X_LinkCenter.translation() = center;
  for (const Inertial* body : {&a, &b}) {
    const Matrix3 R = body->X_LinkCenter.linear();
    const Vector3 d = body->X_LinkCenter.translation() - center;
    joined.inertia += R * body->inertia * R.transpose() +
                      body->mass * (d.squaredNorm() * Matrix3::Identity() - d * d.transpose());
  }
  return joined;
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
      if (places_[i]) AddLink(model_.links[i], *places_[i]);
    }
    SetFlange(places_[static_cast<std::size_t>(flange.index())]->X_BodyLink);
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

  void AddLink(const Link& link, const Placement& place) {
    Link& body = arm_.links[place.body];
    for (Visual visual : link.visuals) {
      visual.X_LinkShape = place.X_BodyLink * visual.X_LinkShape;
      body.visuals.push_back(std::move(visual));
    }
    for (Collision collision : link.collisions) {
      collision.X_LinkShape = place.X_BodyLink * collision.X_LinkShape;
      body.collisions.push_back(std::move(collision));
    }
    body.meshes.insert(body.meshes.end(), link.meshes.begin(), link.meshes.end());
    if (!link.inertial) return;
    Inertial inertial = *link.inertial;
    inertial.X_LinkCenter = place.X_BodyLink * inertial.X_LinkCenter;
    body.inertial = body.inertial ? Joined(*body.inertial, inertial) : inertial;
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
    if (link.inertial) link.inertial->X_LinkCenter = X_FlangeLast * link.inertial->X_LinkCenter;
  }

  const RobotModel& model_;
  std::vector<std::optional<Placement>> places_;  // by LinkId
  RobotModel arm_;
};

}  // namespace

RobotModel ArmModel(const RobotModel& model, const std::string& base, const std::string& flange) {
  const SerialChain chain = SerialChain::FromModel(model, base, flange);
  if (chain.size() != 6) {
    model.Fail(fmt::format("has {} revolute joints between base and flange", chain.size()), "six");
  }
  return ArmBuilder(model, chain).Build(chain.links().back());
}

SerialChain MovableChain(const RobotModel& arm) {
  SerialChain chain = SerialChain::FromModel(arm);
  ChainVector q = ChainVector::Zero(6);
  for (int posture = 0; posture < kTriedPostures; ++posture) {
    for (int joint = 0; joint < 6; ++joint) q[joint] += 0.7 + 0.4 * joint;
    const Eigen::Matrix<double, 6, 6> jacobian = chain.Jacobian(q);
    if (std::abs(jacobian.determinant()) > kSingularDeterminant) return chain;
  }
  arm.Fail("the axes let the flange move in fewer than six ways, in every posture",
           "an arm whose flange can move in all directions");
}

}  // namespace assay::kinematics
