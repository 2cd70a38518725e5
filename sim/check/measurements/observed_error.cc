#include "sim/check/measurements/observed_error.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "planner/domain/parts/part_model.h"
#include "planner/geometry/hull.h"
#include "planner/geometry/solids/point_distance.h"

namespace assay::check {
namespace {

using geometry::Matrix3;
using geometry::Pose;
using geometry::Vector3;

// The true values of the components of an error set, in the order of plan::ErrorComponents.
using Components = std::array<double, 6>;

Components InHand(const Pose& X_ToolGrasp) {
  const Vector3 p = X_ToolGrasp.translation();
  // The order of rotations is R = R_z(theta) R_x(tip) R_y(twist).
  const Matrix3 R = X_ToolGrasp.linear();
  return {p.x(),
          p.y(),
          p.z(),
          std::atan2(-R(0, 1), R(1, 1)),
          std::asin(std::clamp(R(2, 1), -1.0, 1.0)),
          std::atan2(-R(2, 0), R(2, 2))};
}

// Returns the angle, in radians, by which a nearly upright rotation turns about the world's
// vertical.
double YawOf(const Matrix3& rotation) {
  return std::atan2(rotation(1, 0) - rotation(0, 1), rotation(0, 0) + rotation(1, 1));
}

Components AtRest(const execution::TrueAndBelieved& part) {
  const Vector3 d = part.truth.translation() - part.believed.translation();
  return {d.x(), d.y(), d.z(), YawOf(part.truth.linear() * part.believed.linear().transpose())};
}

}  // namespace

Lever LeverOf(const domain::PartModel& model) {
  double length = std::numeric_limits<double>::infinity();
  for (const geometry::ConvexHull& piece : model.pieces()) {
    length = std::min(length, DistanceTo(piece, Vector3::Zero()));
  }
  Eigen::AlignedBox3d body;
  for (const Vector3& vertex : model.corners()) body.extend(vertex);
  return {length, body.sizes().minCoeff() / 2};
}

std::vector<ObservedError> ObservedErrors(const domain::Problem& problem,
                                          const plan::Action& action, const plan::ErrorSet& set,
                                          const execution::Snapshot& snapshot) {
  const execution::TrueAndBelieved& part = snapshot.parts[set.part.index()];
  const Components observed =
      set.in_hand
          ? InHand(snapshot.tool.believed.inverse() * part.truth * HoldOf(action).X_PartTool)
          : AtRest(part);
  const Lever lever = set.in_hand ? Lever{} : LeverOf(*problem.part(set.part).model);
  std::vector<ObservedError> errors;
  const auto components = plan::ErrorComponents();
  for (std::size_t i = 0; i < components.size(); ++i) {
    const plan::ErrorComponent& component = components[i];
    if (component.only_in_hand && !set.in_hand) continue;
    errors.push_back({fmt::format("{} of {}", component.name, problem.part(set.part).name),
                      component.dimension, set.*component.range, observed[i], lever});
  }
  return errors;
}

}  // namespace assay::check
