#include "planner/plan/checker/label_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace assay::plan {
namespace {

constexpr double kSamePose = 1e-6;  // metres, and entries of rotations

bool IsSame(const Pose& a, const Pose& b) {
  return (a.matrix() - b.matrix()).cwiseAbs().maxCoeff() <= kSamePose;
}

// Returns whether the poses are the same up to a shift on the table and a turn about the vertical.
bool RestsAlike(const Pose& a, const Pose& b) {
  return (a.linear().row(2) - b.linear().row(2)).cwiseAbs().maxCoeff() <= kSamePose &&
         std::abs(a.translation().z() - b.translation().z()) <= kSamePose;
}

void CheckHold(const domain::Part& part, const Hold& hold, std::vector<std::string>& wrong) {
  const auto grasp = std::ranges::find(*part.grasps, hold.grasp, &domain::Grasp::label);
  if (grasp == part.grasps->end() || IsSame(grasp->X_PartTool, hold.X_PartTool)) return;
  wrong.push_back(fmt::format("the grasp has the label {}, but is another grasp", hold.grasp));
}

void CheckPlace(const domain::Part& part, const Place& place, std::vector<std::string>& wrong) {
  const auto& poses = part.model->stable_poses();
  const auto pose = std::ranges::find(poses, place.position, &domain::StablePose::label);
  const bool fits = place.position == "initial" ? IsSame(part.X_WorldPart, place.X_WorldPart)
                    : pose == poses.end()       ? !place.position.starts_with(part.model->initial())
                                                : RestsAlike(pose->X_TablePart, place.X_WorldPart);
  if (!fits) {
    wrong.push_back(fmt::format("the place of {} has the label {}, but is another place", part.name,
                                place.position));
  }
}

}  // namespace

std::vector<std::string> MisleadingLabels(const domain::Problem& problem, const Action& action) {
  std::vector<std::string> wrong;
  if (const Hold* hold = HoldIn(action)) {
    CheckHold(problem.part(HandledPart(problem, action)), *hold, wrong);
  }
  CheckPlace(problem.part(PlacedPart(problem, action)), action.place, wrong);
  return wrong;
}

}  // namespace assay::plan
