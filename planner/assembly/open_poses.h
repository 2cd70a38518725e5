#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "planner/domain/problem/problem.h"

namespace assay::assembly {

struct NamedPose {
  std::string name;
  geometry::Pose X_WorldPart;
};

// Returns the poses that a part has in the worlds of a scenario (domain::ReadWorlds), in the order
// of the scenario's file. Returns none if the part's pose is not open.
std::vector<NamedPose> PosesOf(const std::vector<domain::Problem>& worlds, domain::PartId part);

// Returns the names of two poses of the part that may look alike to the sensor (domain::LookAlike).
// Returns none if the sensor distinguishes all poses.
std::optional<std::pair<std::string, std::string>> FindAlike(
    const std::vector<domain::Problem>& worlds, domain::PartId part, const std::string& sensor);

}  // namespace assay::assembly
