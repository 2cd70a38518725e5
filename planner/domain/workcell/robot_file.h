#pragma once

#include <filesystem>
#include <vector>

#include "planner/base/input_files/document.h"
#include "planner/domain/units/units.h"
#include "planner/domain/workcell/robot.h"

namespace assay::domain {

// Reads the robots of a workcell file in this folder: its keys `robot` and `gripper`, or `robots`,
// where each robot has a name and a gripper of its own. Throws InputError.
std::vector<Robot> ReadRobots(const Value& workcell, const Units& units,
                              const std::filesystem::path& folder);

}  // namespace assay::domain
