#include "planner/domain/workcell/robot_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "planner/domain/problem/name.h"
#include "planner/domain/workcell/servo_file.h"
#include "planner/kinematics/dynamics/servo_tuning.h"

namespace assay::domain {
namespace {

using kinematics::JointVector;

// Returns the servo gains in the file beside a URDF file: ur5e.servos.yaml beside ur5e.urdf. If
// there is no such file, the gains are derived.
kinematics::ArmServos ServosBeside(std::filesystem::path urdf, const Robot& robot,
                                   const kinematics::LockedJoints& locked) {
  const auto derive = [&] { return TunedServos(kinematics::LoadsOf(*robot.arm, *robot.gripper)); };
  const std::filesystem::path file = urdf.replace_extension(".servos.yaml");
  std::error_code error;
  const bool is_there = std::filesystem::exists(file, error) || error;
  return is_there ? ReadServos(file, *robot.arm, locked, derive) : derive();
}

// Reads robots. The paths in their descriptions are relative to one folder.
class RobotFile {
 public:
  RobotFile(const Units& units, const std::filesystem::path& folder)
      : units_(units), folder_(folder) {}

  Robot Read(const std::string& name, const Value& robot, const Value& gripper) const;

 private:
  kinematics::ArmInFile ReadArm(const Value& robot) const;
  kinematics::GripperInFile ReadGripper(const Value& gripper) const;
  std::vector<std::filesystem::path> ReadPackages(const Value& model) const;
  JointVector ReadJoints(const Value& value) const;
  JointVector ReadHome(const Value& home, const kinematics::Arm& arm) const;
  JointVector ReadAcceleration(const Value& acceleration) const;
  std::filesystem::path Beside(const Value& path) const;

  const Units& units_;
  const std::filesystem::path& folder_;
};

Robot RobotFile::Read(const std::string& name, const Value& robot, const Value& gripper) const {
  gripper.AllowOnly({"urdf", "flange", "pads", "packages"});
  Robot read;
  read.name = name;
  read.gripper_in_file = ReadGripper(gripper);
  const kinematics::ArmInFile arm = ReadArm(robot);
  read.arm = std::make_shared<const kinematics::Arm>(
      kinematics::Arm::FromUrdf(Beside(robot.At("urdf")), arm, ReadPackages(robot)));
  read.gripper = std::make_shared<const kinematics::Gripper>(
      kinematics::Gripper::FromUrdf(read.gripper_in_file, ReadPackages(gripper)));
  const Value base = robot.At("base");
  base.AllowOnly({"columns"});
  read.X_WorldBase = ReadColumns(base.At("columns"), units_);
  read.home = ReadHome(robot.At("home"), *read.arm);
  read.joint_acceleration = ReadAcceleration(robot.At("acceleration"));
  read.servos = ServosBeside(Beside(robot.At("urdf")), read, arm.locked);
  return read;
}

kinematics::ArmInFile RobotFile::ReadArm(const Value& robot) const {
  kinematics::ArmInFile arm;
  if (const auto links = robot.Find("links")) {
    links->AllowOnly({"base", "flange"});
    if (const auto base = links->Find("base")) arm.base = base->Text();
    if (const auto flange = links->Find("flange")) arm.flange = flange->Text();
  }
  if (const auto locked = robot.Find("locked")) {
    for (const auto& [joint, value] : locked->Entries()) {
      arm.locked[joint.Text()] = value.Number() * units_.angle.factor;
    }
  }
  return arm;
}

kinematics::GripperInFile RobotFile::ReadGripper(const Value& gripper) const {
  kinematics::GripperInFile read{.file = Beside(gripper.At("urdf"))};
  if (const auto flange = gripper.Find("flange")) read.flange = flange->Text();
  const std::optional<Value> pads = gripper.Find("pads");
  if (!pads) return read;
  for (const auto& [link, pad] : pads->Entries()) {
    pad.AllowOnly({"center", "size"});
    const std::vector<double> center = pad.At("center").Numbers(3);
    const std::vector<double> size = pad.At("size").Numbers(2);
    if (!(size[0] > 0 && size[1] > 0)) {
      pad.At("size").Fail(fmt::format("a pad of {} by {}", size[0], size[1]), "positive lengths");
    }
    read.pads[link.Text()] = {
        .center = units_.length.factor * geometry::Vector3(center[0], center[1], center[2]),
        .size = units_.length.factor * geometry::Vector2(size[0], size[1])};
  }
  return read;
}

// Reads the folders in which the packages of the meshes of an arm or a gripper lie.
std::vector<std::filesystem::path> RobotFile::ReadPackages(const Value& model) const {
  std::vector<std::filesystem::path> folders;
  const std::optional<Value> packages = model.Find("packages");
  if (!packages) return folders;
  for (const Value& path : packages->Items()) {
    folders.push_back((folder_ / path.Text()).lexically_normal());
    std::error_code error;
    if (!std::filesystem::is_directory(folders.back(), error)) {
      path.Fail(fmt::format("there is no folder '{}'", path.Text()),
                "a path from the workcell's folder");
    }
  }
  return folders;
}

JointVector RobotFile::ReadJoints(const Value& value) const {
  const std::vector<double> joints = value.Numbers(6);
  return units_.angle.factor * Eigen::Map<const JointVector>(joints.data());
}

JointVector RobotFile::ReadHome(const Value& home, const kinematics::Arm& arm) const {
  const JointVector q = ReadJoints(home);
  if (arm.InRange(q)) return q;
  std::vector<std::string> joints;
  for (const kinematics::JointLimits& limits : arm.limits()) {
    joints.push_back(InUnit(Range{limits.lower, limits.upper}, units_.angle));
  }
  home.Fail("the arm's home is outside the joint limits",
            fmt::format("for joints 1 to 6: {}", fmt::join(joints, ", ")));
}

JointVector RobotFile::ReadAcceleration(const Value& acceleration) const {
  const JointVector greatest = ReadJoints(acceleration);
  if (greatest.minCoeff() <= 0) {
    acceleration.Fail(fmt::format("a joint acceleration of {}/s^2, which is not positive",
                                  InUnit(greatest.minCoeff(), units_.angle)),
                      fmt::format("six numbers above 0 {}/s^2", units_.angle.name));
  }
  return greatest;
}

std::filesystem::path RobotFile::Beside(const Value& path) const {
  const std::filesystem::path file = (folder_ / path.Text()).lexically_normal();
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) {
    path.Fail(fmt::format("there is no file '{}'", path.Text()),
              "a path from the workcell's folder");
  }
  return file;
}

}  // namespace

std::vector<Robot> ReadRobots(const Value& workcell, const Units& units,
                              const std::filesystem::path& folder) {
  const RobotFile file(units, folder);
  const std::optional<Value> robots = workcell.Find("robots");
  if (!robots) {
    const Value robot = workcell.At("robot");
    robot.AllowOnly({"urdf", "links", "locked", "packages", "base", "home", "acceleration"});
    return {file.Read("", robot, workcell.At("gripper"))};
  }
  workcell.AllowOnly({"format", "description", "units", "robots", "table", "tables", "rules",
                      "placements", "places", "sensors", "verifications", "recoveries"});
  std::vector<Robot> read;
  for (const auto& [key, robot] : robots->Entries()) {
    robot.AllowOnly(
        {"urdf", "links", "locked", "packages", "base", "home", "acceleration", "gripper"});
    read.push_back(file.Read(ReadName(key, "a robot"), robot, robot.At("gripper")));
  }
  if (read.empty()) robots->Fail("no robots", "one or more, by their names");
  return read;
}

}  // namespace assay::domain
