#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "planner/base/input_files/input_error.h"
#include "planner/domain/workcell/servo_file.h"
#include "planner/kinematics/dynamics/servo_tuning.h"
#include "sim/cli/command_line/console.h"
#include "sim/cli/command_line/verb.h"
#include "sim/cli/options/arm_options.h"
#include "sim/cli/plan_output/table.h"
#include "sim/cli/tasks/output_file.h"
#include "sim/scenario/models_folder.h"

namespace assay::cli {
namespace tune_verb {

namespace fs = std::filesystem;
using kinematics::Arm;
using kinematics::ArmServos;
using kinematics::Gripper;

struct Options : ArmOptions {
  fs::path robot;    // a URDF file
  fs::path gripper;  // a URDF file; empty for the gripper that comes with the program
  fs::path output;
};

// Reads the arm. Of seven joints, the one that is best to lock is locked.
Arm ReadArm(const Options& options) {
  const kinematics::RobotModel model =
      kinematics::ReadUrdf(options.robot, kinematics::UrdfContents::kBodies, options.packages);
  kinematics::ArmInFile in_file = options.arm;
  const auto lockings = kinematics::Lockings(model, in_file.base, in_file.flange);
  if (!lockings.empty()) in_file.locked = lockings.front();
  return Arm::FromModel(model, in_file);
}

Gripper ReadGripper(const Options& options) {
  return Gripper::FromUrdf(options.gripper.empty() ? scenario::ModelsOfTheProgram() /
                                                         "grippers/parallel-jaw/gripper.urdf"
                                                   : options.gripper);
}

std::string EffortText(double effort) {
  return effort == 0 ? "unknown" : fmt::format("{:g}", effort);
}

std::string TableText(const Arm& arm, const std::array<kinematics::JointLoad, 6>& loads,
                      const ArmServos& servos) {
  Table table({{"joint"},
               {"lever m", Align::kRight},
               {"inertia kg m^2", Align::kRight},
               {"weight N m", Align::kRight},
               {"limit N m", Align::kRight},
               {"armature kg m^2", Align::kRight},
               {"stiffness N m/rad", Align::kRight},
               {"damping N m s/rad", Align::kRight}});
  for (std::size_t i = 0; i < servos.size(); ++i) {
    const kinematics::JointLoad& load = loads[i];
    const kinematics::ServoGains& gains = servos[i];
    table.Add({arm.model().joints[i].name, fmt::format("{:.3f}", load.lever),
               fmt::format("{:.3f}", load.inertia), fmt::format("{:.1f}", load.weight),
               EffortText(arm.limits()[i].effort), fmt::format("{:.2f}", gains.armature),
               fmt::format("{:.0f}", gains.stiffness), fmt::format("{:.0f}", gains.damping)});
  }
  return table.Text();
}

// Returns sentences about joints whose motors cannot carry the arm in every posture.
std::string TooWeakText(const Arm& arm, const std::array<kinematics::JointLoad, 6>& loads) {
  std::string text;
  for (std::size_t i = 0; i < loads.size(); ++i) {
    const double effort = arm.limits()[i].effort;
    if (effort == 0 || loads[i].weight <= effort) continue;
    text += fmt::format("The motor of {} cannot carry the arm in every posture.\n",
                        arm.model().joints[i].name);
  }
  return text;
}

ExitCode Execute(const Options& options) {
  if (!options.output.empty()) RequireWritable(options.output);
  const Arm arm = ReadArm(options);
  const auto loads = kinematics::LoadsOf(arm, ReadGripper(options));
  const ArmServos servos = kinematics::TunedServos(loads);
  const std::string file = domain::ServosText(
      fmt::format("servo gains that `assay tune` derives for {}", arm.model().name), arm, servos);
  std::string text = fmt::format("robot {}\n\n{}\n{}", arm.model().name,
                                 TableText(arm, loads, servos), TooWeakText(arm, loads));
  text +=
      options.output.empty()
          ? fmt::format("Write this into {}:\n\n{}",
                        fs::path(options.robot).replace_extension(".servos.yaml").string(), file)
          : fmt::format("wrote {}\n", options.output.string());
  PrintAndWrite(text, [&] {
    if (!options.output.empty()) WriteFile(options.output, file);
  });
  return ExitCode::kDone;
}

Execution Declare(CLI::App& command) {
  const auto options = std::make_shared<Options>();
  command.add_option("robot", options->robot, "URDF file of the arm")->required();
  command.add_option("-o,--output", options->output, "write the gains to this file");
  command.add_option("--gripper", options->gripper,
                     "URDF file of the gripper (default: the gripper that comes with the program)");
  AddArmOptions(command, *options);
  return [options] { return Execute(*options); };
}

}  // namespace tune_verb

const Verb kTune = {
    .name = "tune",
    .summary = "derives the gains of an arm's servos in the simulation",
    .page = "sim/arms.md",
    .example = "assay tune models/robots/ur5e/ur5e.urdf -o ur5e.servos.yaml",
    .declare = tune_verb::Declare,
};

}  // namespace assay::cli
