#include "planner/contingent/search/exhaustive_tree.h"

#include <algorithm>
#include <limits>
#include <queue>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "planner/contingent/search/node_table.h"

namespace assay::contingent {
namespace {

constexpr int kFar = std::numeric_limits<int>::max();
// depths are computed again when the number of states has grown by this factor
constexpr double kGrowth = 1.2;
// the greatest number of nodes above each other in a tree with repeats
constexpr int kDeepestRepeat = 2000;

// Returns the atoms that an effect changes only in some worlds, so they may become unknown
// without a change. The values of functions are included because they depend on each other.
std::unordered_set<AtomId> ConditionallyChanged(const GroundTask& task) {
  std::unordered_set<AtomId> atoms;
  const auto add = [&](const std::vector<GroundEffect>& effects, bool are_all) {
    for (const GroundEffect& effect : effects) {
      for (const GroundChange& change : effect.changes) {
        if (are_all || !effect.condition.IsTrue()) atoms.insert(change.literal.atom);
        for (const GroundLiteral& l : change.literals) atoms.insert(l.atom);
      }
    }
  };
  for (const GroundAction& action : task.actions) add(action.effects, false);
  add(task.updates, true);
  for (const GroundFunction& function : task.functions) {
    atoms.insert(function.values.begin(), function.values.end());
  }
  return atoms;
}

// Returns the number of actions in a transition.
int CostOf(const Transition& transition) {
  return transition.step.kind == PlanNode::Kind::kAct ? 1 : 0;
}

class ExhaustiveTreeSearch {
 public:
  explicit ExhaustiveTreeSearch(KnowledgeSpace& space)
      : space_(space),
        initial_(space.initial()),
        conditionally_changed_(ConditionallyChanged(space.task())),
        tells_something_(TellsSomething(space.task())) {}

  ExhaustiveTree Run() {
    std::vector<StateId> layer = {initial_};
    std::size_t goals = 0;
    double states = 0;
    for (int depth = 0; !layer.empty(); ++depth) {
      layer = Expand(layer);
      if (space_.budget().Exhausted()) return {};
      // Depths change when new goals are found, and seldom otherwise. So they are not computed for
      // every layer.
      const auto states_now = static_cast<double>(transitions_.size());
      const bool is_due = goals_.size() > goals || states_now > kGrowth * states;
      if (!is_due && !layer.empty()) continue;
      goals = goals_.size();
      states = states_now;
      ComputeDepths();
      // Any tree that is not deeper than this consists of visited states.
      if (DepthOf(initial_) <= depth) return {.tree = LeastDeepTree()};
    }
    if (DepthOf(initial_) < kFar) return {.tree = LeastDeepTree(), .is_complete = true};
    if (auto tree = RepeatingTree()) return {.tree = std::move(tree), .repeats = true};
    if (!LeadsToTheGoal(Repeats::kAll)) return {.is_complete = true};
    return {.doubt =
                "a plan may have repeats of which this planner cannot show that they end, or more "
                "than 2,000 steps above each other"};
  }

 private:
  // Visits the states and the states that branches lead to. Returns the states that actions lead
  // to.
  std::vector<StateId> Expand(std::vector<StateId> states) {
    std::vector<StateId> next;
    while (!states.empty()) {
      const StateId state = states.back();
      states.pop_back();
      if (!transitions_.try_emplace(state).second || space_.budget().Exhausted()) continue;
      if (space_.IsGoal(state)) {
        goals_.push_back(state);
        continue;
      }
      const std::size_t steps = space_.StepsFrom(state).size();
      for (std::size_t step = 0; step < steps; ++step) {
        const Transition* const transition = space_.Take(state, step);
        if (transition == nullptr) continue;
        std::vector<StateId>& to = CostOf(*transition) > 0 ? next : states;
        to.insert(to.end(), transition->outcomes.begin(), transition->outcomes.end());
        transitions_[state].push_back(*transition);
      }
    }
    std::sort(next.begin(), next.end());
    next.erase(std::unique(next.begin(), next.end()), next.end());
    return next;
  }

  int DepthOf(StateId state) const {
    const auto found = depths_.find(state);
    return found != depths_.end() ? found->second.depth : kFar;
  }

  // Computes least depths from the goals backward (Knuth 1977, a generalization of Dijkstra's
  // algorithm). A transition is as deep as the deepest of its outcomes. The depth of a transition
  // is known when the depth of its last outcome is known.
  void ComputeDepths() {
    depths_.clear();
    std::unordered_map<StateId, std::vector<std::pair<StateId, int>>> leading_to;
    std::unordered_map<StateId, std::vector<std::size_t>> missing;
    for (const auto& [state, transitions] : transitions_) {
      for (std::size_t t = 0; t < transitions.size(); ++t) {
        missing[state].push_back(transitions[t].outcomes.size());
        for (const StateId outcome : transitions[t].outcomes) {
          leading_to[outcome].emplace_back(state, static_cast<int>(t));
        }
      }
    }
    using Entry = std::tuple<int, int, StateId>;  // depth, transition, state
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    for (const StateId goal : goals_) open.emplace(0, -1, goal);
    while (!open.empty()) {
      const auto [depth, best, state] = open.top();
      open.pop();
      if (!depths_.try_emplace(state, Least{depth, best}).second) continue;
      for (const auto& [before, t] : leading_to[state]) {
        if (--missing[before][t] > 0) continue;
        open.emplace(depth + CostOf(transitions_[before][t]), t, before);
      }
    }
  }

  PlanTree LeastDeepTree() {
    std::unordered_map<StateId, NodeId> made;
    const NodeId root = MakeLeastDeep(initial_, made);
    return Trimmed({nodes_.nodes(), root});
  }

  NodeId MakeLeastDeep(StateId state, std::unordered_map<StateId, NodeId>& made) {
    if (const auto found = made.find(state); found != made.end()) return found->second;
    const int best = depths_.at(state).transition;
    PlanNode node;
    if (best >= 0) {
      const Transition& transition = transitions_[state][best];
      std::vector<NodeId> children;
      for (const StateId outcome : transition.outcomes) {
        children.push_back(MakeLeastDeep(outcome, made));
      }
      node = NodeOf(transition, children);
    }
    return made[state] = nodes_.Intern(std::move(node));
  }

  // ---- Repeats

  // The branches that may be repeated until one of their outcomes comes.
  enum class Repeats {
    kFair,  // those of which IsFair says that every outcome comes some time
    kAll,
  };

  // Returns whether there is a tree with such repeats, whose size is not limited. The function
  // repeatedly removes the states from which transitions among the remaining states cannot reach
  // the goal. `choice_` then contains the remaining states, each with the transition that leads
  // nearest to the goal.
  bool LeadsToTheGoal(Repeats repeats) {
    choice_.clear();
    for (std::size_t before = 0; before != choice_.size() || before == 0;) {
      before = choice_.size();
      ChooseByDistance(repeats, before == 0);
      if (!choice_.contains(initial_)) return false;
    }
    return true;
  }

  std::optional<PlanTree> RepeatingTree() {
    if (!LeadsToTheGoal(Repeats::kFair)) return std::nullopt;
    const Made root = MakeRepeating(initial_, 0);
    if (root.node.IsNone()) return std::nullopt;
    return PlanTree{nodes_.nodes(), root.node};
  }

  // Searches breadth first from the goals, by transitions all of whose outcomes may stay. A fair
  // transition leads nearer if one of its outcomes is nearer. Any other transition leads nearer if
  // all outcomes are nearer.
  void ChooseByDistance(Repeats repeats, bool may_all_stay) {
    std::unordered_map<StateId, std::vector<std::pair<StateId, int>>> leading_to;
    std::unordered_map<StateId, std::vector<std::size_t>> missing;
    for (std::size_t s = 0; s < space_.size(); ++s) {
      const StateId state(s);
      if (!may_all_stay && !choice_.contains(state)) continue;
      const std::vector<Transition>& transitions = transitions_[state];
      for (std::size_t t = 0; t < transitions.size(); ++t) {
        const std::vector<StateId>& outcomes = transitions[t].outcomes;
        const bool stays =
            may_all_stay || std::all_of(outcomes.begin(), outcomes.end(),
                                        [&](StateId o) { return choice_.contains(o); });
        const bool is_fair = repeats == Repeats::kAll || IsFair(state, transitions[t]);
        missing[state].push_back(is_fair ? 1 : outcomes.size());
        if (!stays) continue;
        for (const StateId o : outcomes) leading_to[o].emplace_back(state, static_cast<int>(t));
      }
    }
    std::unordered_map<StateId, int> chosen;
    std::vector<StateId> reached = goals_;
    for (const StateId goal : goals_) chosen[goal] = -1;
    for (std::size_t next = 0; next < reached.size(); ++next) {
      for (const auto& [before, t] : leading_to[reached[next]]) {
        std::size_t& left = missing[before][t];
        if (left == 0 || --left > 0) continue;
        if (chosen.try_emplace(before, t).second) reached.push_back(before);
      }
    }
    choice_ = std::move(chosen);
  }

  // Returns true if, in every world, each outcome occurs some time when the branch is repeated for
  // ever. This holds if the branch's atom has no relation to any other atom, and if only forgetting
  // makes it unknown again. An asserted fact after one outcome can rule out this outcome in some
  // worlds. So no transition is fair in a task whose effects assert anything.
  bool IsFair(StateId state, const Transition& transition) {
    if (transition.step.kind != PlanNode::Kind::kWhether || tells_something_) return false;
    KnowledgeBase& knowledge = space_.knowledge();
    const KnowledgeState& here = space_.state(state);
    const auto literals = knowledge.UndeterminedLiterals(transition.step.formula, here);
    if (literals.size() != 1) return false;  // the formula is a bound or a conjunction
    const AtomId atom = literals.front().atom;
    return knowledge.RelationOf(here, atom) == kAllSets && !conditionally_changed_.contains(atom);
  }

  struct Made {
    NodeId node;
    int highest = kFar;  // the path index of the highest node that the tree leads back to
  };

  // Makes the tree from a state at this depth of the path. A tree that leads back to nodes above it
  // is made again for each path that reaches it, so that every repeat begins on its own path.
  Made MakeRepeating(StateId state, int depth) {
    if (const auto found = closed_.find(state); found != closed_.end()) return {found->second};
    if (depth > kDeepestRepeat) return {};
    const int choice = choice_.at(state);
    if (choice < 0) return {closed_[state] = nodes_.Append({})};
    const NodeId id = nodes_.Append({});
    path_[state] = {id, depth};
    const Transition& transition = transitions_[state][choice];
    Made made{id};
    std::vector<NodeId> children;
    std::vector<bool> repeats;
    for (const StateId outcome : transition.outcomes) {
      const auto above = path_.find(outcome);
      repeats.push_back(above != path_.end());
      const Made child = repeats.back() ? Made{above->second.first, above->second.second}
                                        : MakeRepeating(outcome, depth + 1);
      if (child.node.IsNone()) return {};
      children.push_back(child.node);
      made.highest = std::min(made.highest, child.highest);
    }
    path_.erase(state);
    nodes_.node(id) = NodeOf(transition, children);
    if (std::find(repeats.begin(), repeats.end(), true) != repeats.end()) {
      nodes_.node(id).repeats = repeats;
    }
    if (made.highest >= depth) {
      made.highest = kFar;
      closed_[state] = id;
    }
    return made;
  }

  struct Least {
    int depth;
    int transition;  // -1 at goals
  };

  KnowledgeSpace& space_;
  StateId initial_;
  std::unordered_set<AtomId> conditionally_changed_;
  bool tells_something_;
  // transitions of visited states
  std::unordered_map<StateId, std::vector<Transition>> transitions_;
  std::vector<StateId> goals_;
  std::unordered_map<StateId, Least> depths_;
  NodeTable nodes_;
  std::unordered_map<StateId, int> choice_;
  std::unordered_map<StateId, NodeId> closed_;  // trees that lead back to no node above them
  std::unordered_map<StateId, std::pair<NodeId, int>> path_;
};

}  // namespace

ExhaustiveTree FindExhaustiveTree(KnowledgeSpace& space) {
  return ExhaustiveTreeSearch(space).Run();
}

}  // namespace assay::contingent
