#pragma once

#include <filesystem>
#include <string>

#include "planner/kinematics/arm.h"
#include "planner/kinematics/dynamics/servo_gains.h"

namespace assay::domain {

// Reads the servo gains of an arm's joints (assay-servos/1). Throws InputError if a joint is
// missing or a value is not positive.
kinematics::ArmServos ReadServos(const std::filesystem::path& file, const kinematics::Arm& arm);

// Returns the text of such a file. Values have three significant digits.
std::string ServosText(const std::string& description, const kinematics::Arm& arm,
                       const kinematics::ArmServos& servos);

}  // namespace assay::domain
