#include "planner/assembly/open_poses.h"

#include <algorithm>

#include "planner/base/check.h"
#include "planner/domain/parts/look_alike.h"

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

bool IsOpen(const domain::Problem& world, domain::PartId part) {
  return std::ranges::count(world.open_poses, part, &domain::OpenPose::part) > 0;
}

const domain::OpenPose& OpenPoseOf(const domain::Problem& world, domain::PartId part) {
  return *std::ranges::find(world.open_poses, part, &domain::OpenPose::part);
}

namespace {

// Returns true if the worlds have the same poses of all parts except one.
bool AgreeBeside(const domain::Problem& a, const domain::Problem& b, domain::PartId part) {
  return std::ranges::all_of(a.open_poses, [&](const domain::OpenPose& open) {
    return open.part == part || open.chosen == OpenPoseOf(b, open.part).chosen;
  });
}

bool Matters(const std::vector<domain::Problem>& worlds, const std::vector<int>& of_plan,
             domain::PartId part) {
  for (const int world : of_plan) {
    for (int other = 0; other < std::ssize(worlds); ++other) {
      if (std::ranges::count(of_plan, other) > 0) continue;
      if (AgreeBeside(worlds[world], worlds[other], part)) return true;
    }
  }
  return false;
}

}  // namespace

std::vector<domain::OpenPose> PosesThatMatter(const std::vector<domain::Problem>& worlds,
                                              const std::vector<int>& of_plan) {
  std::vector<domain::OpenPose> matter = worlds.front().open_poses;
  std::erase_if(matter,
                [&](const domain::OpenPose& open) { return !Matters(worlds, of_plan, open.part); });
  return matter;
}

}  // namespace assay::assembly
