#include "planner/domain/matings/mating_classes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/domain/actions/condition.h"
#include "planner/geometry/box.h"

namespace assay::domain {

namespace {

constexpr double kStraightDown = 1e-3;  // radians, as for axes of features that are equal
constexpr double kOpensAbove = 0.5;  // least cosine between the vertical and a hole that opens up

}  // namespace

double LeastMatingFriction(const Problem& problem) {
  return problem.workcell->rules().friction - problem.tolerances.friction;
}

double GreatestMatingFriction(const Problem& problem, const Mating& mating) {
  return std::max({problem.workcell->rules().friction, problem.part(mating.held).model->friction(),
                   problem.part(mating.fixed).model->friction()}) +
         problem.tolerances.friction;
}

Limited MatingLean(const Problem& problem, const Mating& mating, const Pose& X_WorldFixed) {
  return {.value = LeanOf(X_WorldFixed.linear() * mating.mating_vector),
          .limit = mating.ends_on_table ? kStraightDown : std::atan(LeastMatingFriction(problem))};
}

// -v_z >= |v| cos(atan(mu)): the vector points into the cone about the downward direction.
bool InFrictionCone(const Problem& problem, const Mating& mating, const Pose& X_WorldFixed) {
  return MatingLean(problem, mating, X_WorldFixed).excess() <= kRounding &&
         EndsAboveTable(problem, mating, X_WorldFixed);
}

double HeightOfMated(const Problem& problem, const Mating& mating, const Pose& X_WorldFixed) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const Vector3& p : problem.part(mating.held).model->corners())
    lowest = std::min(lowest, (X_WorldFixed * mating.X_FixedHeld * p).z());
  return lowest;
}

bool EndsAboveTable(const Problem& problem, const Mating& mating, const Pose& X_WorldFixed) {
  const double height = HeightOfMated(problem, mating, X_WorldFixed);
  if (mating.ends_on_table) return std::abs(height) <= kSeatGap;
  return height >= -problem.workcell->rules().contact_allowance - kRounding;
}

bool HidesMatingFeatures(const Problem& problem, const Mating& mating, StablePoseId pose_of_fixed) {
  if (pose_of_fixed.IsNone()) return false;
  const PartModel& fixed = *problem.part(mating.fixed).model;
  const StablePose& pose = fixed.stable_poses()[pose_of_fixed.index()];
  return std::ranges::any_of(mating.features, [&](const auto& pair) {
    const Feature& feature = *fixed.FindFeature(pair.second);
    const double up = (pose.X_TablePart.linear() * feature.X_PartFeature.linear()).col(2).z();
    const bool opens_above = feature.mouths.size() > 1 && up > kOpensAbove;
    return !opens_above && std::ranges::binary_search(pose.hidden, pair.second);
  });
}

namespace {

// Returns whether a held shaft is touched only where it is outside of its hole, once it is seated.
bool IsTouchedOutside(const Problem& problem, const Mating& mating, const Grasp& grasp,
                      FeatureNumber of_held, FeatureNumber of_fixed) {
  const Feature* shaft = problem.part(mating.held).model->FindFeature(of_held);
  const Feature* hole = problem.part(mating.fixed).model->FindFeature(of_fixed);
  if (shaft == nullptr || hole == nullptr || hole->mouths.empty() || !shaft->mouths.empty()) {
    return false;
  }
  const Vector2& pad = problem.workcell->gripper().pad_half_extents();
  const Pose X_HoleTool = hole->X_PartFeature.inverse() * mating.X_FixedHeld * grasp.X_PartTool;
  for (const Vector3& corner :
       geometry::Box::FromCorners(-Vector3(pad.x(), grasp.width / 2, pad.y()),
                                  Vector3(pad.x(), grasp.width / 2, pad.y()))
           .Corners()) {
    if ((X_HoleTool * corner).z() < kRounding) return false;
  }
  return true;
}

}  // namespace

bool LeavesMatingFeaturesFree(const Problem& problem, const Mating& mating, GraspId id) {
  const Grasp& grasp = (*problem.part(mating.held).grasps)[id.index()];
  return std::ranges::none_of(mating.features, [&](const auto& pair) {
    return std::ranges::binary_search(grasp.hidden, pair.first) &&
           !IsTouchedOutside(problem, mating, grasp, pair.first, pair.second);
  });
}

std::vector<int> GraspList(const Problem& problem, const Mating& mating) {
  std::vector<int> labels;
  for (int g = 0; g < GraspLabelCount(problem.part(mating.held)); ++g) {
    if (LeavesMatingFeaturesFree(problem, mating, GraspId(g))) labels.push_back(g);
  }
  return labels;
}

namespace {

// `pose` is the fixed part's stable pose, and X_WorldFixed a pose of this kind.
bool AllowsMating(const Problem& problem, const Mating& mating, StablePoseId pose,
                  const Pose& X_WorldFixed) {
  return !HidesMatingFeatures(problem, mating, pose) &&
         InFrictionCone(problem, mating, X_WorldFixed);
}

}  // namespace

std::vector<int> PositionList(const Problem& problem, const Mating& mating) {
  const Part& fixed = problem.part(mating.fixed);
  std::vector<int> labels;
  for (int p = 0; p < InitialLabel(fixed); ++p) {
    const Pose& X_TablePart = fixed.model->stable_poses()[static_cast<std::size_t>(p)].X_TablePart;
    if (AllowsMating(problem, mating, StablePoseId(p), X_TablePart)) labels.push_back(p);
  }
  if (!fixed.position_class.IsNone() &&
      AllowsMating(problem, mating, fixed.position_class, fixed.X_WorldPart)) {
    labels.push_back(InitialLabel(fixed));
  }
  return labels;
}

}  // namespace assay::domain
