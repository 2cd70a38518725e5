#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "planner/kinematics/arm.h"
#include "planner/kinematics/dynamics/servo_gains.h"

namespace assay::domain {

// Reads the servo gains of an arm's joints (assay-servos/1). The file may also have gains of joints
// that are locked. If joints are locked, the file may lack others, which may have been locked when
// it was written: these get the gains that `derive` returns. Throws InputError if a joint is
// missing otherwise, or a value is outside of its range.
kinematics::ArmServos ReadServos(const std::filesystem::path& file, const kinematics::Arm& arm,
                                 const kinematics::LockedJoints& locked,
                                 const std::function<kinematics::ArmServos()>& derive);

// Returns the text of such a file. Values have three significant digits.
std::string ServosText(const std::string& description, const kinematics::Arm& arm,
                       const kinematics::ArmServos& servos);

}  // namespace assay::domain
