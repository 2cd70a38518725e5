#include "planner/assembly/travel/part_error_bounds.h"

#include <algorithm>
#include <cmath>

#include "planner/geometry/box.h"

namespace assay::assembly {
namespace {

using domain::PartId;
using geometry::Vector3;

double Greatest(const Interval& range) {
  return std::max(std::abs(range.low), std::abs(range.high));
}

// Returns the bound for points within `radius` of the axis or the point about which the body turns.
template <class Error>
double Doubt(const Error& error, double turn, double radius) {
  const Vector3 displacement(Greatest(error.x), Greatest(error.y), Greatest(error.z));
  const double doubt = displacement.norm() + turn * radius;
  return std::isfinite(doubt) ? std::min(doubt, PartErrorBounds::kMost) : PartErrorBounds::kMost;
}

// Returns the bound for a resting part. Errors turn the part about the vertical through its origin.
double DoubtAtRest(const domain::Part& part, const plan::ErrorSet& set,
                   const plan::Pose& X_WorldPart) {
  double radius = 0;
  for (const Vector3& vertex : part.model->corners()) {
    radius = std::max(radius, (X_WorldPart.linear() * vertex).head<2>().norm());
  }
  return Doubt(set, Greatest(set.theta), radius);
}

// Returns the bound for a held part. Errors turn it about the grasped point.
double DoubtInHand(const domain::Part& part, const plan::ErrorSet& set, const plan::Hold& hold) {
  double radius = 0;
  for (const Vector3& vertex : part.model->corners()) {
    radius = std::max(radius, (vertex - hold.X_PartTool.translation()).norm());
  }
  return Doubt(set, Greatest(set.theta) + Greatest(set.tip) + Greatest(set.twist), radius);
}

}  // namespace

PartErrorBounds::PartErrorBounds(const domain::Problem& problem) : problem_(problem) {
  for (std::size_t p = 0; p < problem.parts.size(); ++p) {
    const domain::PoseError& error = problem.parts[p].error;
    sets_.push_back(
        {.part = PartId(p), .x = error.x, .y = error.y, .z = error.z, .theta = error.theta});
  }
}

void PartErrorBounds::Take(const std::vector<plan::ErrorSet>& sets) {
  for (const plan::ErrorSet& set : sets) sets_[set.part.index()] = set;
}

std::vector<double> PartErrorBounds::In(const plan::WorldState& state) const {
  std::vector<double> doubts;
  for (std::size_t p = 0; p < sets_.size(); ++p) {
    const domain::Part& part = problem_.parts[p];
    doubts.push_back(state.in_hand == PartId(p)
                         ? DoubtInHand(part, sets_[p], state.hold)
                         : DoubtAtRest(part, sets_[p], state.parts[p].X_WorldPart));
  }
  return doubts;
}

double HandDoubt(const domain::Problem& problem) {
  double reach = 0;  // the greatest distance of a point of the hand from the tool's origin
  for (const geometry::Box& box : problem.workcell->gripper().HandBoxes()) {
    reach = std::max(reach, box.X_FrameBox.translation().norm() + box.half_extents.norm());
  }
  return Doubt(problem.gripper_error, Greatest(problem.gripper_error.theta), reach);
}

}  // namespace assay::assembly
