#include "planner/domain/workcell/robot_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "planner/domain/problem/name.h"

namespace assay::domain {
namespace {

using kinematics::JointVector;

// Reads robots. The paths in their descriptions are relative to one folder.
class RobotFile {
 public:
  RobotFile(const Units& units, const std::filesystem::path& folder)
      : units_(units), folder_(folder) {}

  Robot Read(const std::string& name, const Value& robot, const Value& gripper) const;

 private:
  static kinematics::ArmEnds ReadEnds(const Value& robot);
  std::vector<std::filesystem::path> ReadPackages(const Value& robot) const;
  JointVector ReadJoints(const Value& value) const;
  JointVector ReadHome(const Value& home, const kinematics::Arm& arm) const;
  JointVector ReadAcceleration(const Value& acceleration) const;
  std::filesystem::path Beside(const Value& path) const;

  const Units& units_;
  const std::filesystem::path& folder_;
};

Robot RobotFile::Read(const std::string& name, const Value& robot, const Value& gripper) const {
  gripper.AllowOnly({"urdf"});
  Robot read;
  read.name = name;
  read.gripper_file = Beside(gripper.At("urdf"));
  read.arm = std::make_shared<const kinematics::Arm>(
      kinematics::Arm::FromUrdf(Beside(robot.At("urdf")), ReadEnds(robot), ReadPackages(robot)));
  read.gripper =
      std::make_shared<const kinematics::Gripper>(kinematics::Gripper::FromUrdf(read.gripper_file));
  const Value base = robot.At("base");
  base.AllowOnly({"columns"});
  read.X_WorldBase = ReadColumns(base.At("columns"), units_);
  read.home = ReadHome(robot.At("home"), *read.arm);
  read.joint_acceleration = ReadAcceleration(robot.At("acceleration"));
  return read;
}

kinematics::ArmEnds RobotFile::ReadEnds(const Value& robot) {
  const std::optional<Value> links = robot.Find("links");
  if (!links) return {};
  links->AllowOnly({"base", "flange"});
  const auto name = [&](const char* key) {
    const std::optional<Value> link = links->Find(key);
    return link ? link->Text() : std::string();
  };
  return {name("base"), name("flange")};
}

// Reads the folders in which the packages of a robot's meshes lie.
std::vector<std::filesystem::path> RobotFile::ReadPackages(const Value& robot) const {
  std::vector<std::filesystem::path> folders;
  const std::optional<Value> packages = robot.Find("packages");
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
    robot.AllowOnly({"urdf", "links", "packages", "base", "home", "acceleration"});
    return {file.Read("", robot, workcell.At("gripper"))};
  }
  workcell.AllowOnly({"format", "description", "units", "robots", "table", "tables", "rules",
                      "placements", "places", "sensors", "verifications", "recoveries"});
  std::vector<Robot> read;
  for (const auto& [key, robot] : robots->Entries()) {
    robot.AllowOnly({"urdf", "links", "packages", "base", "home", "acceleration", "gripper"});
    read.push_back(file.Read(ReadName(key, "a robot"), robot, robot.At("gripper")));
  }
  if (read.empty()) robots->Fail("no robots", "one or more, by their names");
  return read;
}

}  // namespace assay::domain
