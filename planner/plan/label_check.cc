#include "planner/plan/label_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace assay::plan {
namespace {

constexpr double kSamePose = 1e-6;  // metres, and entries of rotations

bool IsSame(const Pose& a, const Pose& b) {
  return (a.matrix() - b.matrix()).cwiseAbs().maxCoeff() <= kSamePose;
}

// The same but for a shift on the table and a turn about the vertical.
bool RestsAlike(const Pose& a, const Pose& b) {
  return (a.linear().row(2) - b.linear().row(2)).cwiseAbs().maxCoeff() <= kSamePose &&
         std::abs(a.translation().z() - b.translation().z()) <= kSamePose;
}

void CheckHold(const domain::Part& part, const Hold& hold, std::vector<std::string>& wrong) {
  const auto grasp = std::ranges::find(*part.grasps, hold.grasp, &domain::Grasp::label);
  if (grasp == part.grasps->end() || IsSame(grasp->X_PartTool, hold.X_PartTool)) return;
  wrong.push_back(fmt::format("the hold is labelled {} and is another one", hold.grasp));
}

void CheckPlace(const domain::Part& part, const Place& place, std::vector<std::string>& wrong) {
  const auto& poses = part.model->stable_poses();
  const auto pose = std::ranges::find(poses, place.position, &domain::StablePose::label);
  const bool fits = place.position == "initial" ? IsSame(part.X_WorldPart, place.X_WorldPart)
                    : pose == poses.end()       ? !place.position.starts_with(part.model->initial())
                                                : RestsAlike(pose->X_TablePart, place.X_WorldPart);
  if (!fits) {
    wrong.push_back(fmt::format("the place of {} is labelled {} and is another one", part.name,
                                place.position));
  }
}

}  // namespace

std::vector<std::string> MisleadingLabels(const domain::Problem& problem, const Action& action) {
  std::vector<std::string> wrong;
  if (const auto* pickup = std::get_if<Pickup>(&action)) {
    CheckHold(problem.part(pickup->part), pickup->hold, wrong);
    CheckPlace(problem.part(pickup->part), pickup->from, wrong);
  } else if (const auto* putdown = std::get_if<Putdown>(&action)) {
    CheckHold(problem.part(putdown->part), putdown->hold, wrong);
    CheckPlace(problem.part(putdown->part), putdown->to, wrong);
  } else {
    const auto& assemble = std::get<Assemble>(action);
    const domain::Mating& mating = problem.mating(assemble.mating);
    CheckHold(problem.part(mating.held), assemble.hold, wrong);
    CheckPlace(problem.part(mating.fixed), assemble.fixed, wrong);
  }
  return wrong;
}

}  // namespace assay::plan
