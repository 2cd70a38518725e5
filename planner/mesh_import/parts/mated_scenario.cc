#include "planner/mesh_import/parts/mated_scenario.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace assay::mesh_import {
namespace {

constexpr double kBeforeMouth = 0.02;     // metres that the mating motion begins before the mouth
constexpr double kLeastClearance = 1e-6;  // metres, as a scenario file permits
constexpr double kClampForce = 300;       // newtons
// The gripper for small parts takes parts of this width, if they are no longer, in metres.
constexpr double kSmallWidth = 0.03;
constexpr double kSmallLength = 0.1;
constexpr int kSidesOfCircle = 120;
const Vector2 kFixedPlace(0.6, 0.05);  // on the table, metres
const Vector2 kHeldPlace(0.5, -0.2);

// `places` is the number of decimal places.
std::string NumbersText(const Vector3& v, double unit, int places = 6) {
  const auto number = [&](double value) {
    const double scale = std::pow(10, places);
    return fmt::format("{:.{}g}", std::round(value / unit * scale) / scale + 0.0, places);
  };
  return fmt::format("[{}, {}, {}]", number(v.x()), number(v.y()), number(v.z()));
}

std::string PoseText(const Matrix3& R, const Vector3& position) {
  constexpr int kPlaces = 9;  // axes are to be orthonormal to 1e-6
  return fmt::format("{{columns: [{}, {}, {}, {}]}}", NumbersText(R.col(0), 1, kPlaces),
                     NumbersText(R.col(1), 1, kPlaces), NumbersText(R.col(2), 1, kPlaces),
                     NumbersText(position, 1e-3));
}

// Returns the workcell whose gripper suits a part.
std::string WorkcellFor(const ImportedPart& held) {
  Eigen::AlignedBox3d bounds;
  for (const SketchSolid& solid : held.sketch.solids) {
    for (const Vector3& corner : solid.Corners(kSidesOfCircle)) bounds.extend(corner);
  }
  const Vector3 extents = bounds.sizes();
  const bool is_small = extents.minCoeff() <= kSmallWidth && extents.maxCoeff() <= kSmallLength;
  return is_small ? "puma762-small-jaw" : "puma762-table";
}

// Returns the numbers of the features that mate, those of the held part or those of the fixed one.
std::string NumbersOf(const MatedPair& pair, int MatedFeatures::*number) {
  std::vector<int> numbers;
  for (const MatedFeatures& mated : pair.features) numbers.push_back(mated.*number);
  return fmt::format("[{}]", fmt::join(numbers, ", "));
}

}  // namespace

std::string ScenarioText(const MatedPair& pair, const StartingPose& starting_pose) {
  const ImportedPart& held = *pair.held;
  const ImportedPart& fixed = *pair.fixed;
  const MatedFeatures& mated = pair.features.front();
  const Vector3 down = pair.MatingDirection();
  const Matrix3 R_FixedHeld = pair.X_FixedHeld().linear();
  std::string text = fmt::format(
      "format: assay-scenario/1\ntitle: {0} into {1}\nunits: {{length: mm, angle: degree}}\n"
      "workcell: {2}\nclearance: {3}  # as in the files: no hole is widened\nparts:\n",
      held.sketch.name, fixed.sketch.name, WorkcellFor(held),
      Millimetres(std::max(mated.LeastGap(), kLeastClearance)));
  const auto add_part = [&](const ImportedPart& part, const Vector3& wanted, const Vector2& at) {
    text += fmt::format("  {0}:\n    model: {0}\n    pose: {1}\n", part.sketch.name,
                        starting_pose(part, wanted, at));
  };
  add_part(fixed, down, kFixedPlace);
  text += fmt::format("    clamp: {:.0f}  # newtons of a fixture\n", kClampForce);
  add_part(held, R_FixedHeld.transpose() * down, kHeldPlace);
  text += fmt::format(
      "goal:\n  - assembled:\n      held: {}\n      fixed: {}\n      features: [{}, {}]\n"
      "      pose: {}\n      mating_vector: {}\n",
      held.sketch.name, fixed.sketch.name, NumbersOf(pair, &MatedFeatures::shaft),
      NumbersOf(pair, &MatedFeatures::hole), PoseText(R_FixedHeld, pair.way_to_seat * down),
      NumbersText((pair.reach + pair.way_to_seat + kBeforeMouth) * down, 1e-3));
  return text;
}

}  // namespace assay::mesh_import
