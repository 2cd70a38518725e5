#include "planner/contingent/tree_check/tree_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <optional>
#include <set>
#include <utility>

#include "planner/contingent/grounding/ground_query.h"
#include "planner/contingent/plan_tree/tree_text.h"
#include "planner/contingent/tree_check/branch_cases.h"
#include "planner/contingent/tree_check/symbolic_check.h"
#include "planner/contingent/tree_check/tree_failure.h"
#include "planner/contingent/tree_check/world_cover.h"
#include "planner/contingent/world_sets/initial_worlds.h"
#include "planner/contingent/world_sets/world_progression.h"

namespace assay::contingent {
namespace {

// Limits that stop the check of a wrong tree. kMostWorlds limits the number of worlds on one path.
// If four times the number of initial worlds is more, this number is the limit instead. When a
// world is back where a repeat begins, the check follows it through the repeat again and again.
// kMostReturns limits the number of different worlds that come back in this way.
constexpr std::size_t kMostWorlds = 1'000'000;
constexpr std::size_t kMostReturns = 100'000;
// The greatest number of knowledge states with which the repeats of one tree begin again.
constexpr std::size_t kMostBeginnings = 1'000;
// The greatest number of worlds that are each followed among the others.
constexpr std::size_t kMostFollowed = 2'000;

class Runner {
 public:
  Runner(const GroundTask& task, const PlanTree& tree, const NumberMarks& marks, bool were_drawn,
         std::size_t most_worlds)
      : task_(task),
        tree_(tree),
        loops_(LoopsOf(tree)),
        is_monotone_(IsMonotone(task)),
        happens_by_knowledge_(HappensByKnowledge(task)),
        progression_(task, marks, were_drawn || !marks.AreComplete(), most_worlds),
        cover_(task, progression_),
        failure_(task, progression_, were_drawn, most_worlds) {
    check_.were_drawn = were_drawn;
    check_.are_numbers_sampled = !marks.AreComplete();
  }

  TreeCheck Run(Worlds initial) {
    History history;
    history.worlds = std::move(initial);
    history.sensed.insert(task_.initial.sensed.begin(), task_.initial.sensed.end());
    history.values_sensed = task_.initial.values_sensed;
    is_reached_.assign(tree_.nodes.size(), false);
    for (const PlanNode& node : tree_.nodes) {
      for (std::size_t i = 0; i < node.children.size(); ++i) {
        if (node.Repeats(i)) repeated_.insert(node.children[i]);
      }
    }
    progression_.Update(history);
    failure_.FailIfTwoValued(history);
    if (history.worlds.empty()) failure_.Fail("the initial knowledge allows no world", history);
    RunFrom(tree_.root, std::move(history));
    check_.holds = !failure_.HasHappened();
    check_.failure = failure_.Text();
    for (std::size_t i = 0; i < is_reached_.size(); ++i) {
      if (!is_reached_[i]) check_.unreached.push_back(NodeId(i));
    }
    return std::move(check_);
  }

 private:
  // ---- Walking the tree

  // The continuation of some worlds at a node, with their history.
  struct Way {
    NodeId to;
    History history;
    std::string outcome = {};  // the outcome of the branch that leads there
    bool is_repeat = false;    // the child is a node above
    bool is_counted = false;   // true if the worlds have come this way before and were counted
    std::size_t steps_above = 0;
    std::size_t heads_above = 0;
  };

  // Searches depth first without recursion, because the depth of a tree is limited only by its
  // file.
  void RunFrom(NodeId id, History history) {
    const std::size_t others = ways_.size();
    const std::size_t steps_above = failure_.depth();
    GoOn({.to = id, .history = std::move(history)});
    while (ways_.size() > others && !failure_.HasHappened()) {
      Way way = std::move(ways_.back());
      ways_.pop_back();
      failure_.GoBack(way.steps_above);
      heads_.resize(way.heads_above);
      if (!way.outcome.empty()) failure_.Step(way.outcome);
      if (way.is_repeat) {
        Return(way.to, way);
      } else {
        Walk(std::move(way));
      }
    }
    failure_.GoBack(steps_above);
  }

  void GoOn(Way way) {
    way.steps_above = failure_.depth();
    way.heads_above = heads_.size();
    ways_.push_back(std::move(way));
  }

  void Walk(Way way) {
    History& history = way.history;
    for (NodeId id = way.to; !failure_.HasHappened() && IsFollowed(history);) {
      const PlanNode& node = tree_.node(id);
      is_reached_[id.index()] = true;
      if (attempt_ == nullptr && IsRepeated(id)) Begin(id, history);
      if (attempt_ != nullptr && loops_[id.index()] != attempt_->loop) {
        attempt_->has_ended = true;
        return;
      }
      switch (node.kind) {
        case PlanNode::Kind::kGoal:
          return End(way);
        case PlanNode::Kind::kAct:
          Execute(task_.actions[node.action.index()], history);
          if (node.Repeats(0)) return Return(node.children.front(), way);
          id = node.children.front();
          break;
        case PlanNode::Kind::kWhether:
        case PlanNode::Kind::kValue:
          return Branch(node, way);
      }
    }
  }

  void End(const Way& way) {
    if (attempt_ != nullptr) {
      attempt_->has_ended = true;
      return;
    }
    if (!Holds(task_.goal, way.history)) failure_.Fail("the goal is not known", way.history);
    if (!way.is_counted) check_.worlds += static_cast<std::int64_t>(way.history.worlds.size());
  }

  static bool IsFollowed(const History& history) {
    return std::ranges::any_of(history.worlds, &World::is_followed);
  }

  bool IsRepeated(NodeId id) const { return repeated_.contains(id); }

  bool Holds(const GroundQuery& query, const History& history) const {
    return progression_.Ask(query, history) != Answer::kNo;
  }

  void Execute(const GroundAction& action, History& history) {
    // The precondition was checked for all worlds with this history. It need not be checked for one
    // world.
    if (attempt_ == nullptr && !Holds(action.precondition, history)) {
      return failure_.Fail(fmt::format("the precondition of {} is not known", TextOf(action)),
                           history);
    }
    failure_.Step(TextOf(action));
    progression_.Apply(action.effects, history);
    progression_.Update(history);
    failure_.FailIfTwoValued(history);
    if (attempt_ == nullptr && history.worlds.empty()) {
      failure_.Fail("what is known contradicts itself", history);
    }
  }

  void Branch(const PlanNode& node, Way& way) {
    History& history = way.history;
    const BranchCases cases(task_, node);
    cases.Split(progression_, history.worlds);
    std::vector<Worlds> parts(node.children.size());
    for (const World& world : history.worlds) {
      const int part = cases.ChildFor(progression_, world);
      if (part < 0) return failure_.Fail("no branch is for this value", history, &world);
      parts[part].push_back(world);
    }
    if (!IsAsked(node, cases, history, parts)) return;
    for (std::size_t i = parts.size(); i-- > 0;) {  // the part that is added last is run next
      if (parts[i].empty()) continue;
      History next = history;
      next.worlds = std::move(parts[i]);
      progression_.Update(next);
      if (next.worlds.empty()) return failure_.Fail("what is known contradicts itself", next);
      GoOn({.to = node.children[i],
            .history = std::move(next),
            .outcome = "branch " + OutcomeText(task_, node, i),
            .is_repeat = node.Repeats(i),
            .is_counted = way.is_counted});
    }
  }

  // Returns true if the branch's question has been sensed or has only one answer.
  bool IsAsked(const PlanNode& node, const BranchCases& cases, const History& history,
               const std::vector<Worlds>& parts) {
    const auto answers =
        std::count_if(parts.begin(), parts.end(), [](const Worlds& w) { return !w.empty(); });
    const bool is_sensed = node.kind == PlanNode::Kind::kWhether
                               ? history.sensed.contains(node.formula)
                               : history.values_sensed.contains(node.function);
    if (answers > 1 && !is_sensed) {
      failure_.Fail(fmt::format("a branch on {}, which has not been sensed,", cases.Question()),
                    history);
    }
    return !failure_.HasHappened();
  }

  void Return(NodeId head, const Way& way) {
    const History& history = way.history;
    if (attempt_ != nullptr) {
      for (const World& world : history.worlds) {
        if (world.is_followed) Follow(head, world, history);
      }
      return;
    }
    const History* begun = Begun(head);
    if (begun == nullptr) return failure_.Fail("a repeat that never began", history);
    is_monotone_ ? ReturnToWorlds(head, History(*begun), history) : ReturnKnowing(head, history);
  }

  void ReturnToWorlds(NodeId head, const History& begun, const History& history);
  void ReturnKnowing(NodeId head, const History& history);
  bool CanEnd(NodeId head, const World& world, const History& history);
  void Follow(NodeId head, const World& world, const History& history);

  void Begin(NodeId head, const History& history) {
    heads_.emplace_back(head, history);
    if (!is_monotone_) beginnings_.emplace(head, cover_.ToCompare(history));
  }

  // Returns the history that last came to the head of a repeat on this path, or null if there is
  // none.
  const History* Begun(NodeId head) const {
    const auto entry = std::find_if(heads_.rbegin(), heads_.rend(),
                                    [&](const auto& begun) { return begun.first == head; });
    return entry == heads_.rend() ? nullptr : &entry->second;
  }

  // The state of a search round a repeat in one world.
  struct Attempt {
    LoopId loop;
    std::set<std::pair<NodeId, History>> returned = {};  // arrivals at the heads of repeats
    std::deque<std::pair<NodeId, History>> to_follow = {};
    bool has_ended = false;  // true at the goal or outside the loop
  };

  const GroundTask& task_;
  const PlanTree& tree_;
  std::vector<LoopId> loops_;  // indexed by node
  bool is_monotone_;
  bool happens_by_knowledge_;
  WorldProgression progression_;
  WorldCover cover_;
  TreeFailure failure_;
  Attempt* attempt_ = nullptr;
  std::vector<Way> ways_;  // the open continuations; the next one is last
  std::vector<bool> is_reached_;
  std::set<NodeId> repeated_;
  std::vector<std::pair<NodeId, History>> heads_;  // the heads of repeats on the path to the node
  // the beginnings of repeats where more knowledge may do harm
  std::set<std::pair<NodeId, History>> beginnings_;
  TreeCheck check_;
};

// Checks that the worlds come back to worlds in which the repeat began, or to cases of them, and
// that each of them can continue to the goal. If less has been sensed than at the beginning, the
// repeat is run again with the facts that were sensed both times. These facts become fewer each
// time, so the repetition ends.
void Runner::ReturnToWorlds(NodeId head, const History& begun, const History& history) {
  for (const World& world : history.worlds) {
    if (!cover_.IsCovered(world, begun.worlds))
      return failure_.Fail("a repeat begins in another world", history, &world);
    if (!CanEnd(head, world, history))
      return failure_.Fail("a repeat without end", history, &world);
  }
  if (HasSensed(history, begun)) return;
  GoOn({.to = head, .history = WithSensedOf(history, begun), .is_counted = true});
}

// Where more knowledge may do harm, the repeat begins again with each knowledge that comes back.
void Runner::ReturnKnowing(NodeId head, const History& history) {
  if (happens_by_knowledge_ && history.worlds.size() > kMostFollowed) {
    return failure_.Fail(
        fmt::format("a repeat of more than {} worlds, where what happens depends on what "
                    "is known,",
                    kMostFollowed),
        history);
  }
  for (const World& world : history.worlds) {
    if (!CanEnd(head, world, history))
      return failure_.Fail("a repeat without end", history, &world);
  }
  if (!beginnings_.emplace(head, cover_.ToCompare(history)).second) return;
  if (beginnings_.size() > kMostBeginnings) {
    return failure_.Fail(
        fmt::format("a repeat that begins with more than {} kinds of knowledge", kMostBeginnings),
        history);
  }
  GoOn({.to = head, .history = history, .is_counted = true});
}

// Returns true if a world that is back at the head of a repeat reaches the goal for some outcomes
// of the open facts. The check follows this world round the loop until it leaves the loop or has
// been everywhere. The world need not be followed further: it is a case of the worlds that began
// the repeat, or the repeat begins again with it. In both cases these worlds are run to the end.
// Each repeat in a sequence of repeats is therefore followed separately. Other worlds are included
// where it matters that the world is not known to be this one.
bool Runner::CanEnd(NodeId head, const World& world, const History& history) {
  Attempt attempt{.loop = loops_[head.index()]};
  attempt_ = &attempt;
  Follow(head, world, history);
  while (!attempt.has_ended && !failure_.HasHappened() && !attempt.to_follow.empty()) {
    const auto [at, alone] = std::move(attempt.to_follow.front());
    attempt.to_follow.pop_front();
    RunFrom(at, alone);
  }
  attempt_ = nullptr;
  return attempt.has_ended;
}

// Numbers of which nothing is known initially may change on each round, so they are not compared.
void Runner::Follow(NodeId head, const World& world, const History& history) {
  const History* begun = Begun(head);
  if (is_monotone_ && begun != nullptr && !cover_.IsCovered(world, begun->worlds)) {
    return failure_.Fail("a repeat begins in another world", history, &world);
  }
  History alone = history;
  if (!happens_by_knowledge_) alone.worlds = {world};
  for (World& other : alone.worlds) other.is_followed = other == world;
  History seen = cover_.ToCompare(alone);
  if (is_monotone_) {
    seen.sensed.clear();
    seen.values_sensed.clear();
  }
  if (!attempt_->returned.emplace(head, std::move(seen)).second) return;
  if (attempt_->returned.size() > kMostReturns) {
    return failure_.Fail(fmt::format("a repeat through more than {} worlds", kMostReturns),
                         history);
  }
  attempt_->to_follow.emplace_back(head, std::move(alone));
}

}  // namespace

TreeCheck CheckTree(const GroundTask& task, const PlanTree& tree, const TreeCheckOptions& options) {
  const NumberMarks marks(task, tree);
  InitialWorlds initial = EnumerateWorlds(task, marks, options.worlds, options.seed);
  if (initial.were_drawn) {
    if (const std::optional<TreeCheck> check = CheckBySets(task, tree)) return *check;
  }
  const std::size_t most_worlds = std::max(kMostWorlds, 4 * initial.worlds.size());
  return Runner(task, tree, marks, initial.were_drawn, most_worlds).Run(std::move(initial.worlds));
}

}  // namespace assay::contingent
