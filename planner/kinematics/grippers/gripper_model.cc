#include "planner/kinematics/grippers/gripper_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "planner/geometry/box.h"
#include "planner/geometry/hull.h"
#include "planner/geometry/pose.h"
#include "planner/kinematics/fixed_links.h"

namespace assay::kinematics {
namespace {

constexpr double kAlignment = 2e-5;      // radians and metres by which a file may be off
constexpr double kLeastLength = 0.001;   // metres; of the edges of a pad, and of the opening
constexpr double kPadThickness = 0.004;  // metres
constexpr double kBehindPad = 0.0005;    // metres from a pad's face to the shapes of its finger
constexpr double kMostOverlap = 0.0002;  // metres by which shapes of a finger may pass its pad
constexpr double kBesideFinger = 0.001;  // metres by which a pad may be wider than its finger
constexpr double kBehindMost = 0.02;     // metres from a pad's face to the finger that bears it

// A finger: the body that a prismatic joint moves, at joint value 0. All is in the flange's frame.
struct Finger {
  const Joint* joint = nullptr;
  Vector3 axis = Vector3::Zero();
  Vector3 pad = Vector3::Zero();  // the centre of the pad's face
  geometry::Vector2 pad_size = geometry::Vector2::Zero();
  std::string pad_link = {};
  std::size_t body = 0;  // the number of its joint, counted from 1
};

// The least and greatest coordinates of a shape, in the frame of its body. For the right finger, y
// is counted the other way, so that it is 0 at the face of the pad and grows into the finger.
struct Extent {
  Vector3 low = Vector3::Constant(std::numeric_limits<double>::infinity());
  Vector3 high = -low;

  void Add(const Vector3& point) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
};

// Where the pads are at joint values `at_left` and `at_right`.
struct ClosedPads {
  double left = 0;  // joint values
  double right = 0;
  Vector3 gap = Vector3::Zero();  // from the right pad to the left one
};

// The corners of a shape, or of a box around it, in the shape's frame.
std::vector<Vector3> CornersOf(const Shape& shape) {
  if (const auto* hull = std::get_if<HullShape>(&shape)) return hull->hull->vertices;
  Vector3 half;
  if (const auto* box = std::get_if<BoxShape>(&shape)) {
    half = box->size / 2;
  } else if (const auto* cylinder = std::get_if<CylinderShape>(&shape)) {
    half = Vector3(cylinder->radius, cylinder->radius, cylinder->length / 2);
  } else {
    half = Vector3::Constant(std::get<SphereShape>(shape).radius);
  }
  std::vector<Vector3> corners;
  for (const Vector3& corner : geometry::Box{Pose::Identity(), half}.Corners()) {
    corners.push_back(corner);
  }
  return corners;
}

Extent ExtentOf(const Collision& shape, double side) {
  Extent extent;
  for (const Vector3& corner : CornersOf(shape.shape)) {
    Vector3 point = shape.X_LinkShape * corner;
    point.y() *= side;
    extent.Add(point);
  }
  return extent;
}

Collision BoxOver(const Extent& extent, double side, const std::string& name) {
  Vector3 center = (extent.low + extent.high) / 2;
  center.y() *= side;
  return {name, Pose(Eigen::Translation3d(center)), BoxShape{extent.high - extent.low}};
}

// Cuts a shape of a finger behind the face of its pad. Returns none if nothing is left. Shapes are
// named after their links. All is in the frame of the tool.
std::optional<Collision> BehindPad(const Collision& shape, double side, const RobotModel& model) {
  Extent extent = ExtentOf(shape, side);
  if (extent.low.y() >= kBehindPad) return shape;
  if (extent.low.y() < -kMostOverlap) {
    model.Fail(fmt::format("a shape of link '{}' reaches {:.3g} mm beyond the face of the pad",
                           shape.name, -1e3 * extent.low.y()),
               "pads whose faces are the innermost of their fingers");
  }
  if (extent.high.y() <= kBehindPad) return std::nullopt;
  extent.low.y() = kBehindPad;
  return BoxOver(extent, side, shape.name);
}

// Reports an error unless the finger bears its pad.
void RequireFingerBehindPad(const std::vector<Collision>& shapes, double side,
                            const Finger& of_finger, const RobotModel& model) {
  const auto& [pad, link] = std::tie(of_finger.pad_size, of_finger.pad_link);
  Extent finger;
  bool is_behind = false;
  for (const Collision& shape : shapes) {
    const Extent extent = ExtentOf(shape, side);
    finger.Add(extent.low);
    finger.Add(extent.high);
    is_behind |= extent.low.y() < kBehindMost && extent.low.x() <= 0 && extent.high.x() >= 0 &&
                 extent.low.z() <= 0 && extent.high.z() >= 0;
  }
  if (!is_behind) {
    model.Fail(fmt::format("no shape of the finger is within {:.0f} mm behind the middle of the "
                           "pad of link '{}'",
                           1e3 * kBehindMost, link),
               "collision shapes of the fingers, and pads on their inner faces");
  }
  const Vector3 half(pad.x() / 2 - kBesideFinger, 0, pad.y() / 2 - kBesideFinger);
  if (half.x() > std::min(-finger.low.x(), finger.high.x()) ||
      half.z() > std::min(-finger.low.z(), finger.high.z())) {
    model.Fail(fmt::format("the pad of link '{}', {:.4g} by {:.4g} mm, reaches beyond its finger",
                           link, 1e3 * pad.x(), 1e3 * pad.y()),
               "a pad on its finger");
  }
}

class ParallelGripper {
 public:
  ParallelGripper(const RobotModel& model, const GripperInFile& in_file)
      : model_(model), in_file_(in_file) {
    PlaceLinks();
    FindFingers();
    FindTool();
  }

  RobotModel Build() const {
    RobotModel gripper;
    gripper.place = model_.place;
    gripper.name = model_.name;
    gripper.links = {Body("hand", 0, Pose::Identity()),
                     {.name = "tool"},
                     FingerBody("finger_left", left_, closed_.left, 1),
                     FingerBody("finger_right", right_, closed_.right, -1)};
    const JointLimits limits{
        .lower = 0,
        .upper = std::min(RangeOf(left_), RangeOf(right_)),
        .velocity = std::min(left_.joint->limits.velocity, right_.joint->limits.velocity),
        .effort = std::min(left_.joint->limits.effort, right_.joint->limits.effort)};
    const auto add = [&](std::size_t child, JointType type, const Vector3& axis) {
      gripper.links[child].parent_joint = JointId(gripper.joints.size());
      gripper.joints.push_back({.name = gripper.links[child].name,
                                .type = type,
                                .parent = LinkId(0),
                                .child = LinkId(child),
                                .X_ParentJoint = X_FlangeTool_,
                                .axis = axis,
                                .limits = type == JointType::kFixed ? JointLimits{} : limits});
    };
    add(1, JointType::kFixed, Vector3::UnitZ());
    add(2, JointType::kPrismatic, Vector3::UnitY());
    add(3, JointType::kPrismatic, -Vector3::UnitY());
    return gripper;
  }

 private:
  // Finds where each link is in the flange's frame, and which joint moves it, if any.
  void PlaceLinks() {
    std::vector<Pose> X_RootLink = {Pose::Identity()};
    bodies_ = {0};
    for (std::size_t i = 0; i < model_.joints.size(); ++i) {
      const Joint& joint = model_.joints[i];
      const auto parent = static_cast<std::size_t>(joint.parent.index());
      X_RootLink.push_back(X_RootLink[parent] * joint.X_ParentJoint);
      if (joint.type != JointType::kFixed && bodies_[parent] != 0) {
        throw InputError(
            joint.place,
            fmt::format("joint '{}' moves and is behind a joint that moves", joint.name),
            "two fingers that move along straight lines");
      }
      bodies_.push_back(joint.type == JointType::kFixed ? bodies_[parent] : i + 1);
    }
    const Pose X_FlangeRoot = X_RootLink[FlangeLink()].inverse();
    for (const Pose& X : X_RootLink) X_FlangeLink_.push_back(X_FlangeRoot * X);
  }

  std::size_t FlangeLink() const {
    if (in_file_.flange.empty()) return 0;
    const LinkId link = model_.FindLink(in_file_.flange);
    if (link.IsNone() || bodies_[static_cast<std::size_t>(link.index())] != 0) {
      model_.Fail(fmt::format("has no link '{}' that does not move", in_file_.flange),
                  "the link that is mounted on the arm");
    }
    return static_cast<std::size_t>(link.index());
  }

  void FindFingers() {
    for (const auto& [name, pad] : in_file_.pads) RequirePadOnFinger(name, pad);
    std::vector<Finger> fingers;
    for (std::size_t i = 0; i < model_.joints.size(); ++i) {
      if (model_.joints[i].type != JointType::kFixed) fingers.push_back(FingerOf(i));
    }
    if (fingers.size() != 2) {
      model_.Fail(fmt::format("has {} joints that move", fingers.size()),
                  "two prismatic joints, one for each finger");
    }
    left_ = fingers[0];
    right_ = fingers[1];
  }

  void RequirePadOnFinger(const std::string& name, const PadFace& pad) const {
    const LinkId link = model_.FindLink(name);
    if (link.IsNone() || bodies_[static_cast<std::size_t>(link.index())] == 0) {
      model_.Fail(fmt::format("has no link '{}' that moves, for a pad", name),
                  "links of the two fingers");
    }
    if (pad.size.minCoeff() >= kLeastLength) return;
    model_.Fail(fmt::format("the pad of link '{}' is {:.3g} by {:.3g} mm", name, 1e3 * pad.size.x(),
                            1e3 * pad.size.y()),
                "at least 1 by 1 mm");
  }

  Finger FingerOf(std::size_t joint) const {
    const Joint& moves = model_.joints[joint];
    if (moves.type != JointType::kPrismatic) {
      throw InputError(moves.place, fmt::format("joint '{}' turns its finger", moves.name),
                       "fingers on prismatic joints");
    }
    Finger finger{.joint = &moves, .body = joint + 1};
    finger.axis = X_FlangeLink_[joint + 1].linear() * moves.axis;
    for (const auto& [name, pad] : in_file_.pads) {
      const auto index = static_cast<std::size_t>(model_.FindLink(name).index());
      if (bodies_[index] != finger.body) continue;
      finger.pad = X_FlangeLink_[index] * pad.center;
      finger.pad_size = pad.size;
      finger.pad_link = name;
      return finger;
    }
    throw InputError(moves.place, fmt::format("the finger of joint '{}' has no pad", moves.name),
                     "the key 'pads' of the workcell's gripper, with a face for each finger");
  }

  static double RangeOf(const Finger& finger) {
    return finger.joint->limits.upper - finger.joint->limits.lower;
  }

  // The pads are closed at that end of the ranges at which they are nearer to each other.
  void FindTool() {
    const double along = left_.axis.dot(right_.axis);
    if (std::abs(std::abs(along) - 1) > kAlignment) {
      model_.Fail("the fingers move along different lines", "opposite directions on one line");
    }
    const JointLimits& a = left_.joint->limits;
    const JointLimits& b = right_.joint->limits;
    const bool same_sign = along < 0;  // both joint values grow when the gripper opens, or shrink
    RequireMimicry(same_sign ? 1 : -1);
    const ClosedPads low = PadsAt(a.lower, same_sign ? b.lower : b.upper);
    const ClosedPads high = PadsAt(a.upper, same_sign ? b.upper : b.lower);
    closed_ = low.gap.norm() < high.gap.norm() ? low : high;
    const Vector3 opening = low.gap.norm() < high.gap.norm() ? left_.axis : Vector3(-left_.axis);
    RequireClosed(closed_.gap.dot(opening),
                  (closed_.gap - closed_.gap.dot(opening) * opening).norm());
    if ((left_.pad_size - right_.pad_size).norm() > kAlignment) {
      model_.Fail("the pads differ in size", "the same size");
    }
    SetTool(left_.pad + closed_.left * left_.axis, opening);
  }

  // A joint that mimics the other moves its finger the opposite way.
  void RequireMimicry(double multiplier) const {
    for (const auto& [joint, other] :
         {std::pair(left_.joint, right_.joint), std::pair(right_.joint, left_.joint)}) {
      if (joint->mimics.empty()) continue;
      if (joint->mimics == other->name && joint->multiplier == multiplier) continue;
      throw InputError(
          joint->place,
          fmt::format("joint '{}' mimics '{}' with the multiplier {:g}", joint->name, joint->mimics,
                      joint->multiplier),
          fmt::format("'{}' with {:g}, so that the fingers move in opposite directions",
                      other->name, multiplier));
    }
  }

  // `along` and `across` lead from one closed pad to the other, along the opening direction and
  // across it.
  void RequireClosed(double along, double across) const {
    if (std::min(RangeOf(left_), RangeOf(right_)) < kLeastLength) {
      model_.Fail("opens by less than 1 mm", "prismatic joints with larger ranges");
    }
    if (std::abs(along) <= kAlignment && across <= kAlignment) return;
    model_.Fail(fmt::format("the pads are {:.3f} mm {} and {:.3f} mm beside each other when the "
                            "gripper is closed",
                            1e3 * std::abs(along), along < 0 ? "through each other" : "apart",
                            1e3 * across),
                "pads whose centres then coincide: change them, or the limits of the joints");
  }

  ClosedPads PadsAt(double left, double right) const {
    return {left, right, left_.pad + left * left_.axis - right_.pad - right * right_.axis};
  }

  void SetTool(const Vector3& pads, const Vector3& opening) {
    Vector3 approach = Vector3::Zero();
    double most = 0;
    for (int i = 0; i < 6; ++i) {
      const Vector3 axis = (i < 3 ? 1 : -1) * Vector3::Unit(i % 3);
      if (std::abs(axis.dot(opening)) > kAlignment || axis.dot(pads) <= most) continue;
      most = axis.dot(pads);
      approach = axis;
    }
    if (most == 0) {
      model_.Fail("no axis of the flange leads to the pads and is normal to the closing direction",
                  "another link as the flange (key 'flange' of the workcell's gripper)");
    }
    const Vector3 y = (opening - opening.dot(approach) * approach).normalized();
    X_FlangeTool_.linear() << y.cross(approach), y, approach;
    X_FlangeTool_.translation() = pads;
  }

  // Returns the links of one body as one link, moved by `moved` in the flange's frame. Its shapes
  // for collision are boxes, which are named after their links.
  Link Body(const std::string& name, std::size_t body, const Pose& moved) const {
    Link link{.name = name, .place = model_.place};
    for (std::size_t i = 0; i < model_.links.size(); ++i) {
      if (bodies_[i] != body) continue;
      const std::size_t shapes = link.collisions.size();
      AddFixedLink(model_.links[i], moved * X_FlangeLink_[i], link);
      for (std::size_t k = shapes; k < link.collisions.size(); ++k) {
        Collision& shape = link.collisions[k];
        if (!std::holds_alternative<BoxShape>(shape.shape))
          shape = BoxOver(ExtentOf(shape, 1), 1, "");
        shape.name = model_.links[i].name;
      }
    }
    if (body != 0 && !link.inertial) {
      const Link& moves = model_.link(model_.joints[body - 1].child);
      throw InputError(moves.place, fmt::format("link '{}' has no mass", moves.name),
                       "an element 'inertial' in each finger");
    }
    return link;
  }

  // The finger's frame is the tool's when the gripper is closed. `side` is +1 for the left one.
  Link FingerBody(const std::string& name, const Finger& finger, double closed, double side) const {
    const Pose to_closed(Eigen::Translation3d(closed * finger.axis));
    Link link = Body(name, finger.body, X_FlangeTool_.inverse() * to_closed);
    RequireFingerBehindPad(link.collisions, side, finger, model_);
    std::vector<Collision> shapes;
    for (const Collision& shape : link.collisions) {
      auto cut = BehindPad(shape, side, model_);
      if (!cut) continue;
      cut->name.clear();
      shapes.push_back(std::move(*cut));
    }
    const Vector3 size(finger.pad_size.x(), kPadThickness, finger.pad_size.y());
    const Pose X_ToolPad(Eigen::Translation3d(0, side * kPadThickness / 2, 0));
    shapes.push_back({"pad", X_ToolPad, BoxShape{size}});
    link.collisions = std::move(shapes);
    return link;
  }

  const RobotModel& model_;
  const GripperInFile& in_file_;
  std::vector<Pose> X_FlangeLink_;   // by LinkId, at joint values 0
  std::vector<std::size_t> bodies_;  // by LinkId: 0 if it does not move, or its joint, from 1 on
  Finger left_;
  Finger right_;
  ClosedPads closed_;
  Pose X_FlangeTool_ = Pose::Identity();
};

}  // namespace

RobotModel ParallelGripperModel(const RobotModel& model, const GripperInFile& gripper) {
  return ParallelGripper(model, gripper).Build();
}

}  // namespace assay::kinematics
