#include "planner/assembly/travel/part_error_bounds.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/geometry/box.h"

namespace assay::assembly {
namespace {

using domain::PartId;
using geometry::Vector3;
using motion::PlaceError;

double Greatest(const Interval& range) {
  return std::max(std::abs(range.low), std::abs(range.high));
}

template <class Error>
double ShiftBy(const Error& error) {
  return Vector3(Greatest(error.x), Greatest(error.y), Greatest(error.z)).norm();
}

// Returns a shift that contains the turn by this angle of points within `radius` of the axis or the
// point about which the body turns.
template <class Error>
double Doubt(const Error& error, double turn, double radius) {
  return ShiftBy(error) + turn * radius;
}

PlaceError Limited(double shift, double turn) {
  if (shift <= PartErrorBounds::kMost) return {shift, turn};
  return {.shift = PartErrorBounds::kMost, .turn = turn, .is_bounded = false};
}

// A half turn to each side leads everywhere.
PlaceError ErrorAtRest(const plan::ErrorSet& set) {
  return Limited(ShiftBy(set), std::min(Greatest(set.theta), std::numbers::pi));
}

// Errors turn a held part about an axis through the grasped point. This axis may have any
// direction.
PlaceError ErrorInHand(const domain::Part& part, const plan::ErrorSet& set,
                       const plan::Hold& hold) {
  double radius = 0;
  for (const Vector3& vertex : part.model->corners()) {
    radius = std::max(radius, (vertex - hold.X_PartTool.translation()).norm());
  }
  const double turn = Greatest(set.theta) + Greatest(set.tip) + Greatest(set.twist);
  return Limited(Doubt(set, turn, radius), 0);
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

std::vector<PlaceError> PartErrorBounds::In(const plan::WorldState& state) const {
  std::vector<PlaceError> errors;
  for (std::size_t p = 0; p < sets_.size(); ++p) {
    errors.push_back(state.in_hand == PartId(p)
                         ? ErrorInHand(problem_.parts[p], sets_[p], state.hold)
                         : ErrorAtRest(sets_[p]));
  }
  return errors;
}

double HandDoubt(const domain::Problem& problem) {
  double reach = 0;  // the greatest distance of a point of the hand from the tool's origin
  for (const geometry::Box& box : problem.workcell->gripper().HandBoxes()) {
    reach = std::max(reach, box.X_FrameBox.translation().norm() + box.half_extents.norm());
  }
  return Doubt(problem.gripper_error, Greatest(problem.gripper_error.theta), reach);
}

}  // namespace assay::assembly
