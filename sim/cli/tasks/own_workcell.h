#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "planner/domain/workcell/arm_site.h"

namespace assay::cli {

// An arm of the user's own. The paths are as a workcell's file names them.
struct OwnArm {
  std::string name;
  std::string urdf;
  std::string gripper;
  kinematics::ArmInFile arm;               // names of links may be empty
  std::vector<std::string> packages = {};  // folders with packages of meshes
};

// Returns the text of a workcell file for an arm at its site. Its rules and its error bounds are
// values to begin with.
std::string WorkcellText(const OwnArm& own, const domain::ArmSite& site);

}  // namespace assay::cli
