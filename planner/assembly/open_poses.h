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

// Returns whether the part's pose is open, and the open pose, which the part must have.
bool IsOpen(const domain::Problem& world, domain::PartId part);
const domain::OpenPose& OpenPoseOf(const domain::Problem& world, domain::PartId part);

// Returns the open poses that decide whether a plan for the worlds `of_plan` works. Every choice of
// the other open poses leads to one of these worlds.
std::vector<domain::OpenPose> PosesThatMatter(const std::vector<domain::Problem>& worlds,
                                              const std::vector<int>& of_plan);

}  // namespace assay::assembly
