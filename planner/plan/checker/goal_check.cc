#include "planner/plan/checker/goal_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "planner/geometry/hull.h"
#include "planner/plan/checker/resting_balance.h"

namespace assay::plan {
namespace {

using geometry::Vector3;

// Height over the lowest corner at which corners count as touching, metres.
constexpr double kLowest = 1e-6;

std::vector<std::size_t> LowestCorners(const std::vector<Vector3>& corners,
                                       const geometry::Matrix3& R_TablePart) {
  const auto height = [&](const Vector3& p) { return (R_TablePart * p).z(); };
  const double lowest = height(std::ranges::min(corners, {}, height));
  std::vector<std::size_t> touching;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (height(corners[i]) <= lowest + kLowest) touching.push_back(i);
  }
  return touching;
}

struct WhyNotReached {
  const domain::Problem& problem;
  const WorldState& state;

  std::optional<std::string> operator()(MatingId id) const {
    const domain::Mating& mating = problem.mating(id);
    const std::string goal =
        fmt::format("the goal assembled({}, {}) is not reached", problem.part(mating.held).name,
                    problem.part(mating.fixed).name);
    if (std::ranges::count(state.assembled, id) == 0) return goal + ": they are not mated";
    const PartState& held = state.part(mating.held);
    const PartState& fixed = state.part(mating.fixed);
    if (held.status != PartStatus::kMated || fixed.status == PartStatus::kHeld) {
      return goal + ": one of them is in the hand";
    }
    if (PosesAgree(fixed.X_WorldPart.inverse() * held.X_WorldPart, mating.X_FixedHeld)) {
      return std::nullopt;
    }
    return goal + ": they were moved apart";
  }

  std::optional<std::string> operator()(const domain::LocatedGoal& located) const {
    const domain::Part& part = problem.part(located.part);
    const PartState& now = state.part(located.part);
    const std::string goal = fmt::format("the goal part_location({}) is not reached", part.name);
    if (now.status == PartStatus::kHeld) return goal + ": it is in the hand";
    if (now.status == PartStatus::kMated) return goal + ": it is mated";
    const std::vector<Vector3> corners = geometry::VerticesOf(part.model->pieces());
    const auto on_table = LowestCorners(corners, now.X_WorldPart.linear());
    const auto rests_so = [&](domain::StablePoseId id) {
      const Pose& X_TablePart = part.model->stable_poses()[id.index()].X_TablePart;
      return LowestCorners(corners, X_TablePart.linear()) == on_table;
    };
    if (std::ranges::any_of(located.stable_poses, rests_so)) return std::nullopt;
    return goal + ": it rests on another side";
  }
};

}  // namespace

std::vector<std::string> GoalsNotReached(const domain::Problem& problem, const WorldState& state) {
  std::vector<std::string> findings;
  for (const domain::Goal& goal : problem.goals) {
    const std::optional<std::string> why = std::visit(WhyNotReached{problem, state}, goal);
    if (why) findings.push_back(*why);
  }
  return findings;
}

}  // namespace assay::plan
