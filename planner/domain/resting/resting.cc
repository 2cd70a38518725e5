#include "planner/domain/resting/resting.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "planner/geometry/polygon.h"

namespace assay::domain {
namespace {

using geometry::Polygon;

// Least lean that counts as not lying flat, radians.
constexpr double kLeastLean = std::numbers::pi / 180;
constexpr double kLeastLift = 0.001;  // least height that counts as not touching the table, metres

double TiltBetween(const Pose& X_A, const Pose& X_B) {
  const Vector3 up_A = X_A.linear().row(2);
  const Vector3 up_B = X_B.linear().row(2);
  return std::atan2(up_A.cross(up_B).norm(), up_A.dot(up_B));
}

}  // namespace

Polygon Footprint(const Part& part, const Pose& X_WorldPart) {
  std::vector<Vector2> shadow;
  shadow.reserve(part.model->corners().size());
  for (const Vector3& vertex : part.model->corners()) {
    shadow.push_back((X_WorldPart * vertex).head<2>());
  }
  return geometry::Hull2(shadow);
}

double LowestPoint(const Part& part, const Pose& X_WorldPart) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const Vector3& vertex : part.model->corners()) {
    lowest = std::min(lowest, (X_WorldPart * vertex).z());
  }
  return lowest;
}

bool IsOver(const Table& table, const Part& part, const Pose& X_WorldPart) {
  return std::ranges::all_of(part.model->corners(), [&](const Vector3& vertex) {
    return geometry::Depth(table.top, (X_WorldPart * vertex).head<2>()) >= -kRounding;
  });
}

const Table& TableUnder(const Workcell& workcell, const Part& part, const Pose& X_WorldPart) {
  const auto found = std::ranges::find_if(
      workcell.tables(), [&](const Table& table) { return IsOver(table, part, X_WorldPart); });
  return found != workcell.tables().end() ? *found : workcell.table();
}

bool OnTable(const Problem& problem, PartId id, const Pose& X_WorldPart) {
  const Part& part = problem.part(id);
  return IsOver(TableUnder(*problem.workcell, part, X_WorldPart), part, X_WorldPart);
}

PartId Crowding(const Problem& problem, PartId part, const Pose& X_WorldPart,
                std::span<const PlacedPart> others) {
  const Polygon footprint = Footprint(problem.part(part), X_WorldPart);
  const double least = problem.workcell->rules().part_gap - kRounding;
  for (const PlacedPart& other : others) {
    if (other.part == part) continue;
    const Polygon neighbour = Footprint(problem.part(other.part), other.X_WorldPart);
    if (geometry::Gap(footprint, neighbour) < least) return other.part;
  }
  return PartId::None();
}

StablePoseId StablePoseAt(const Part& part, const Pose& X_WorldPart) {
  const std::vector<StablePose>& poses = part.model->stable_poses();
  StablePoseId nearest = StablePoseId::None();
  double least = kLeastLean;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Pose& X_TablePart = poses[i].X_TablePart;
    const double lift = X_WorldPart.translation().z() - X_TablePart.translation().z();
    const double tilt = TiltBetween(X_WorldPart, X_TablePart);
    if (std::abs(lift) > kLeastLift || tilt > least) continue;
    least = tilt;
    nearest = StablePoseId(i);
  }
  return nearest;
}

Pose ComeToRest(const Part& part, StablePoseId resting, const Pose& X_WorldPart) {
  const Pose& X_TablePart = part.model->stable_poses()[resting.index()].X_TablePart;
  const Vector3 up_Part = X_TablePart.linear().transpose().col(2);
  Pose X = X_WorldPart;
  X.linear() =
      Eigen::Quaterniond::FromTwoVectors(X_WorldPart.linear() * up_Part, Vector3::UnitZ()) *
      X_WorldPart.linear();
  X.translation().z() = X_TablePart.translation().z();
  return X;
}

}  // namespace assay::domain
