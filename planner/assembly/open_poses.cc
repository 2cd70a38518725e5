#include "planner/assembly/open_poses.h"

#include <algorithm>

#include "planner/base/check.h"
#include "planner/domain/part/look_alike.h"

namespace assay::assembly {

std::vector<NamedPose> PosesOf(const std::vector<domain::Problem>& worlds, domain::PartId part) {
  std::vector<NamedPose> poses;
  for (const domain::Problem& world : worlds) {
    const auto open = std::ranges::find(world.open_poses, part, &domain::OpenPose::part);
    if (open == world.open_poses.end()) continue;
    const std::string& name = open->names[open->chosen];
    if (std::ranges::count(poses, name, &NamedPose::name) > 0) continue;
    poses.push_back({name, world.part(part).X_WorldPart});
  }
  return poses;
}

std::optional<std::pair<std::string, std::string>> FindAlike(
    const std::vector<domain::Problem>& worlds, domain::PartId part, const std::string& sensor) {
  const domain::Problem& first = worlds.front();
  const auto* const model = first.workcell->uncertainty_operations().FindSensor(sensor);
  ASSAY_CHECK(model != nullptr, "the workcell has no sensor '{}'", sensor);
  const std::vector<NamedPose> poses = PosesOf(worlds, part);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    for (std::size_t k = i + 1; k < poses.size(); ++k) {
      if (LookAlike(first.part(part), poses[i].X_WorldPart, poses[k].X_WorldPart, *model)) {
        return std::pair(poses[i].name, poses[k].name);
      }
    }
  }
  return std::nullopt;
}

}  // namespace assay::assembly
