#include "sim/scene/robot_mjcf.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <variant>

#include "planner/base/check.h"
#include "planner/geometry/hull.h"
#include "planner/geometry/pose.h"
#include "sim/scene/piece_mjcf.h"

namespace assay::scene {
namespace {

using domain::Robot;
using kinematics::Joint;
using kinematics::JointType;
using kinematics::Link;
using kinematics::LinkId;
using kinematics::RobotModel;

// The fingers are fast enough to close in a second. They are slow enough that a light part does not
// coast away when one finger meets it first (v^2 / (2 mu g) = 0.3 mm at friction 0.25).
constexpr double kFingerSpeed = 0.04;       // m/s, the speed under the grip force
constexpr double kFingerStiffness = 4e4;    // N/m, up to the grip force
constexpr double kFingerArmature = 0.5;     // kg, the inertia of the drive
constexpr double kFingerFriction = 0.2;     // coefficient of the fingers' steel and of the hand
constexpr double kTorsionOfFinger = 0.005;  // m

// The contacts of pads are overdamped, and their impedance does not depend on the depth. With a
// damping ratio of 1, as other contacts have, the contacts of the two pads took turns from timestep
// to timestep if their friction was low. The friction of each was used up in turn, and the part
// slid down by half a millimetre a second, although friction could bear 1.4 times its weight. With
// a damping ratio of 1 and this impedance, pads jumped by 60 micrometres now and then.
constexpr char kSolrefOfPad[] = "0.0001 4";
constexpr double kDepthOfImpedance = 0.00001;  // metres; the engine requires it
// The engine makes contacts softer, the lighter the bodies that touch. One less the impedance is
// therefore proportional to the mass of the lightest part, up to the engine's
// greatest impedance of 0.9999, which parts of 10 g reach. Otherwise pads would sink by tens of
// micrometres into a part of 20 g, and would leave it turned by a hundredth of a degree.
double ImpedanceOfPad(double lightest_part) {
  constexpr double kSoftnessPerMass = 0.01;  // 1/kg
  return 1 - std::clamp(kSoftnessPerMass * lightest_part, 0.0001, 0.002);
}

// Returns the inertia of a joint whose damper acts on the velocity at the end of each timestep.
//
// A damper that is stiffer than the timestep allows must be integrated implicitly: the force at the
// end of the timestep, -D (v + h a), has the part -h D a, which is that of an inertia h D. The
// engine's own damping of joints does the same, but only after it has computed the forces of the
// contacts. Its contacts therefore expect that the hand gives way more than it does. The contacts
// of both pads of a light part then took turns from timestep to timestep, used up their friction,
// and the part turned in the hand, although friction could bear 1.5 times its load.
double DampedInertia(double armature, double damping, double timestep) {
  return armature + timestep * damping;
}

constexpr std::array kFingers = {"finger_left", "finger_right"};

// Writes a shape into a geom, except its pose.
struct ShapeWriter {
  XmlElement& geom;

  void operator()(const kinematics::BoxShape& box) const {
    geom.Set("type", "box").Set("size", geometry::Vector3(box.size / 2));
  }
  void operator()(const kinematics::CylinderShape& cylinder) const {
    geom.Set("type", "cylinder").Set("size", {cylinder.radius, cylinder.length / 2});
  }
  void operator()(const kinematics::SphereShape& sphere) const {
    geom.Set("type", "sphere").Set("size", {sphere.radius});
  }
  void operator()(const kinematics::HullShape& /*hull*/) const {
    ASSAY_CHECK(false, "a hull is written as a piece");
  }
};

// A shape of a link, and the class of its geom.
struct LinkShape {
  const kinematics::Shape& shape;
  const geometry::Pose& X_LinkShape;
  std::string geom_class;
};

// Adds the inertia in the link's axes, because the engine accepts a full matrix only if no
// orientation is given.
void AddInertial(const kinematics::Inertial& inertial, XmlElement& body) {
  const geometry::Matrix3 R = inertial.X_LinkCenter.linear();
  const geometry::Matrix3 I = R * inertial.inertia * R.transpose();
  body.Add("inertial")
      .Set("pos", geometry::Vector3(inertial.X_LinkCenter.translation()))
      .Set("mass", inertial.mass)
      .Set("fullinertia", {I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2), I(1, 2)});
}

void AddPad(const kinematics::Collision& pad, const std::string& geom_class,
            const GripperRules& rules, XmlElement& body) {
  const geometry::Vector3 size = std::get<kinematics::BoxShape>(pad.shape).size;
  const double n = rules.pad_tiles;
  const double impedance = ImpedanceOfPad(rules.lightest_part);
  const geometry::Vector3 tile(size.x() / n, size.y(), size.z() / n);
  for (int i = 0; i < rules.pad_tiles; ++i) {
    for (int j = 0; j < rules.pad_tiles; ++j) {
      const geometry::Vector3 middle((i + 0.5) * tile.x() - size.x() / 2, 0,
                                     (j + 0.5) * tile.z() - size.z() / 2);
      // The priority makes the pad's friction, stiffness and damping count. Without it the engine
      // would take the greater friction, which is the part's.
      body.Add("geom")
          .Set("class", geom_class)
          .Set("type", "box")
          .Set("size", geometry::Vector3(tile / 2))
          .SetPose(pad.X_LinkShape * geometry::Translation(middle))
          .Set("priority", "1")
          .Set("friction", {rules.pad_friction, kTorsionOfFinger, 0.0001})
          .Set("solref", kSolrefOfPad)
          .Set("solimp", {impedance, impedance, kDepthOfImpedance});
    }
  }
}

// Adds a robot's arm or gripper link by link. Names get a prefix, because arm and gripper may use
// the same names.
class RobotWriter {
 public:
  RobotWriter(const Robot& robot, const RobotModel& model, const std::string& prefix,
              const GripperRules& rules, XmlElement& asset)
      : model_(model),
        prefix_(robot.Prefix() + prefix),
        collision_class_(CollisionClass(robot)),
        rules_(rules),
        asset_(asset) {}

  XmlElement& AddRoot(const geometry::Pose& X_ParentRoot, XmlElement& parent) const {
    return AddLink(model_.links.front(), X_ParentRoot, parent);
  }

  // Adds the body of the link that `joint` moves.
  XmlElement& AddMoved(const Joint& joint, XmlElement& parent) const {
    return AddLink(model_.link(joint.child), joint.X_ParentJoint, parent);
  }

  XmlElement& AddJoint(const Joint& joint, XmlElement& body) const {
    return body.Add("joint")
        .Set("name", prefix_ + joint.name)
        .Set("type", joint.type == JointType::kPrismatic ? "slide" : "hinge")
        .Set("axis", joint.axis)
        .Set("limited", "true")
        .Set("range", {joint.limits.lower, joint.limits.upper});
  }

  const Joint& Find(std::string_view joint) const {
    const kinematics::JointId id = model_.FindJoint(joint);
    ASSAY_CHECK(!id.IsNone(), "{} has no joint '{}'", model_.name, joint);
    return model_.joint(id);
  }

 private:
  XmlElement& AddLink(const Link& link, const geometry::Pose& X_ParentLink,
                      XmlElement& parent) const {
    XmlElement& body = parent.Add("body").Set("name", prefix_ + link.name).SetPose(X_ParentLink);
    if (link.inertial) AddInertial(*link.inertial, body);
    AddVisuals(link, body);
    AddCollisions(link, body);
    return body;
  }

  // Draws the collision shapes of a link whose meshes for drawing were not read.
  void AddVisuals(const Link& link, XmlElement& body) const {
    for (const kinematics::Visual& visual : link.visuals) {
      AddDrawn(link, {visual.shape, visual.X_LinkShape, "visual"}, visual.color, body);
    }
    if (!link.visuals.empty() || link.meshes.empty()) return;
    for (const kinematics::Collision& collision : link.collisions) {
      AddDrawn(link, {collision.shape, collision.X_LinkShape, "visual"}, {}, body);
    }
  }

  void AddDrawn(const Link& link, const LinkShape& shape, const kinematics::Rgba& color,
                XmlElement& body) const {
    AddShape(link, shape, body).Set("rgba", {color.red, color.green, color.blue, color.alpha});
  }

  void AddCollisions(const Link& link, XmlElement& body) const {
    for (const kinematics::Collision& collision : link.collisions) {
      if (collision.name == "pad") {
        AddPad(collision, collision_class_, rules_, body);
        continue;
      }
      AddShape(link, {collision.shape, collision.X_LinkShape, collision_class_}, body)
          .Set("friction", {kFingerFriction, kTorsionOfFinger, 0.0001});
    }
  }

  XmlElement& AddShape(const Link& link, const LinkShape& shape, XmlElement& body) const {
    if (const auto* mesh = std::get_if<kinematics::HullShape>(&shape.shape)) {
      const std::string name =
          fmt::format("{}{}/{}/{}", prefix_, link.name, shape.geom_class, hulls_++);
      return AddPiece(Transformed(*mesh->hull, shape.X_LinkShape), shape.geom_class, name, body,
                      asset_);
    }
    XmlElement& geom = body.Add("geom").Set("class", shape.geom_class);
    std::visit(ShapeWriter{geom}, shape.shape);
    return geom.SetPose(shape.X_LinkShape);
  }

  const RobotModel& model_;
  std::string prefix_;
  std::string collision_class_;
  const GripperRules& rules_;
  XmlElement& asset_;
  mutable int hulls_ = 0;  // the number of those that were added
};

// Returns the damping of a finger in N s/m.
double FingerDamping(const GripperRules& rules) { return rules.grip_force / kFingerSpeed; }

void AddGripper(const Robot& robot, const GripperRules& rules, double timestep, XmlElement& asset,
                XmlElement& flange) {
  const RobotModel& model = robot.gripper->model();
  const RobotWriter writer(robot, model, "gripper/", rules, asset);
  XmlElement& hand = writer.AddRoot(geometry::Pose::Identity(), flange);
  hand.Add("site").Set("name", robot.Prefix() + "wrist").Set("class", "mark");
  hand.Add("site")
      .Set("name", robot.Prefix() + "tool")
      .Set("class", "mark")
      .SetPose(robot.gripper->X_FlangeTool());
  for (const char* name : kFingers) {
    const Joint& joint = writer.Find(name);
    XmlElement& finger = writer.AddMoved(joint, hand);
    writer.AddJoint(joint, finger)
        .Set("armature", DampedInertia(kFingerArmature, FingerDamping(rules), timestep));
  }
}

void AddDamper(const std::string& joint, double damping, XmlElement& tendon) {
  XmlElement& damper = tendon.Add("fixed").Set("name", joint).Set("damping", damping);
  damper.Add("joint").Set("joint", joint).Set("coef", 1);
}

void AddServo(const std::string& joint, double stiffness, XmlElement& general) {
  general.Set("name", joint)
      .Set("joint", joint)
      .Set("gainprm", stiffness)
      .Set("biastype", "affine")
      .Set("biasprm", {0, -stiffness, 0});
}

}  // namespace

std::string CollisionClass(const Robot& robot) { return robot.Prefix() + "collision"; }

void AddRobot(const Robot& robot, const GripperRules& rules, double timestep, XmlElement& asset,
              XmlElement& worldbody) {
  const RobotModel& model = robot.arm->model();
  const RobotWriter writer(robot, model, "arm/", rules, asset);
  XmlElement* body = &writer.AddRoot(robot.X_WorldBase, worldbody);
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const kinematics::ServoGains& servo = robot.servos[i];
    body = &writer.AddMoved(model.joints[i], *body);
    writer.AddJoint(model.joints[i], *body)
        .Set("armature", DampedInertia(servo.armature, servo.damping, timestep));
  }
  AddGripper(robot, rules, timestep, asset, *body);
}

void AddDampers(const Robot& robot, const GripperRules& rules, XmlElement& tendon) {
  const RobotModel& model = robot.arm->model();
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    AddDamper(robot.Prefix() + "arm/" + model.joints[i].name, robot.servos[i].damping, tendon);
  }
  for (const char* name : kFingers) {
    AddDamper(robot.Prefix() + "gripper/" + name, FingerDamping(rules), tendon);
  }
}

void AddFingerCoupling(const Robot& robot, XmlElement& equality) {
  const std::string prefix = robot.Prefix() + "gripper/";
  equality.Add("joint")
      .Set("name", prefix + "coupling")
      .Set("joint1", prefix + kFingers[0])
      .Set("joint2", prefix + kFingers[1])
      .Set("polycoef", {0, 1, 0, 0, 0});
}

void AddServos(const Robot& robot, const GripperRules& rules, XmlElement& actuator) {
  const RobotModel& model = robot.arm->model();
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    AddServo(robot.Prefix() + "arm/" + model.joints[i].name, robot.servos[i].stiffness,
             actuator.Add("general"));
  }
  for (const char* name : kFingers) {
    XmlElement& general = actuator.Add("general");
    AddServo(robot.Prefix() + "gripper/" + name, kFingerStiffness, general);
    general.Set("forcelimited", "true").Set("forcerange", {-rules.grip_force, rules.grip_force});
  }
}

void AddWristSensors(const Robot& robot, XmlElement& sensor) {
  const std::string wrist = robot.Prefix() + "wrist";
  sensor.Add("force").Set("name", wrist + "/force").Set("site", wrist);
  sensor.Add("torque").Set("name", wrist + "/torque").Set("site", wrist);
}

}  // namespace assay::scene
