#include "planner/kinematics/arm_geometry.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>

namespace assay::kinematics {
namespace {

// A joint's axis in the root's frame when all joint values are 0.
struct AxisLine {
  Vector3 point;
  Vector3 direction;
};

// Reads the lengths from a chain. Reports an error if the closed form does not apply to the chain.
class GeometryReader {
 public:
  explicit GeometryReader(const RobotModel& model) : model_(model) {
    RequireChain();
    Pose X_BaseLink = Pose::Identity();
    for (std::size_t i = 0; i < 6; ++i) {
      X_BaseLink = X_BaseLink * model_.joints[i].X_ParentJoint;
      axes_[i] = {X_BaseLink.translation(), X_BaseLink.linear() * model_.joints[i].axis};
    }
    X_BaseFlange_ = X_BaseLink;
  }

  ArmGeometry Read() const {
    RequireDirections();
    const Vector3& elbow = axes_[2].point;
    const Vector3& roll = axes_[3].point;
    const Vector3& bend = axes_[4].point;
    const Vector3 flange = X_BaseFlange_.translation();
    RequireZero(0, "x", axes_[0].point.x());
    RequireZero(0, "y", axes_[0].point.y());
    RequireZero(1, "x", axes_[1].point.x());
    RequireZero(1, "z", axes_[1].point.z());
    RequireZero(2, "z", elbow.z());
    RequireZero(4, "x relative to axis 4", bend.x() - roll.x());
    RequireZero(5, "x relative to axis 4", axes_[5].point.x() - roll.x());
    RequireZero(5, "y relative to axis 4", axes_[5].point.y() - roll.y());
    RequireFlange(flange - Vector3(roll.x(), roll.y(), flange.z()));
    return Positive({.a2 = elbow.x(),
                     .a3 = roll.x() - elbow.x(),
                     .d2 = roll.y(),
                     .d4 = bend.z(),
                     .d6 = flange.z() - bend.z()});
  }

 private:
  void RequireChain() const {
    if (model_.joints.size() != 6) {
      model_.Fail(fmt::format("has {} joints", model_.joints.size()),
                  "the six revolute joints of an arm, in one chain");
    }
    for (std::size_t i = 0; i < 6; ++i) {
      const Joint& joint = model_.joints[i];
      if (joint.type != JointType::kRevolute) {
        model_.Fail(fmt::format("joint '{}' (joint {}) is not revolute", joint.name, i + 1),
                    "six revolute joints");
      }
      if (joint.parent != LinkId(i)) {
        model_.Fail(fmt::format("joint '{}' branches off link '{}'", joint.name,
                                model_.link(joint.parent).name),
                    "one chain of links");
      }
    }
  }

  void RequireDirections() const {
    for (std::size_t i = 0; i < 6; ++i) {
      const bool along_y = i == 1 || i == 2 || i == 4;
      const Vector3 wanted = along_y ? Vector3::UnitY() : Vector3::UnitZ();
      const Vector3& d = axes_[i].direction;
      if ((d - wanted).norm() < kFileTolerance) continue;
      model_.Fail(fmt::format("{} points along ({}, {}, {}) of the root link at joint values 0",
                              NameOf(i), d.x(), d.y(), d.z()),
                  along_y ? "(0, 1, 0)" : "(0, 0, 1)");
    }
  }

  void RequireZero(std::size_t axis, const std::string& what, double value) const {
    if (std::abs(value) < kFileTolerance) return;
    model_.Fail(fmt::format("{} has {} = {} m at joint values 0", NameOf(axis), what, value),
                "0 m");
  }

  void RequireFlange(const Vector3& off_axis) const {
    const bool turned =
        (X_BaseFlange_.linear() - Matrix3::Identity()).cwiseAbs().maxCoeff() > kFileTolerance;
    if (!turned && off_axis.norm() < kFileTolerance) return;
    model_.Fail(fmt::format("the flange '{}' is turned or off axis 6 at joint values 0",
                            model_.links.back().name),
                "the root's orientation, the origin on axis 6");
  }

  ArmGeometry Positive(const ArmGeometry& g) const {
    if (g.a2 < kFileTolerance || g.d4 < kFileTolerance) {
      model_.Fail(fmt::format("the upper arm is {} m and the forearm {} m long", g.a2, g.d4),
                  "positive lengths");
    }
    return g;
  }

  std::string NameOf(std::size_t axis) const {
    return fmt::format("axis {} (joint '{}')", axis + 1, model_.joints[axis].name);
  }

  const RobotModel& model_;
  std::array<AxisLine, 6> axes_;
  Pose X_BaseFlange_;
};

}  // namespace

ArmGeometry ReadGeometry(const RobotModel& model) { return GeometryReader(model).Read(); }

}  // namespace assay::kinematics
