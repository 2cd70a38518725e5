#include "planner/plan/checker/label_check.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string_view>

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

constexpr char kInitial[] = "initial";

// Returns the labels of the part's grasps at this pose of the tool.
std::vector<std::string> LabelsOf(const domain::Part& part, const Hold& hold) {
  std::vector<std::string> labels;
  for (const domain::Grasp& grasp : *part.grasps) {
    if (IsSame(grasp.X_PartTool, hold.X_PartTool)) labels.push_back(grasp.label);
  }
  return labels;
}

// Returns the labels of the positions in which the part then rests.
std::vector<std::string> LabelsOf(const domain::Part& part, const Place& place) {
  std::vector<std::string> labels;
  if (IsSame(part.X_WorldPart, place.X_WorldPart)) labels.emplace_back(kInitial);
  for (const domain::StablePose& pose : part.model->stable_poses()) {
    if (RestsAlike(pose.X_TablePart, place.X_WorldPart)) labels.push_back(pose.label);
  }
  return labels;
}

// Returns whether the label is "initial", or begins with the part's initial, as the labels that the
// part's model gives do (BP1).
bool IsOfModel(const domain::Part& part, const std::string& label) {
  return label == kInitial || label.starts_with(part.model->initial());
}

// Adds a flaw if the label is not among the true ones. `what` is the thing that has the label.
void CheckLabel(const domain::Part& part, const std::string& label,
                const std::vector<std::string>& labels, std::string_view what,
                std::vector<std::string>& wrong) {
  if (std::ranges::count(labels, label) > 0) return;
  if (!labels.empty()) {
    wrong.push_back(
        fmt::format("the {} has the label '{}', but is {}", what, label, fmt::join(labels, ", ")));
  } else if (label.empty() || IsOfModel(part, label)) {
    wrong.push_back(fmt::format("the {} has the label '{}', but is another {}", what, label,
                                what.substr(0, what.find(' '))));
  }
}

}  // namespace

std::vector<std::string> MisleadingLabels(const domain::Problem& problem, const Action& action) {
  std::vector<std::string> wrong;
  if (const Hold* hold = HoldIn(action)) {
    const domain::Part& part = problem.part(HandledPart(problem, action));
    CheckLabel(part, hold->grasp, LabelsOf(part, *hold), "grasp", wrong);
  }
  const domain::Part& part = problem.part(PlacedPart(problem, action));
  CheckLabel(part, action.place.position, LabelsOf(part, action.place),
             fmt::format("place of {}", part.name), wrong);
  return wrong;
}

}  // namespace assay::plan
