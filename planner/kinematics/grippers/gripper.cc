#include "planner/kinematics/grippers/gripper.h"

#include <fmt/format.h>

#include <algorithm>

#include "planner/base/check.h"
#include "planner/geometry/box.h"
#include "planner/geometry/pose.h"

namespace assay::kinematics {
namespace {

constexpr double kOpeningTolerance = 1e-9;

LinkId RequireLink(const RobotModel& model, const std::string& name) {
  const LinkId link = model.FindLink(name);
  if (link.IsNone()) {
    model.Fail(fmt::format("has no link '{}'", name), "hand, tool, finger_left, finger_right");
  }
  return link;
}

// Returns the link's pose in the root when all joint values are 0.
Pose RestPose(const RobotModel& model, LinkId link) {
  const JointId joint = model.link(link).parent_joint;
  if (joint.IsNone()) return Pose::Identity();
  return RestPose(model, model.joint(joint).parent) * model.joint(joint).X_ParentJoint;
}

Box ToBox(const RobotModel& model, const Link& link, const Collision& collision) {
  const auto* box = std::get_if<BoxShape>(&collision.shape);
  if (box == nullptr) {
    model.Fail(fmt::format("link '{}' has a collision shape that is not a box", link.name),
               "boxes");
  }
  return {collision.X_LinkShape, box->size / 2};
}

std::vector<Box> BoxesOf(const RobotModel& model, LinkId id, const Pose& X_ToolLink) {
  const Link& link = model.link(id);
  std::vector<Box> boxes;
  for (const Collision& collision : link.collisions) {
    Box box = ToBox(model, link, collision);
    box.X_FrameBox = X_ToolLink * box.X_FrameBox;
    boxes.push_back(box);
  }
  if (boxes.empty()) model.Fail(fmt::format("link '{}' has no collision box", link.name));
  return boxes;
}

const Joint& RequireFingerJoint(const RobotModel& model, const std::string& name) {
  const JointId id = model.FindJoint(name);
  if (id.IsNone()) model.Fail(fmt::format("has no joint '{}'", name), "finger_left, finger_right");
  const Joint& joint = model.joint(id);
  if (joint.type != JointType::kPrismatic || joint.limits.lower != 0 ||
      model.link(joint.child).name != name || joint.parent != LinkId(0)) {
    model.Fail(
        fmt::format("joint '{}' is not a prismatic joint from 0 between hand and {}", name, name));
  }
  return joint;
}

// Reports an error unless the finger moves along `direction` of the tool.
void RequireDirection(const RobotModel& model, const Joint& joint, const Pose& X_ToolFinger,
                      const Vector3& direction) {
  const Vector3 axis = X_ToolFinger.linear() * joint.axis;
  if ((axis - direction).norm() < kFileTolerance) return;
  model.Fail(fmt::format("joint '{}' moves along ({}, {}, {}) of the tool", joint.name, axis.x(),
                         axis.y(), axis.z()),
             fmt::format("(0, {}, 0)", direction.y()));
}

// Returns the pad of a finger at joint value 0, in the tool frame. `side` is +1 for the left finger
// and -1 for the right one.
Box RequirePad(const RobotModel& model, LinkId id, const std::vector<Box>& boxes, double side) {
  const Link& finger = model.link(id);
  const auto named = std::find_if(finger.collisions.begin(), finger.collisions.end(),
                                  [](const Collision& c) { return c.name == "pad"; });
  if (named == finger.collisions.end()) {
    model.Fail(fmt::format("link '{}' has no collision box named 'pad'", finger.name));
  }
  const Box& pad = boxes[static_cast<std::size_t>(named - finger.collisions.begin())];
  const Vector3 face = pad.X_FrameBox.translation() - Vector3(0, side * pad.half_extents.y(), 0);
  const Matrix3 turned = pad.X_FrameBox.linear() - Matrix3::Identity();
  if (face.norm() > kFileTolerance || turned.cwiseAbs().maxCoeff() > kFileTolerance) {
    model.Fail(
        fmt::format("the pad of '{}' has its inner face at ({}, {}, {}) m of the tool, or is "
                    "turned, at joint value 0",
                    finger.name, face.x(), face.y(), face.z()),
        "the tool's origin and axes");
  }
  return pad;
}

}  // namespace

Gripper::Gripper(const Gripper& other) = default;
Gripper::Gripper(Gripper&& other) noexcept = default;
Gripper& Gripper::operator=(const Gripper& other) = default;
Gripper& Gripper::operator=(Gripper&& other) noexcept = default;
Gripper::~Gripper() = default;

Gripper::Gripper(RobotModel model) : model_(std::move(model)) {
  if (RequireLink(model_, "hand") != LinkId(0)) model_.Fail("the root link is not 'hand'", "hand");
  ReadTool(RequireLink(model_, "tool"));
  ReadFingers(RequireLink(model_, "finger_left"), RequireLink(model_, "finger_right"));
  hand_ = BoxesOf(model_, LinkId(0), X_FlangeTool_.inverse());
}

void Gripper::ReadTool(LinkId tool) {
  const JointId joint = model_.link(tool).parent_joint;
  if (model_.joint(joint).type != JointType::kFixed || model_.joint(joint).parent != LinkId(0)) {
    model_.Fail("link 'tool' is not fixed to the hand");
  }
  X_FlangeTool_ = RestPose(model_, tool);
}

void Gripper::ReadFingers(LinkId left, LinkId right) {
  const Pose X_ToolLeft = X_FlangeTool_.inverse() * RestPose(model_, left);
  const Pose X_ToolRight = X_FlangeTool_.inverse() * RestPose(model_, right);
  const Joint& left_joint = RequireFingerJoint(model_, "finger_left");
  const Joint& right_joint = RequireFingerJoint(model_, "finger_right");
  RequireDirection(model_, left_joint, X_ToolLeft, Vector3::UnitY());
  RequireDirection(model_, right_joint, X_ToolRight, -Vector3::UnitY());
  if (left_joint.limits.upper != right_joint.limits.upper) {
    model_.Fail("the fingers have different ranges", "the same range");
  }
  max_opening_ = left_joint.limits.upper + right_joint.limits.upper;
  max_force_ = std::min(left_joint.limits.effort, right_joint.limits.effort);

  left_ = BoxesOf(model_, left, X_ToolLeft);
  right_ = BoxesOf(model_, right, X_ToolRight);
  const Vector3 left_pad = RequirePad(model_, left, left_, 1).half_extents;
  const Vector3 right_pad = RequirePad(model_, right, right_, -1).half_extents;
  if ((left_pad - right_pad).norm() > kFileTolerance) model_.Fail("the pads differ in size");
  pad_half_extents_ = Vector2(left_pad.x(), left_pad.z());
}

Gripper Gripper::FromUrdf(const std::filesystem::path& file) { return Gripper(ReadUrdf(file)); }

Gripper Gripper::FromUrdf(const GripperInFile& gripper,
                          std::span<const std::filesystem::path> packages) {
  const RobotModel model = ReadUrdf(gripper.file, UrdfContents::kBodies, packages);
  return Gripper(gripper.pads.empty() ? model : ParallelGripperModel(model, gripper));
}

std::vector<Box> Gripper::FingerBoxes(double opening) const {
  ASSAY_CHECK(opening >= -kOpeningTolerance && opening <= max_opening_ + kOpeningTolerance,
              "opening {} m", opening);
  std::vector<Box> boxes;
  boxes.reserve(left_.size() + right_.size());
  for (const Box& box : left_) {
    boxes.push_back(box.Transformed(geometry::Translation(0, opening / 2, 0)));
  }
  for (const Box& box : right_) {
    boxes.push_back(box.Transformed(geometry::Translation(0, -opening / 2, 0)));
  }
  return boxes;
}

}  // namespace assay::kinematics
