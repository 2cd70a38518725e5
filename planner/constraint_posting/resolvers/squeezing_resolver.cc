#include "planner/constraint_posting/resolvers/squeezing_resolver.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "planner/constraint_posting/resolvers/plan_states.h"
#include "planner/domain/reachability/reachability.h"
#include "planner/geometry/pose.h"

namespace assay::constraint_posting {
namespace {

using domain::Grasp;
using domain::GraspId;
using domain::PartId;
using geometry::Pose;
using geometry::Vector3;

// Closing directions that differ by less than this angle count as equal.
constexpr double kSameDirection = 5 * std::numbers::pi / 180;

bool AreParallel(const Vector3& a, const Vector3& b) {
  return std::abs(a.dot(b)) > std::cos(kSameDirection);
}

std::vector<domain::PlacedPart> OthersThan(const plan::WorldState& state, PartId part) {
  std::vector<domain::PlacedPart> others;
  for (std::size_t p = 0; p < state.parts.size(); ++p) {
    if (PartId(p) != part) others.push_back({PartId(p), state.parts[p].X_WorldPart});
  }
  return others;
}

// Returns the part that is in the hand's way while the open hand arrives and closes on the part to
// be squeezed, or None if nothing is in the way.
PartId ObstacleOf(const domain::Problem& problem, const plan::WorldState& state, PartId part,
                  const Grasp& grasp, const Pose& X_WorldTool) {
  const domain::Workcell& workcell = *problem.workcell;
  const std::vector<domain::PlacedPart> others = OthersThan(state, part);
  const double open = workcell.gripper().max_opening();
  const Pose retreated =
      X_WorldTool * geometry::Translation(0, 0, -workcell.rules().approach_distance);
  for (const auto& [X_World, opening] :
       {std::pair{X_WorldTool, grasp.width}, {X_WorldTool, open}, {retreated, open}}) {
    const PartId obstacle = Obstacle(problem, X_World, opening, others);
    if (!obstacle.IsNone()) return obstacle;
  }
  return PartId::None();
}

// Returns the part's grasps, ordered by the lean of the tool, the least first.
std::vector<GraspId> ByLean(const domain::Part& part, const Pose& X_WorldPart) {
  std::vector<GraspId> order;
  // The z components of the tools' axes, where -1 is straight down. They are rounded, so that equal
  // leans compare equal on every machine.
  std::vector<double> heights;
  for (const Grasp& grasp : *part.grasps) {
    order.emplace_back(heights.size());
    const Pose X_WorldTool = X_WorldPart * grasp.X_PartTool;
    heights.push_back(std::round(X_WorldTool.linear()(2, 2) * 1e9));
  }
  std::ranges::stable_sort(order, {}, [&](GraspId id) { return heights[id.index()]; });
  return order;
}

// The possible squeezes of a part, one for each closing direction, and the parts that block the
// other directions.
struct Squeezes {
  std::vector<plan::Action> possible = {};
  std::vector<PartId> obstacles = {};
};

Squeezes SqueezesOf(const domain::Problem& problem, const plan::WorldState& state, PartId part_id,
                    const plan::Place& at) {
  const domain::Part& part = problem.part(part_id);
  Squeezes squeezes;
  std::vector<Vector3> directions;
  std::vector<std::pair<Vector3, PartId>> blocked;
  const auto is_served = [&](const Vector3& closing) {
    return std::ranges::any_of(directions,
                               [&](const Vector3& d) { return AreParallel(d, closing); });
  };
  for (const GraspId id : ByLean(part, at.X_WorldPart)) {
    const Grasp& grasp = (*part.grasps)[id.index()];
    const Pose X_WorldTool = at.X_WorldPart * grasp.X_PartTool;
    const Vector3 closing = X_WorldTool.linear().col(1);
    if (is_served(closing) || !IsReachableAt(problem, part_id, id, at.X_WorldPart)) continue;
    const PartId obstacle = ObstacleOf(problem, state, part_id, grasp, X_WorldTool);
    if (!obstacle.IsNone()) {
      blocked.emplace_back(closing, obstacle);
      continue;
    }
    directions.push_back(closing);
    squeezes.possible.push_back({.kind = &domain::kSqueeze,
                                 .part = part_id,
                                 .hold = {grasp.label, grasp.X_PartTool, grasp.width},
                                 .place = at});
  }
  for (const auto& [closing, obstacle] : blocked) {
    if (!is_served(closing)) squeezes.obstacles.push_back(obstacle);
  }
  return squeezes;
}

// Returns each squeeze alone, then each pair in both orders.
std::vector<std::vector<plan::Action>> SequencesOf(const std::vector<plan::Action>& squeezes) {
  std::vector<std::vector<plan::Action>> sequences;
  for (const plan::Action& squeeze : squeezes) sequences.push_back({squeeze});
  for (std::size_t first = 0; first < squeezes.size(); ++first) {
    for (std::size_t second = 0; second < squeezes.size(); ++second) {
      if (first != second) sequences.push_back({squeezes[first], squeezes[second]});
    }
  }
  return sequences;
}

Remedy InsertBefore(int index, PartId part, const std::vector<plan::Action>& actions) {
  Remedy remedy = {.part = part};
  for (const plan::Action& action : actions) remedy.insertions.push_back({index, action});
  return remedy;
}

}  // namespace

std::vector<Remedy> SqueezingResolver::Propose(const UnmetGoals& unmet) {
  const std::vector<plan::WorldState> states = plan::StatesOf(unmet.problem, unmet.actions);
  std::vector<Remedy> remedies;
  std::vector<Remedy> with_sensing;
  for (const PartId part : unmet.parts) {
    const auto index = LatestGraspable(unmet.problem, states, unmet.step, part);
    if (!index) continue;
    const plan::Place at = PlaceBefore(unmet, states, *index, part);
    for (std::vector<plan::Action>& sequence :
         SequencesOf(SqueezesOf(unmet.problem, states[*index], part, at).possible)) {
      remedies.push_back(InsertBefore(*index, part, sequence));
      if (unmet.problem.sensors.empty()) continue;
      for (const std::string& sensor : unmet.problem.sensors) {
        sequence.insert(sequence.begin(), LookAt(part, sensor, at));
      }
      with_sensing.push_back(InsertBefore(*index, part, sequence));
    }
  }
  remedies.insert(remedies.end(), with_sensing.begin(), with_sensing.end());
  return remedies;
}

std::vector<PartId> SqueezingResolver::Obstacles(const UnmetGoals& unmet) const {
  const std::vector<plan::WorldState> states = plan::StatesOf(unmet.problem, unmet.actions);
  std::vector<PartId> obstacles;
  for (const PartId part : unmet.parts) {
    const auto index = LatestGraspable(unmet.problem, states, unmet.step, part);
    if (!index) continue;
    const plan::Place at = PlaceBefore(unmet, states, *index, part);
    const Squeezes squeezes = SqueezesOf(unmet.problem, states[*index], part, at);
    obstacles.insert(obstacles.end(), squeezes.obstacles.begin(), squeezes.obstacles.end());
  }
  return obstacles;
}

}  // namespace assay::constraint_posting
