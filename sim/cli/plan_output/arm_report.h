#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "sim/cli/plan_output/report.h"

namespace assay::cli {

struct ArmRequest {
  std::filesystem::path file;  // a URDF file
  std::string base;            // names of links; empty to find them
  std::string tip;
  std::vector<std::filesystem::path> packages = {};  // folders with packages of meshes
  int poses = 1000;
  std::uint64_t seed = 1;
};

// Reports what the arm of a URDF file is: its joints, its class, its solutions, its reach, its
// singular postures, what it lacks for physics, and whether a workcell can have it. It holds if
// every solution reaches its pose to within 1e-9, and every posture is a solution for its own pose.
// Throws InputError if the file has no chain of six or seven revolute joints.
Report ReportOnArm(const ArmRequest& request);

}  // namespace assay::cli
