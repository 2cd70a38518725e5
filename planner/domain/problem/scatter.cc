#include "planner/domain/problem/scatter.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <numbers>

#include "planner/domain/reachability/reachability.h"
#include "planner/domain/resting/resting.h"

namespace assay::domain {
namespace {

constexpr int kMostDraws = 10'000;

bool IsMated(const Problem& problem, PartId part) {
  return std::ranges::any_of(problem.assembled, [&](MatingId id) {
    return problem.mating(id).held == part || problem.mating(id).fixed == part;
  });
}

Placement DrawPlacement(const Table& table, RandomStream& random) {
  Eigen::AlignedBox2d bounds;
  for (const Vector2& corner : table.top) bounds.extend(corner);
  const double x = random.Uniform(bounds.min().x(), bounds.max().x());
  const double y = random.Uniform(bounds.min().y(), bounds.max().y());
  return {.x = x, .y = y, .yaw = random.Uniform(-std::numbers::pi, std::numbers::pi)};
}

bool CanBeTaken(const Problem& problem, PartId part, const Pose& X_WorldPart) {
  for (std::size_t g = 0; g < problem.part(part).grasps->size(); ++g) {
    if (IsReachableAt(problem, part, GraspId(g), X_WorldPart)) return true;
  }
  return false;
}

}  // namespace

std::optional<Problem> Scatter(const Problem& problem, RandomStream& random) {
  Problem scattered = problem;
  std::vector<PlacedPart> placed;
  std::vector<PartId> loose;
  for (std::size_t p = 0; p < problem.parts.size(); ++p) {
    const PartId id(p);
    if (problem.parts[p].resting.IsNone() || IsMated(problem, id)) {
      placed.push_back({.part = id, .X_WorldPart = problem.parts[p].X_WorldPart});
    } else {
      loose.push_back(id);
    }
  }
  int draws = 0;
  for (PartId id : loose) {
    const Part& part = problem.part(id);
    const Pose& X_TablePart = part.model->stable_poses()[part.resting.index()].X_TablePart;
    Pose X_WorldPart;
    do {
      if (++draws > kMostDraws) return std::nullopt;
      X_WorldPart = DrawPlacement(problem.workcell->table(), random).X_WorldTable() * X_TablePart;
    } while (!OnTable(problem, id, X_WorldPart) ||
             !Crowding(problem, id, X_WorldPart, placed).IsNone() ||
             !CanBeTaken(problem, id, X_WorldPart));
    placed.push_back({.part = id, .X_WorldPart = X_WorldPart});
    scattered.parts[id.index()].X_WorldPart = X_WorldPart;
  }
  return scattered;
}

}  // namespace assay::domain
