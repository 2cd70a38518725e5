#include "planner/contingent/search/first_tree.h"

#include <algorithm>
#include <queue>
#include <tuple>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "planner/contingent/search/relaxed_knowledge_graph.h"
#include "planner/contingent/search/sub_plans.h"

namespace assay::contingent {
namespace {

// The greatest number of states visited in the search for a path without sensing to a completed
// sub-plan.
constexpr int kStatesWithoutSensing = 400;

// A state on a path and the step taken there. The path continues with one of the step's outcomes.
struct Leg {
  StateId from;
  Transition transition;
};
using Way = std::vector<Leg>;

class FirstTreeSearch {
 public:
  explicit FirstTreeSearch(KnowledgeSpace& space)
      : space_(space), graph_(space.task()), sub_plans_(space) {}

  FirstTree Run() {
    FirstTree result;
    const StateId initial = space_.initial();
    const auto root = Solve(initial);
    if (root) {
      result.tree = Trimmed({sub_plans_.nodes(), *root});
    } else {
      result.is_proof_of_none = banned_.empty() && !space_.budget().Exhausted();
    }
    return result;
  }

 private:
  std::optional<NodeId> Solved(StateId state) {
    if (space_.IsGoal(state)) return sub_plans_.Goal();
    return sub_plans_.Find(state);
  }

  std::optional<NodeId> Solve(StateId state) {
    if (const auto solved = Solved(state)) return solved;
    if (failed_.contains(state) || !in_progress_.insert(state).second) return std::nullopt;
    std::optional<NodeId> plan;
    while (!plan && !space_.budget().Exhausted()) {
      const auto way = FindWay(state);
      if (!way) break;
      plan = Complete(*way);
    }
    in_progress_.erase(state);
    if (!plan) failed_.insert(state);
    return plan;
  }

  // Completes sub-plans for all states on the path, beginning at the end of the path. If another
  // outcome of a step leads nowhere, the function bans this step and returns none.
  std::optional<NodeId> Complete(const Way& way) {
    std::optional<NodeId> plan;
    for (auto leg = way.rbegin(); leg != way.rend(); ++leg) {
      std::vector<NodeId> children;
      for (const StateId outcome : leg->transition.outcomes) {
        const auto child = Solve(outcome);
        if (!child) {
          banned_[leg->from].push_back(leg->transition.step);
          return std::nullopt;
        }
        children.push_back(*child);
      }
      plan = Solved(leg->from);
      if (!plan) plan = sub_plans_.Add(leg->from, leg->transition, children);
    }
    return plan;
  }

  // ---- Search for one path, with the best outcomes of sensing

  using Arrivals = std::unordered_map<StateId, Leg>;  // by the state that the leg leads to

  std::optional<Way> FindWay(StateId from) {
    if (!sub_plans_.IsEmpty()) {
      if (auto way = FindWayWithoutSensing(from)) return way;
    }
    return FindWayByHeuristic(from);
  }

  static Way WayTo(StateId to, StateId from, const Arrivals& arrivals) {
    Way way;
    while (to != from) {
      way.push_back(arrivals.at(to));
      to = way.back().from;
    }
    std::reverse(way.begin(), way.end());
    return way;
  }

  bool IsBanned(StateId state, const Step& step) const {
    const auto banned = banned_.find(state);
    return banned != banned_.end() &&
           std::find(banned->second.begin(), banned->second.end(), step) != banned->second.end();
  }

  // Searches breadth first by steps that have only one outcome.
  std::optional<Way> FindWayWithoutSensing(StateId from) {
    Arrivals arrivals = {{from, {}}};
    std::vector<StateId> reached = {from};
    for (std::size_t next = 0; next < reached.size() && next < kStatesWithoutSensing; ++next) {
      const StateId state = reached[next];
      const std::vector<Step>& steps = space_.StepsFrom(state);
      for (std::size_t s = 0; s < steps.size(); ++s) {
        if (steps[s].kind != PlanNode::Kind::kAct || IsBanned(state, steps[s])) continue;
        const Transition* const transition = space_.Take(state, s);
        if (transition == nullptr) continue;
        const StateId outcome = transition->outcomes.front();
        if (failed_.contains(outcome) || in_progress_.contains(outcome)) continue;
        if (!arrivals.try_emplace(outcome, Leg{state, *transition}).second) continue;
        if (Solved(outcome)) return WayTo(outcome, from, arrivals);
        reached.push_back(outcome);
      }
    }
    return std::nullopt;
  }

  // An entry of a greedy search by the length of the relaxed plan. The nearest state comes first,
  // and its helpful steps are taken first. Its other steps come after the helpful steps of all
  // states that are as near. Equal entries keep their order.
  struct Candidate {
    int distance;
    bool is_helpful_taken;
    std::int64_t order;
    StateId state;

    bool operator<(const Candidate& other) const {  // the order is "worse than"
      return std::tie(distance, is_helpful_taken, order) >
             std::tie(other.distance, other.is_helpful_taken, other.order);
    }
  };

  std::optional<Way> FindWayByHeuristic(StateId from) {
    Arrivals arrivals = {{from, {}}};
    std::priority_queue<Candidate> open;
    open.push({PlanFrom(from).actions, false, 0, from});
    std::int64_t order = 0;
    while (!open.empty() && !space_.budget().Exhausted()) {
      Candidate here = open.top();
      open.pop();
      const std::vector<Step>& steps = space_.StepsFrom(here.state);
      for (std::size_t s = 0; s < steps.size(); ++s) {
        if (IsBanned(here.state, steps[s]) ||
            IsHelpful(steps[s], PlanFrom(here.state)) == here.is_helpful_taken) {
          continue;
        }
        const Transition* const transition = space_.Take(here.state, s);
        if (transition == nullptr) continue;
        for (const StateId outcome : transition->outcomes) {
          if (failed_.contains(outcome) || in_progress_.contains(outcome)) continue;
          if (!arrivals.try_emplace(outcome, Leg{here.state, *transition}).second) continue;
          if (Solved(outcome)) return WayTo(outcome, from, arrivals);
          open.push({PlanFrom(outcome).actions, false, ++order, outcome});
        }
      }
      if (!std::exchange(here.is_helpful_taken, true)) open.push(here);
    }
    return std::nullopt;
  }

  static bool IsHelpful(const Step& step, const RelaxedPlan& plan) {
    return step.kind != PlanNode::Kind::kAct ||
           std::binary_search(plan.helpful.begin(), plan.helpful.end(), step.action);
  }

  const RelaxedPlan& PlanFrom(StateId state) {
    const auto [entry, is_new] = relaxed_.try_emplace(state);
    if (is_new) entry->second = graph_.PlanFrom(space_.state(state));
    return entry->second;
  }

  KnowledgeSpace& space_;
  RelaxedKnowledgeGraph graph_;
  SubPlans sub_plans_;
  std::unordered_map<StateId, RelaxedPlan> relaxed_;
  std::unordered_map<StateId, std::vector<Step>> banned_;
  std::unordered_set<StateId> failed_;
  std::unordered_set<StateId> in_progress_;
};

}  // namespace

FirstTree FindFirstTree(KnowledgeSpace& space) { return FirstTreeSearch(space).Run(); }

}  // namespace assay::contingent
