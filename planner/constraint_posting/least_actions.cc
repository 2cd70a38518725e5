#include "planner/constraint_posting/least_actions.h"

#include <algorithm>
#include <limits>
#include <queue>

#include "planner/domain/actions/condition.h"

namespace assay::constraint_posting {

using domain::LocatedGoal;
using domain::Mating;
using domain::MatingId;
using domain::PartId;
using domain::Problem;
using network::Relation;

namespace {

constexpr int kUnreachable = std::numeric_limits<int>::max() / 8;

// Returns, by position label, the least number of moves that bring the part there.
std::vector<int> LeastMoves(const Relation& reachable, const std::vector<int>& start,
                            int stable_poses) {
  std::vector<int> moves(reachable.columns(), kUnreachable);
  std::vector<bool> grasp_used(reachable.rows(), false);
  std::queue<int> open;
  for (int position : start) {
    moves[position] = 0;
    open.push(position);
  }
  for (; !open.empty(); open.pop()) {
    const int from = open.front();
    for (int grasp = 0; grasp < reachable.rows(); ++grasp) {
      if (grasp_used[grasp] || !reachable.Allows(grasp, from)) continue;
      // positions come by increasing distance, so the first use is the best one
      grasp_used[grasp] = true;
      for (int to = 0; to < stable_poses; ++to) {
        if (moves[to] < kUnreachable || !reachable.Allows(grasp, to)) continue;
        moves[to] = moves[from] + 1;
        open.push(to);
      }
    }
  }
  return moves;
}

// The goals of each part, and the least number of actions that they take.
class PartDemands {
 public:
  PartDemands(const Problem& problem, const LabelGeometry& geometry)
      : problem_(problem), geometry_(geometry), demands_(problem.parts.size()) {
    for (std::size_t p = 0; p < problem.parts.size(); ++p) {
      const int stable_poses = geometry.movable[p] ? domain::InitialLabel(problem.parts[p]) : 0;
      demands_[p].moves = LeastMoves(*geometry.reachable[p], geometry.start[p], stable_poses);
      if (!geometry.located[p].empty()) RestIn(demands_[p], geometry.located[p]);
    }
  }

  void Add(MatingId id) {
    const Mating& mating = problem_.mating(id);
    int least_held = kUnreachable;
    std::vector<int> positions;
    for (int position : geometry_.position_list[id.index()]) {
      int least = kUnreachable;
      for (int grasp : geometry_.grasp_list[id.index()]) {
        if (!geometry_.mate_reachable[id.index()]->Allows(grasp, position)) continue;
        least = std::min(least, LeastMovesToTake(mating.held, grasp));
      }
      if (least < kUnreachable) positions.push_back(position);
      least_held = std::min(least_held, least);
    }
    demands_[mating.held.index()].taken = 2 * least_held + 1;
    RestIn(demands_[mating.fixed.index()], positions);
    ++assembles_;
  }

  std::optional<int> Total() const {
    int total = assembles_;
    for (const Demand& demand : demands_) {
      const int actions = Actions(demand);
      if (actions >= kUnreachable) return std::nullopt;
      total += actions;
    }
    return total;
  }

 private:
  struct Demand {
    // indexed by position: the least number of moves that bring the part there
    std::vector<int> moves = {};
    // the number of actions until the part is in the hand for its mating
    std::optional<int> taken = {};
    bool rests = false;          // true if the part is to rest at the end in one of `ends`
    std::vector<int> ends = {};  // positions in increasing order
  };

  static void RestIn(Demand& demand, std::vector<int> positions) {
    std::ranges::sort(positions);
    if (demand.rests) {
      std::vector<int> both;
      std::ranges::set_intersection(demand.ends, positions, std::back_inserter(both));
      positions = std::move(both);
    }
    demand.rests = true;
    demand.ends = std::move(positions);
  }

  // A mated part rests nowhere by itself, so a goal that it rests cannot be reached.
  static int Actions(const Demand& demand) {
    if (demand.taken) return demand.rests ? kUnreachable : *demand.taken;
    if (!demand.rests) return 0;
    int least = kUnreachable;
    for (int position : demand.ends) least = std::min(least, 2 * demand.moves[position]);
    return least;
  }

  int LeastMovesToTake(PartId part, int grasp) const {
    if (!geometry_.movable[part.index()]) return kUnreachable;
    int least = kUnreachable;
    const Relation& reachable = *geometry_.reachable[part.index()];
    for (int position = 0; position < reachable.columns(); ++position) {
      if (reachable.Allows(grasp, position)) {
        least = std::min(least, demands_[part.index()].moves[position]);
      }
    }
    return least;
  }

  const Problem& problem_;
  const LabelGeometry& geometry_;
  std::vector<Demand> demands_;  // indexed by part
  int assembles_ = 0;
};

}  // namespace

std::vector<int> LocatedLabels(const Problem& problem, const LocatedGoal& goal) {
  const domain::Part& part = problem.part(goal.part);
  std::vector<int> labels;
  for (domain::StablePoseId pose : goal.stable_poses) labels.push_back(pose.index());
  if (std::ranges::count(goal.stable_poses, part.resting) > 0) {
    labels.push_back(domain::InitialLabel(part));
  }
  return labels;
}

std::optional<int> LeastActions(const Problem& problem, const LabelGeometry& geometry) {
  // Other actions may move a part in fewer steps than a pickup and a putdown.
  if (problem.actions != domain::StandardActions()) return 0;
  PartDemands demands(problem, geometry);
  for (const domain::Goal& goal : problem.goals) {
    const auto* mating = std::get_if<MatingId>(&goal);
    if (mating && std::ranges::count(problem.assembled, *mating) == 0) demands.Add(*mating);
  }
  return demands.Total();
}

}  // namespace assay::constraint_posting
