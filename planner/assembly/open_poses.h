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

// The poses that a part has in the worlds of a scenario (domain::ReadWorlds), in the order of its
// file; none if its pose is not open.
std::vector<NamedPose> PosesOf(const std::vector<domain::Problem>& worlds, domain::PartId part);

// Two of them that may look alike to the sensor (domain::LookAlike); none: it tells all apart.
std::optional<std::pair<std::string, std::string>> FindAlike(
    const std::vector<domain::Problem>& worlds, domain::PartId part, const std::string& sensor);

}  // namespace assay::assembly
