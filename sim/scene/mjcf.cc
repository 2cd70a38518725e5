#include "sim/scene/mjcf.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <vector>

#include "planner/domain/parts/part_file.h"
#include "planner/geometry/hull.h"
#include "planner/geometry/solids/mass_properties.h"
#include "sim/scene/piece_mjcf.h"
#include "sim/scene/robot_mjcf.h"
#include "sim/scene/stage_mjcf.h"
#include "sim/scene/supporting_solids.h"
#include "sim/scene/xml_element.h"

namespace assay::scene {
namespace {

using domain::Part;
using domain::Problem;
using domain::Robot;

// Contacts are as stiff as the timestep allows, because the engine raises the time constant to two
// timesteps. With a timestep of 0.5 ms a part of 1 kg sinks in by less than a micrometre. A longer
// time constant would also let held parts slip. The engine leaves the centripetal acceleration
// J' qd of the hand out of its constraints. Contacts therefore follow the hand with a velocity
// error of J' qd / b, where b = 2 / time constant. mujoco::Data::Step removes only half a timestep
// of it.
constexpr char kSolref[] = "0.0001 1";
constexpr char kSolimp[] = "0.99 0.9999 0.00001";
// The ground's friction is much smaller than that of every part, because the engine takes the
// larger of two frictions.
constexpr double kGroundFriction = 0.01;
// The engine's defaults. They have no effect on the contacts of parts and pads, which have neither
// torsional nor rolling friction.
constexpr double kTorsionFriction = 0.005;
constexpr double kRollFriction = 0.0001;

// Thinner pieces are seams between other pieces of a part (domain::PartFile), and the engine would
// find contacts with their sides. Nothing gets into a gap as narrow as this.
constexpr double kThinnestPiece = 1e-5;  // metres

// Elliptic cones with a high ratio of friction to normal impedance keep a grasp from creeping. A
// part that the pads touch at an edge still creeps by 100 microradians a second. With a ratio of 30
// or more it does not, but a shaft that should wedge in its hole then slides on.
// Newton's method converges to the tolerance in a few iterations.
void AddOption(const SceneOptions& options, XmlElement& mujoco) {
  mujoco.Add("option")
      .Set("timestep", options.timestep)
      .Set("integrator", "Euler")
      .Set("solver", "Newton")
      .Set("iterations", "50")
      .Set("tolerance", 1e-10)
      .Set("cone", "elliptic")
      .Set("impratio", 10);
  mujoco.Add("size").Set("njmax", "1000").Set("nconmax", "300");
}

XmlElement& AddGeomClass(const char* name, XmlElement& defaults) {
  return defaults.Add("default").Set("class", name).Add("geom");
}

// Collision bits: each geom has bits for what it is and a mask of the bits that it touches. A part
// has two sets of solids. Its exact pieces touch other parts and grippers. Its supporting solids
// touch the floor and a table that exists for this part alone, because the error of the table's
// height may differ from part to part. Arm links have the gripper's bit. Bodies of one robot do not
// touch each other, but bodies of two robots do.
constexpr int kPart = 1;
constexpr int kGripper = 2;
constexpr int kFloor = 4;
constexpr int kSupport = 8;
// The bit of the first table on which a single part stands. Each further table of this kind has the
// next higher bit.
constexpr int kFirstTable = 16;

int TableBit(domain::PartId part) {
  const auto index = static_cast<std::size_t>(part.index());
  return kFirstTable << static_cast<int>(std::min(index, kMostPartTables - 1));
}

// The bit of the first robot, if there are several. Each further robot has the next higher bit.
constexpr int kFirstRobot = kFirstTable << kMostPartTables;
constexpr int kMostRobots = 4;

int RobotBit(int robot) { return kFirstRobot << std::min(robot, kMostRobots - 1); }

XmlElement& AddTouchingClass(const char* name, int is, int touches, XmlElement& defaults) {
  return AddGeomClass(name, defaults)
      .Set("contype", fmt::format("{}", is))
      .Set("conaffinity", fmt::format("{}", touches));
}

// Shapes that serve only for collision are in group 3, which is not drawn.
void AddRobotClasses(const std::vector<domain::Robot>& robots, XmlElement& defaults) {
  const int count = static_cast<int>(robots.size());
  int all = 0;
  for (int i = 0; i < count && count > 1; ++i) all |= RobotBit(i);
  for (int i = 0; i < count; ++i) {
    const int own = RobotBit(i) & all;
    AddTouchingClass(CollisionClass(robots[i]).c_str(), kGripper | own,
                     kPart | kFloor | (all - own), defaults)
        .Set("group", "3");
  }
}

void AddTouchingClasses(const std::vector<domain::Robot>& robots, XmlElement& defaults) {
  AddRobotClasses(robots, defaults);
  AddTouchingClass("part", kPart, kPart | kGripper, defaults)
      .Set("type", "box")
      .Set("material", "part");
  AddTouchingClass("support", kSupport, kFloor, defaults).Set("type", "box").Set("group", "3");
  AddTouchingClass("table", 0, kGripper, defaults)
      .Set("type", "box")
      .Set("material", "table")
      .Set("friction", {kGroundFriction, kTorsionFriction, kRollFriction});
  AddTouchingClass("floor", kFloor, kGripper | kSupport, defaults)
      .Set("type", "plane")
      .Set("size", "20 20 1")
      .Set("material", "floor")
      .Set("friction", {kGroundFriction, kTorsionFriction, kRollFriction});
}

void AddDefaults(const std::vector<domain::Robot>& robots, XmlElement& mujoco) {
  XmlElement& defaults = mujoco.Add("default");
  defaults.Add("geom").Set("solref", kSolref).Set("solimp", kSolimp).Set("condim", "3");
  defaults.Add("equality").Set("solref", kSolref).Set("solimp", kSolimp);
  AddTouchingClass("visual", 0, 0, defaults).Set("material", "paint");
  AddTouchingClasses(robots, defaults);
  defaults.Add("default").Set("class", "mark").Add("site").Set("group", "4").Set("size", "0.005");
}

double TrueFriction(double said, double error) { return std::max(0.0, said + error); }

std::shared_ptr<const domain::PartModel> TrueModel(const Part& part, const SceneOptions& options) {
  if (options.clearance_error == 0) return part.model;
  return domain::PartFile::WithClearance(*part.model,
                                         part.model->clearance() + options.clearance_error);
}

geometry::MassProperties TrueMass(const domain::PartModel& model, domain::PartId part,
                                  const SceneOptions& options) {
  geometry::MassProperties mass = model.mass();
  const auto found = options.part_masses.find(part);
  if (found == options.part_masses.end()) return mass;
  mass.inertia *= found->second / mass.mass;
  mass.mass = found->second;
  return mass;
}

Eigen::Vector4d ColorOf(const Problem& problem, domain::PartId part, std::size_t box,
                        const SceneOptions& options) {
  const auto given = options.part_colors.find(part);
  if (given != options.part_colors.end()) return given->second;
  return problem.part(part).model->colors()[box].cast<double>();
}

void AddPart(const Problem& problem, domain::PartId id, const SceneOptions& options,
             XmlElement& asset, XmlElement& worldbody) {
  const Part& part = problem.part(id);
  const std::shared_ptr<const domain::PartModel> true_model = TrueModel(part, options);
  const domain::PartModel& model = *true_model;
  const double friction =
      TrueFriction(options.part_friction.value_or(model.friction()), options.friction_error);
  XmlElement& body =
      worldbody.Add("body").Set("name", "part/" + part.name).SetPose(part.X_WorldPart);
  body.Add("freejoint").Set("name", "part/" + part.name);
  AddMass(TrueMass(model, id, options), body);
  const auto add_solid = [&](const char* geom_class, std::size_t number,
                             const geometry::ConvexHull& solid) -> XmlElement& {
    const std::string name = fmt::format("part/{}/{}/{}", part.name, geom_class, number);
    return AddPiece(solid, geom_class, name, body, asset)
        .Set("friction", {friction, kTorsionFriction, kRollFriction});
  };
  for (std::size_t i = 0; i < model.pieces().size(); ++i) {
    if (geometry::ThicknessOf(model.pieces()[i]) < kThinnestPiece) continue;
    const Eigen::Vector4d color = ColorOf(problem, id, i, options);
    add_solid("part", i, model.pieces()[i]).Set("rgba", std::span(color.data(), 4));
  }
  const std::vector<geometry::ConvexHull> supports = SupportingSolids(model.pieces(), model.hull());
  for (std::size_t i = 0; i < supports.size(); ++i) {
    add_solid("support", i, supports[i])
        .Set("conaffinity", fmt::format("{}", kFloor | TableBit(id)));
  }
}

void AddWelds(const Problem& problem, const domain::Robot& robot, XmlElement& equality) {
  for (const Part& part : problem.parts) {
    equality.Add("weld")
        .Set("name", robot.Prefix() + "weld/" + part.name)
        .Set("body1", robot.Prefix() + "gripper/hand")
        .Set("body2", "part/" + part.name)
        .Set("active", "false");
  }
}

void Append(const kinematics::JointVector& q, const Robot& robot, std::vector<double>& values) {
  values.insert(values.end(), q.begin(), q.end());
  values.insert(values.end(), 2, robot.gripper->max_opening() / 2);
}

void Append(const geometry::Pose& X_WorldPart, std::vector<double>& values) {
  const geometry::Vector3 p = X_WorldPart.translation();
  const Eigen::Quaterniond turn(X_WorldPart.linear());
  values.insert(values.end(), {p.x(), p.y(), p.z(), turn.w(), turn.x(), turn.y(), turn.z()});
}

// Adds the key frame with all arms at their homes, grippers open, and parts at their initial poses.
// The values are in the order in which bodies and servos were added to the model.
void AddHome(const Problem& problem, XmlElement& keyframe) {
  std::vector<double> qpos;
  for (const Robot& robot : problem.workcell->robots()) Append(robot.home, robot, qpos);
  const std::vector<double> ctrl = qpos;
  for (const Part& part : problem.parts) Append(part.X_WorldPart, qpos);
  keyframe.Add("key").Set("name", "home").Set("qpos", qpos).Set("ctrl", ctrl);
}

double LightestMass(const Problem& problem) {
  double lightest = std::numeric_limits<double>::infinity();
  for (const Part& part : problem.parts) lightest = std::min(lightest, part.model->mass().mass);
  return lightest;
}

}  // namespace

std::string_view Name(GraspMode mode) {
  switch (mode) {
    case GraspMode::kFriction:
      return "friction";
    case GraspMode::kWeld:
      return "weld";
  }
  return {};
}

std::string ToMjcf(const Problem& problem, const SceneOptions& options) {
  XmlElement mujoco("mujoco");
  mujoco.Set("model", problem.name);
  mujoco.Add("compiler").Set("angle", "radian").Set("inertiafromgeom", "false");
  AddOption(options, mujoco);
  AddVisualSettings(problem, options.light, mujoco);
  const std::vector<domain::Robot>& robots = problem.workcell->robots();
  AddDefaults(robots, mujoco);
  XmlElement& asset = mujoco.Add("asset");
  AddMaterials(asset);
  XmlElement& worldbody = mujoco.Add("worldbody");
  AddStage(problem, options.light, worldbody);
  const domain::WorkcellRules& rules = problem.workcell->rules();
  const bool welds = options.grasp == GraspMode::kWeld;
  const GripperRules gripper = {
      .grip_force = rules.grip_force,
      .pad_friction = TrueFriction(rules.pad_friction, options.pad_friction_error),
      // A weld carries the load of the pads. Stiffer or more contacts would only press against it.
      .lightest_part = welds ? 1 : LightestMass(problem),
      .pad_tiles = welds ? 1 : 2};
  for (const domain::Robot& robot : robots)
    AddRobot(robot, gripper, options.timestep, asset, worldbody);
  for (std::size_t i = 0; i < problem.parts.size(); ++i) {
    const domain::PartId part(i);
    AddPartTables(problem, {part, TableBit(part), options.endless_tables}, worldbody);
    AddPart(problem, part, options, asset, worldbody);
  }
  XmlElement& equality = mujoco.Add("equality");
  for (const domain::Robot& robot : robots) {
    AddFingerCoupling(robot, equality);
    if (welds) AddWelds(problem, robot, equality);
  }
  XmlElement& tendon = mujoco.Add("tendon");
  for (const domain::Robot& robot : robots) AddDampers(robot, gripper, tendon);
  XmlElement& actuator = mujoco.Add("actuator");
  for (const domain::Robot& robot : robots) AddServos(robot, gripper, actuator);
  XmlElement& sensor = mujoco.Add("sensor");
  for (const domain::Robot& robot : robots) AddWristSensors(robot, sensor);
  AddHome(problem, mujoco.Add("keyframe"));
  return mujoco.Text();
}

}  // namespace assay::scene
