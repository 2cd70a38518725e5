#include "sim/cli/options/arm_options.h"

namespace assay::cli {

void AddArmOptions(CLI::App& command, ArmOptions& options) {
  command.add_option("--base", options.arm.base, "link of this file at which the arm begins");
  command.add_option("--flange", options.arm.flange,
                     "link of this file at which the arm ends: the gripper is mounted there");
  command.add_option("--packages", options.packages,
                     "folders in which packages with the meshes of this file lie");
}

}  // namespace assay::cli
