#include "planner/posting/least_actions.h"

#include <algorithm>
#include <limits>
#include <queue>

#include "planner/domain/condition.h"

namespace assay::posting {

using domain::LocatedGoal;
using domain::Mating;
using domain::MatingId;
using domain::PartId;
using domain::Problem;
using network::Relation;

namespace {

constexpr int kUnreachable = std::numeric_limits<int>::max() / 8;

// By position label: how often the part must at least be put down to get there.
std::vector<int> LeastPutdowns(const Relation& reachable, const std::vector<int>& start,
                               int stable_poses) {
  std::vector<int> putdowns(reachable.columns(), kUnreachable);
  std::vector<bool> grasp_used(reachable.rows(), false);
  std::queue<int> open;
  for (int position : start) {
    putdowns[position] = 0;
    open.push(position);
  }
  for (; !open.empty(); open.pop()) {
    const int from = open.front();
    for (int grasp = 0; grasp < reachable.rows(); ++grasp) {
      if (grasp_used[grasp] || !reachable.Allows(grasp, from)) continue;
      grasp_used[grasp] = true;  // positions come by increasing distance: the first use is best
      for (int to = 0; to < stable_poses; ++to) {
        if (putdowns[to] < kUnreachable || !reachable.Allows(grasp, to)) continue;
        putdowns[to] = putdowns[from] + 1;
        open.push(to);
      }
    }
  }
  return putdowns;
}

// The least number of actions that bring each part where one goal wants it.
class PartDemands {
 public:
  PartDemands(const Problem& problem, const LabelGeometry& geometry)
      : problem_(problem), geometry_(geometry), actions_(problem.parts.size(), 0) {
    for (std::size_t p = 0; p < problem.parts.size(); ++p) {
      putdowns_.push_back(LeastPutdowns(*geometry.reachable[p], geometry.start[p],
                                        domain::InitialLabel(problem.parts[p])));
    }
  }

  void Add(const LocatedGoal& goal) {
    int least = kUnreachable;
    for (domain::StablePoseId pose : goal.stable_poses) {
      least = std::min(least, putdowns_[goal.part.index()][pose.index()]);
    }
    for (int position : geometry_.start[goal.part.index()]) {
      const domain::Part& part = problem_.part(goal.part);
      const int resting = position == domain::InitialLabel(part) ? part.resting.index() : position;
      const bool there = std::ranges::any_of(goal.stable_poses,
                                             [&](auto pose) { return pose.index() == resting; });
      if (there) least = 0;
    }
    Demand(goal.part, 2 * least);
  }

  void Add(MatingId id) {
    const Mating& mating = problem_.mating(id);
    int least_held = kUnreachable;
    int least_fixed = kUnreachable;
    for (int grasp : geometry_.grasp_list[id.index()]) {
      const int held = LeastPutdownsToTake(mating.held, grasp);
      for (int position : geometry_.position_list[id.index()]) {
        if (!geometry_.mate_reachable[id.index()]->Allows(grasp, position)) continue;
        least_held = std::min(least_held, held);
        least_fixed = std::min(least_fixed, putdowns_[mating.fixed.index()][position]);
      }
    }
    Demand(mating.held, 2 * least_held + 1);
    Demand(mating.fixed, 2 * least_fixed);
    ++assembles_;
  }

  std::optional<int> Total() const {
    int total = assembles_;
    for (int actions : actions_) {
      if (actions >= kUnreachable) return std::nullopt;
      total += actions;
    }
    return total;
  }

 private:
  int LeastPutdownsToTake(PartId part, int grasp) const {
    int least = kUnreachable;
    const Relation& reachable = *geometry_.reachable[part.index()];
    for (int position = 0; position < reachable.columns(); ++position) {
      if (reachable.Allows(grasp, position)) {
        least = std::min(least, putdowns_[part.index()][position]);
      }
    }
    return least;
  }

  void Demand(PartId part, int actions) {
    actions_[part.index()] = std::max(actions_[part.index()], actions);
  }

  const Problem& problem_;
  const LabelGeometry& geometry_;
  std::vector<std::vector<int>> putdowns_;  // by part and position
  std::vector<int> actions_;                // by part
  int assembles_ = 0;
};

}  // namespace

std::optional<int> LeastActions(const Problem& problem, const LabelGeometry& geometry) {
  PartDemands demands(problem, geometry);
  for (const domain::Goal& goal : problem.goals) {
    if (const auto* located = std::get_if<LocatedGoal>(&goal)) {
      demands.Add(*located);
    } else if (std::ranges::count(problem.assembled, std::get<MatingId>(goal)) == 0) {
      demands.Add(std::get<MatingId>(goal));
    }
  }
  return demands.Total();
}

}  // namespace assay::posting
