#include "planner/contingent/tree_check.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <set>
#include <utility>

#include "planner/contingent/initial_worlds.h"
#include "planner/contingent/symbolic_check.h"

namespace assay::contingent {
namespace {

using Worlds = std::vector<World>;

// What a wrong tree may take: worlds on one way, unless more are there to begin with, and worlds in
// which one repeat is followed from one world.
constexpr std::size_t kMostWorlds = 1'000'000;
constexpr std::size_t kMostReturns = 100'000;

// The worlds that one history leads to, and what has been sensed on it.
struct History {
  Worlds worlds;
  std::set<FormulaId> sensed;
  std::map<FunctionId, double> values_sensed;  // with their errors
  std::vector<std::string> steps;
};

bool Compare(double value, Relation relation, double with) {
  switch (relation) {
    case Relation::kLess:
      return value < with;
    case Relation::kLessOrEqual:
      return value <= with;
    case Relation::kGreater:
      return value > with;
    case Relation::kGreaterOrEqual:
      return value >= with;
    case Relation::kPredicate:
    case Relation::kExtern:
    case Relation::kEqual:
      break;
  }
  return value == with;
}

class Runner {
 public:
  Runner(const GroundTask& task, const PlanTree& tree) : task_(task), tree_(tree) {}

  TreeCheck Run(InitialWorlds initial) {
    TreeCheck check;
    check.are_all_worlds = initial.are_all;
    History history;
    history.worlds = std::move(initial.worlds);
    most_worlds_ = std::max(kMostWorlds, 4 * history.worlds.size());
    history.sensed.insert(task_.initial.sensed.begin(), task_.initial.sensed.end());
    for (const FunctionId function : task_.initial.values_sensed) {
      history.values_sensed[function] = 0;
    }
    is_reached_.assign(tree_.nodes.size(), false);
    for (const PlanNode& node : tree_.nodes) {
      for (std::size_t i = 0; i < node.children.size(); ++i) {
        if (node.Repeats(i)) repeated_.insert(node.children[i]);
      }
    }
    Update(history);
    RunFrom(tree_.root, std::move(history));
    check.holds = failure_.empty();
    check.failure = failure_;
    check.worlds = worlds_;
    for (std::size_t i = 0; i < is_reached_.size(); ++i) {
      if (!is_reached_[i]) check.unreached.push_back(NodeId(i));
    }
    return check;
  }

 private:
  void Fail(const std::string& what, const History& history, const World* world = nullptr) {
    if (!failure_.empty()) return;
    failure_ = fmt::format(
        "{} after {}", what,
        history.steps.empty() ? "no step" : fmt::format("{}", fmt::join(history.steps, "; ")));
    if (world == nullptr && !history.worlds.empty()) world = &history.worlds.front();
    if (world != nullptr) failure_ += fmt::format(", in the world with {}", TextOf(*world));
  }

  std::string TextOf(const World& world) const {
    std::vector<std::string> texts;
    for (std::size_t a = 0; a < task_.atoms.size(); ++a) {
      if (world.atoms[a] == Truth::kTrue) texts.push_back(task_.atoms[a]);
    }
    for (std::size_t slot = 0; slot < world.numbers.size(); ++slot) {
      const FunctionId function = task_.function_of_slot[slot];
      texts.push_back(
          fmt::format("{} = {}", task_.functions[function.index()].text, world.numbers[slot]));
    }
    return fmt::format("{}", fmt::join(texts, ", "));
  }

  // ---- Walking the tree

  void RunFrom(NodeId id, History history) {
    const std::size_t heads_above = heads_.size();
    Walk(id, std::move(history));
    heads_.resize(heads_above);
  }

  void Walk(NodeId id, History history) {
    while (failure_.empty() && !history.worlds.empty()) {
      const PlanNode& node = tree_.node(id);
      is_reached_[id.index()] = true;
      if (attempt_ == nullptr && IsRepeated(id)) heads_.emplace_back(id, history);
      switch (node.kind) {
        case PlanNode::Kind::kGoal:
          if (!IsKnown(task_.goal, history)) Fail("the goal is not known", history);
          if (attempt_ != nullptr) {
            attempt_->has_ended = true;
          } else {
            worlds_ += static_cast<std::int64_t>(history.worlds.size());
          }
          return;
        case PlanNode::Kind::kAct:
          Execute(task_.actions[node.action.index()], history);
          if (node.Repeats(0)) return Return(node.children.front(), history);
          id = node.children.front();
          break;
        case PlanNode::Kind::kWhether:
        case PlanNode::Kind::kValue:
          Branch(node, std::move(history));
          return;
      }
    }
  }

  bool IsRepeated(NodeId id) const { return repeated_.contains(id); }

  void Branch(const PlanNode& node, History history) {
    const auto cases = CasesOf(node);
    for (std::size_t i = 0; i < cases.size(); ++i) {
      for (const GroundLiteral& literal : cases[i]) SplitBy(literal.atom, history.worlds);
    }
    std::vector<Worlds> parts(node.children.size());
    for (const World& world : history.worlds) {
      const int part = PartOf(node, cases, world);
      if (part < 0) return Fail("no branch is for this value", history, &world);
      parts[part].push_back(world);
    }
    if (!IsAsked(node, history, parts)) return;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      if (parts[i].empty() || !failure_.empty()) continue;
      History next = history;
      next.worlds = std::move(parts[i]);
      next.steps.push_back(fmt::format("outcome {} of {}", i + 1, QuestionOf(node)));
      Update(next);
      if (node.Repeats(i)) {
        Return(node.children[i], next);
      } else {
        RunFrom(node.children[i], std::move(next));
      }
    }
  }

  std::string QuestionOf(const PlanNode& node) const {
    return node.kind == PlanNode::Kind::kValue
               ? task_.functions[node.function.index()].text
               : assay::contingent::TextOf(task_, task_.formulas[node.formula.index()]);
  }

  // By child what holds there, of a function; of a formula its literals alone.
  std::vector<std::vector<GroundLiteral>> CasesOf(const PlanNode& node) const {
    if (node.kind == PlanNode::Kind::kWhether) {
      return {task_.formulas[node.formula.index()].literals};
    }
    std::vector<std::vector<GroundLiteral>> cases;
    for (const AtomId value : node.values) cases.push_back({{value, true}});
    return cases;
  }

  int PartOf(const PlanNode& node, const std::vector<std::vector<GroundLiteral>>& cases,
             const World& world) const {
    if (node.kind == PlanNode::Kind::kWhether) {
      return IsTrue(task_.formulas[node.formula.index()], world) ? 0 : 1;
    }
    for (std::size_t i = 0; i < cases.size(); ++i) {
      if (IsTrue(cases[i].front(), world)) return static_cast<int>(i);
    }
    return -1;
  }

  // What is asked has been sensed, or there is one answer alone.
  bool IsAsked(const PlanNode& node, const History& history, const std::vector<Worlds>& parts) {
    const auto answers =
        std::count_if(parts.begin(), parts.end(), [](const Worlds& w) { return !w.empty(); });
    const bool is_sensed = node.kind == PlanNode::Kind::kWhether
                               ? history.sensed.contains(node.formula)
                               : history.values_sensed.contains(node.function);
    if (answers > 1 && !is_sensed) {
      Fail(fmt::format("a branch on {}, which has not been sensed,", QuestionOf(node)), history);
    }
    return failure_.empty();
  }

  // The worlds come back to where they, or worlds that they are cases of, began; and each of them
  // can go on to the goal. Where less has been sensed than then, that must be enough, too.
  void Return(NodeId head, const History& history) {
    if (attempt_ != nullptr) {
      for (const World& world : history.worlds) Follow(head, world, history);
      return;
    }
    const History* entry = Begun(head);
    if (entry == nullptr) return Fail("a repeat that never began", history);
    const History begun = *entry;
    for (const World& world : history.worlds) {
      if (!IsCovered(world, begun.worlds))
        return Fail("a repeat begins in another world", history, &world);
      if (!CanEnd(head, world, history)) return Fail("a repeat without end", history, &world);
    }
    if (!HasSensed(history, begun)) BeginAgain(head, begun, history);
  }

  // The history that last came to the head of a repeat, on the way to here; null if none has.
  const History* Begun(NodeId head) const {
    const auto entry = std::find_if(heads_.rbegin(), heads_.rend(),
                                    [&](const auto& begun) { return begun.first == head; });
    return entry == heads_.rend() ? nullptr : &entry->second;
  }

  static bool HasSensed(const History& history, const History& begun) {
    return std::ranges::includes(history.sensed, begun.sensed) &&
           std::ranges::all_of(begun.values_sensed, [&](const auto& value) {
             const auto known = history.values_sensed.find(value.first);
             return known != history.values_sensed.end() && known->second <= value.second;
           });
  }

  // With what has been sensed both times. It gets less each time, so that this ends.
  void BeginAgain(NodeId head, const History& begun, const History& history) {
    History both = begun;
    both.steps = history.steps;
    std::erase_if(both.sensed, [&](FormulaId f) { return !history.sensed.contains(f); });
    std::erase_if(both.values_sensed,
                  [&](const auto& value) { return !history.values_sensed.contains(value.first); });
    for (auto& [function, error] : both.values_sensed) {
      error = std::max(error, history.values_sensed.at(function));
    }
    const std::int64_t worlds = worlds_;  // these have been counted
    RunFrom(head, std::move(both));
    worlds_ = worlds;
  }

  // Whether a world that is back at the head of a repeat comes to the goal some time, for some
  // outcomes of what is open: by going round, in this world alone, until it has been everywhere.
  bool CanEnd(NodeId head, const World& world, const History& history) {
    Attempt attempt = {.steps = history.steps};
    attempt_ = &attempt;
    Follow(head, world, history);
    while (!attempt.has_ended && failure_.empty() && !attempt.to_follow.empty()) {
      const auto [at, alone] = std::move(attempt.to_follow.front());
      attempt.to_follow.pop_front();
      RunFrom(at, alone);
    }
    attempt_ = nullptr;
    return attempt.has_ended;
  }

  // Numbers of which nothing is known at first do not tell worlds apart: any other is as good, and
  // they may change on each round.
  void Follow(NodeId head, const World& world, const History& history) {
    if (const History* begun = Begun(head); begun && !IsCovered(world, begun->worlds)) {
      return Fail("a repeat begins in another world", history, &world);
    }
    World without_open = world;
    for (std::size_t slot = 0; slot < world.numbers.size(); ++slot) {
      if (IsOpen(slot)) without_open.numbers[slot] = 0;
    }
    if (!attempt_->returned.emplace(head, std::move(without_open)).second) return;
    if (attempt_->returned.size() > kMostReturns) {
      return Fail(fmt::format("a repeat through more than {} worlds", kMostReturns), history);
    }
    History alone = history;
    alone.worlds = {world};
    alone.steps = attempt_->steps;
    attempt_->to_follow.emplace_back(head, std::move(alone));
  }

  bool IsOpen(std::size_t slot) const {
    const Range& range = task_.initial.ranges[slot];
    return std::isinf(range.low) && std::isinf(range.high);
  }

  // Numbers of which nothing is known at first are not compared: any other is as good.
  bool IsCaseOf(const World& world, const World& of) const {
    for (std::size_t a = 0; a < world.atoms.size(); ++a) {
      if (of.atoms[a] != Truth::kEither && of.atoms[a] != world.atoms[a]) return false;
    }
    for (std::size_t slot = 0; slot < world.numbers.size(); ++slot) {
      if (!IsOpen(slot) && world.numbers[slot] != of.numbers[slot]) return false;
    }
    return true;
  }

  // Whether the world, or both of its cases by some atom, and so on, are cases of the worlds.
  bool IsCovered(const World& world, const Worlds& by) {
    if (std::any_of(by.begin(), by.end(), [&](const World& w) { return IsCaseOf(world, w); })) {
      return true;
    }
    for (std::size_t a = 0; a < world.atoms.size(); ++a) {
      const bool tells_apart = world.atoms[a] == Truth::kEither &&
                               std::any_of(by.begin(), by.end(), [&](const World& w) {
                                 return w.atoms[a] != Truth::kEither;
                               });
      if (!tells_apart) continue;
      Worlds cases = {world};
      SplitBy(AtomId(a), cases);
      return std::all_of(cases.begin(), cases.end(),
                         [&](const World& w) { return IsCovered(w, by); });
    }
    return false;
  }

  // ---- What is true, and what is known

  static bool IsTrue(GroundLiteral literal, const World& world) {
    return world.atoms[literal.atom.index()] ==
           (literal.is_positive ? Truth::kTrue : Truth::kFalse);
  }

  bool IsTrue(const Bound& bound, const World& world) const {
    return Compare(world.numbers[task_.functions[bound.function.index()].slot], bound.relation,
                   bound.value);
  }

  bool IsTrue(const Formula& formula, const World& world) const {
    if (formula.bound) return IsTrue(*formula.bound, world);
    return std::all_of(formula.literals.begin(), formula.literals.end(),
                       [&](const GroundLiteral& l) { return IsTrue(l, world); });
  }

  // Of a condition that asks K of literals alone: whether they hold in this world.
  bool IsTrue(const GroundQuery& condition, const World& world) const {
    const auto is_true = [&](const GroundQuery& operand) { return IsTrue(operand, world); };
    const auto& operands = condition.operands;
    if (condition.kind == GroundQuery::Kind::kKnown) return IsTrue(condition.literal, world);
    if (condition.kind == GroundQuery::Kind::kAnd) {
      return std::all_of(operands.begin(), operands.end(), is_true);
    }
    return std::any_of(operands.begin(), operands.end(), is_true);
  }

  bool IsKnown(const GroundQuery& query, const History& history) const {
    const auto is_known = [&](const GroundQuery& operand) { return IsKnown(operand, history); };
    const auto in_all = [&](const auto& what) {
      return std::all_of(history.worlds.begin(), history.worlds.end(),
                         [&](const World& world) { return IsTrue(what, world); });
    };
    switch (query.kind) {
      case GroundQuery::Kind::kAnd:
        return std::all_of(query.operands.begin(), query.operands.end(), is_known);
      case GroundQuery::Kind::kOr:
        return std::any_of(query.operands.begin(), query.operands.end(), is_known);
      case GroundQuery::Kind::kNot:
        return true;
      case GroundQuery::Kind::kKnown:
        return in_all(query.literal);
      case GroundQuery::Kind::kBoundKnown:
        return in_all(query.bound);
      case GroundQuery::Kind::kSensed:
        return history.sensed.contains(query.formula);
      case GroundQuery::Kind::kValueSensed:
        return IsValueKnown(query, history);
    }
    return false;
  }

  bool IsValueKnown(const GroundQuery& query, const History& history) const {
    const auto sensed = history.values_sensed.find(query.function);
    const bool is_sensed = sensed != history.values_sensed.end();
    if (is_sensed && (!query.within || sensed->second <= *query.within)) return true;
    const int slot = task_.functions[query.function.index()].slot;
    if (slot < 0) return false;
    const auto [least, most] = std::minmax_element(
        history.worlds.begin(), history.worlds.end(),
        [&](const World& a, const World& b) { return a.numbers[slot] < b.numbers[slot]; });
    return most->numbers[slot] - least->numbers[slot] <= 2 * query.within.value_or(0);
  }

  bool HasTooMany(const Worlds& worlds) {
    if (worlds.size() <= most_worlds_) return false;
    if (failure_.empty()) failure_ = fmt::format("more than {} worlds on one way", most_worlds_);
    return true;
  }

  // Two worlds for each that leaves the atom open.
  void SplitBy(AtomId atom, Worlds& worlds) {
    for (std::size_t i = 0, count = worlds.size(); i < count && !HasTooMany(worlds); ++i) {
      if (worlds[i].atoms[atom.index()] != Truth::kEither) continue;
      World other = worlds[i];
      other.atoms[atom.index()] = Truth::kFalse;
      worlds[i].atoms[atom.index()] = Truth::kTrue;
      MakeOnlyValue(atom, worlds[i]);
      worlds.push_back(std::move(other));
    }
  }

  void MakeOnlyValue(AtomId atom, World& world) const {
    const FunctionId function = task_.function_of_atom[atom.index()];
    if (function.IsNone()) return;
    for (const AtomId value : task_.functions[function.index()].values) {
      if (value != atom) world.atoms[value.index()] = Truth::kFalse;
    }
  }

  // ---- Actions

  void Execute(const GroundAction& action, History& history) {
    if (!IsKnown(action.precondition, history)) {
      return Fail(
          fmt::format("the precondition of {} is not known", assay::contingent::TextOf(action)),
          history);
    }
    history.steps.push_back(assay::contingent::TextOf(action));
    Apply(action.effects, history);
    Update(history);
  }

  void Apply(const std::vector<GroundEffect>& effects, History& history) {
    for (const GroundEffect& effect : effects) {
      if (effect.is_of_worlds) SplitByAll(effect.condition, history.worlds);
    }
    std::vector<bool> happens_in_all;
    for (const GroundEffect& effect : effects) {
      happens_in_all.push_back(IsKnown(effect.condition, history));
    }
    std::map<FunctionId, double> sensed_values;
    std::set<FormulaId> sensed;
    for (std::size_t e = 0; e < effects.size(); ++e) {
      if (!happens_in_all[e]) continue;
      for (const GroundChange& change : effects[e].changes) {
        if (change.kind == GroundChange::Kind::kSense) sensed.insert(change.formula);
        if (change.kind == GroundChange::Kind::kSenseValue) {
          const auto [sensed_value, is_new] =
              sensed_values.try_emplace(change.function, change.error);
          sensed_value->second = std::min(sensed_value->second, change.error);
        }
      }
    }
    ForgetSensed(effects, happens_in_all, history);
    ChangeWorlds(effects, happens_in_all, history.worlds);
    history.sensed.merge(sensed);
    for (const auto& [function, error] : sensed_values) {
      const auto [known, is_new] = history.values_sensed.try_emplace(function, error);
      known->second = std::min(known->second, error);
    }
  }

  void SplitByAll(const GroundQuery& condition, Worlds& worlds) {
    if (condition.kind == GroundQuery::Kind::kKnown) SplitBy(condition.literal.atom, worlds);
    for (const GroundQuery& operand : condition.operands) SplitByAll(operand, worlds);
  }

  // What was sensed of something that may have changed since is out of date.
  void ForgetSensed(const std::vector<GroundEffect>& effects, const std::vector<bool>& happens,
                    History& history) const {
    for (std::size_t e = 0; e < effects.size(); ++e) {
      if (!happens[e] && !effects[e].is_of_worlds) continue;
      for (const GroundChange& change : effects[e].changes) ForgetSensed(change, history);
    }
  }

  void ForgetSensed(const GroundChange& change, History& history) const {
    if (change.kind == GroundChange::Kind::kUnsense) history.sensed.erase(change.formula);
    if (change.kind == GroundChange::Kind::kUnsenseValue) {
      history.values_sensed.erase(change.function);
    }
    const bool is_of_number = change.kind == GroundChange::Kind::kAssign ||
                              change.kind == GroundChange::Kind::kForgetNumber;
    const AtomId atom = change.literal.atom;
    if (atom.IsNone() && !is_of_number) return;
    const FunctionId function =
        is_of_number ? change.function : task_.function_of_atom[atom.index()];
    history.values_sensed.erase(function);
    std::erase_if(history.sensed, [&](FormulaId formula) {
      const Formula& f = task_.formulas[formula.index()];
      return (f.bound && f.bound->function == function) ||
             std::any_of(f.literals.begin(), f.literals.end(),
                         [&](const GroundLiteral& l) { return l.atom == atom; });
    });
  }

  void ChangeWorlds(const std::vector<GroundEffect>& effects, const std::vector<bool>& happens,
                    Worlds& worlds) {
    Worlds changed;
    for (const World& world : worlds) {
      if (HasTooMany(changed)) break;
      Worlds now = {world};
      // What becomes true wins over what becomes false.
      for (const int pass : {0, 1, 2}) {
        for (std::size_t e = 0; e < effects.size(); ++e) {
          const bool applies =
              effects[e].is_of_worlds ? IsTrue(effects[e].condition, world) : happens[e];
          if (!applies) continue;
          for (const GroundChange& change : effects[e].changes) {
            if (PassOf(change) == pass) Change(change, world, now);
          }
        }
      }
      std::move(now.begin(), now.end(), std::back_inserter(changed));
    }
    worlds = std::move(changed);
  }

  static int PassOf(const GroundChange& change) {
    if (change.kind == GroundChange::Kind::kForget) return 0;
    return change.kind == GroundChange::Kind::kSet && !change.literal.is_positive ? 1 : 2;
  }

  void Change(const GroundChange& change, const World& before, Worlds& now) {
    switch (change.kind) {
      case GroundChange::Kind::kSet:
        for (World& world : now) {
          world.atoms[change.literal.atom.index()] =
              change.literal.is_positive ? Truth::kTrue : Truth::kFalse;
        }
        return;
      case GroundChange::Kind::kForget:
        for (World& world : now) world.atoms[change.literal.atom.index()] = Truth::kEither;
        return;
      case GroundChange::Kind::kAssign:
        return Assign(change, before, now);
      case GroundChange::Kind::kNarrow:
        std::erase_if(now, [&](const World& world) { return !IsTrue(change.bound, world); });
        return;
      case GroundChange::Kind::kRelate:
        for (const GroundLiteral& l : change.literals) SplitBy(l.atom, now);
        std::erase_if(now, [&](const World& world) {
          const auto holding =
              std::count_if(change.literals.begin(), change.literals.end(),
                            [&](const GroundLiteral& l) { return IsTrue(l, world); });
          return holding == 0 || (holding > 1 && !change.is_inclusive);
        });
        return;
      case GroundChange::Kind::kSense:
      case GroundChange::Kind::kUnsense:
      case GroundChange::Kind::kSenseValue:
      case GroundChange::Kind::kUnsenseValue:
      case GroundChange::Kind::kForgetNumber:
        return;
    }
  }

  void Assign(const GroundChange& change, const World& before, Worlds& now) const {
    const int slot = task_.functions[change.function.index()].slot;
    double value = 0;
    for (const auto& [function, sign] : change.sum.functions) {
      value += sign * before.numbers[task_.functions[function.index()].slot];
    }
    const Interval& constant = change.sum.constant;
    Worlds all;
    for (const double added :
         std::set<double>{constant.low, constant.low / 2 + constant.high / 2, constant.high}) {
      for (const World& world : now) {
        all.push_back(world);
        all.back().numbers[slot] = value + added;
      }
    }
    now = std::move(all);
  }

  // Update rules, until nothing changes.
  void Update(History& history) {
    for (std::size_t round = 0; round <= task_.atoms.size() && !task_.updates.empty(); ++round) {
      const Worlds before = history.worlds;
      for (const GroundEffect& update : task_.updates) {
        if (!IsKnown(update.condition, history)) continue;
        GroundEffect always = update;
        always.condition = {};
        Apply({always}, history);
      }
      if (history.worlds == before) return;
    }
  }

  // Going round a repeat in one world.
  struct Attempt {
    std::vector<std::string> steps;                    // before it: rounds are not told
    std::set<std::pair<NodeId, World>> returned = {};  // to the heads of repeats
    std::deque<std::pair<NodeId, History>> to_follow = {};
    bool has_ended = false;  // at the goal
  };

  const GroundTask& task_;
  const PlanTree& tree_;
  Attempt* attempt_ = nullptr;
  std::vector<bool> is_reached_;
  std::set<NodeId> repeated_;
  std::vector<std::pair<NodeId, History>> heads_;  // of repeats, on the way to here
  std::size_t most_worlds_ = kMostWorlds;
  std::int64_t worlds_ = 0;
  std::string failure_;
};

}  // namespace

TreeCheck CheckTree(const GroundTask& task, const PlanTree& tree, const TreeCheckOptions& options) {
  InitialWorlds initial = EnumerateWorlds(task, options.worlds, options.seed);
  if (!initial.are_all) {
    if (const std::optional<TreeCheck> check = CheckBySets(task, tree)) return *check;
  }
  return Runner(task, tree).Run(std::move(initial));
}

}  // namespace assay::contingent
