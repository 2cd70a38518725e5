#include "planner/contingent/tree_check/symbolic_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <ranges>
#include <set>

#include "planner/contingent/world_sets/symbolic_worlds.h"

namespace assay::contingent {
namespace {

// The state of the check at a node: the worlds of all paths, the formulas sensed on every path and
// on any path, and the atoms that are open on every path. An atom is open on a path if, for each
// world of the path, the path also has the world that differs only in this atom.
struct Arrivals {
  Diagram worlds = kEmptySet;
  std::set<FormulaId> sensed;
  std::set<FormulaId> sensed_somewhere;
  std::set<AtomId> open;
};

bool IsOfEachWorld(const GroundEffect& effect) {
  return std::ranges::all_of(effect.changes, [&](const GroundChange& change) {
    const bool is_of_fact =
        change.kind == GroundChange::Kind::kSet || change.kind == GroundChange::Kind::kForget;
    const bool is_of_kw =
        change.kind == GroundChange::Kind::kSense || change.kind == GroundChange::Kind::kUnsense;
    return is_of_fact ? effect.is_of_worlds : is_of_kw && effect.condition.IsTrue();
  });
}

bool IsOfEachWorld(const GroundTask& task, const PlanTree& tree) {
  return task.functions.empty() && task.updates.empty() &&
         std::ranges::all_of(tree.nodes, [&](const PlanNode& node) {
           if (node.kind == PlanNode::Kind::kValue || std::ranges::count(node.repeats, true) > 0) {
             return false;
           }
           if (node.kind != PlanNode::Kind::kAct) return true;
           return std::ranges::all_of(
               task.actions[node.action.index()].effects,
               [](const GroundEffect& effect) { return IsOfEachWorld(effect); });
         });
}

class SymbolicCheck {
 public:
  SymbolicCheck(const GroundTask& task, const PlanTree& tree)
      : task_(task), tree_(tree), worlds_(task), arrivals_(tree.nodes.size()) {}

  std::optional<TreeCheck> Run() {
    TreeCheck check;
    const Diagram initial = worlds_.Initial();
    if (initial == kEmptySet) return std::nullopt;
    check.worlds = static_cast<std::int64_t>(worlds_.CountOf(initial));
    const std::set<FormulaId> sensed(task_.initial.sensed.begin(), task_.initial.sensed.end());
    Arrive(tree_.root, {worlds_.Assumed(initial), sensed, sensed, worlds_.OpenAtoms(initial)});
    for (const NodeId id : std::views::reverse(ChildrenFirst(tree_))) {
      const Arrivals& arrivals = arrivals_[id.index()];
      if (arrivals.worlds == kEmptySet) continue;
      PassOn(tree_.node(id), arrivals);
    }
    if (failure_.empty() && !is_decided_) return std::nullopt;
    check.holds = failure_.empty();
    check.failure = failure_;
    for (std::size_t i = 0; i < arrivals_.size(); ++i) {
      if (arrivals_[i].worlds == kEmptySet) check.unreached.push_back(NodeId(i));
    }
    return check;
  }

 private:
  // ---- Walking the tree

  void Arrive(NodeId id, Arrivals more) {
    Arrivals& arrivals = arrivals_[id.index()];
    if (more.worlds == kEmptySet) return;
    if (arrivals.worlds == kEmptySet) {
      arrivals = std::move(more);
      return;
    }
    arrivals.worlds = worlds_.Or(arrivals.worlds, more.worlds);
    std::erase_if(arrivals.sensed, [&](FormulaId f) { return !more.sensed.contains(f); });
    arrivals.sensed_somewhere.merge(more.sensed_somewhere);
    std::erase_if(arrivals.open, [&](AtomId a) { return !more.open.contains(a); });
  }

  void PassOn(const PlanNode& node, const Arrivals& here) {
    switch (node.kind) {
      case PlanNode::Kind::kGoal:
        return Demand(task_.goal, here, "the goal");
      case PlanNode::Kind::kAct: {
        const GroundAction& action = task_.actions[node.action.index()];
        Demand(action.precondition, here, fmt::format("the precondition of {}", TextOf(action)));
        return Arrive(node.children.front(), After(action, here));
      }
      case PlanNode::Kind::kWhether:
        return Branch(node, here);
      case PlanNode::Kind::kValue:
        is_decided_ = false;
    }
  }

  void Demand(const GroundQuery& query, const Arrivals& here, const std::string& what) {
    if (!failure_.empty() || SurelyHolds(query, here)) return;
    const Diagram where = WorldsAgainst(query, here);
    is_decided_ &= where != kEmptySet;
    if (where == kEmptySet) return;
    failure_ = fmt::format("{} is not known on some way of the tree, in the world with {}", what,
                           worlds_.TextOfAWorld(where));
  }

  // Returns worlds of a path on which the query is not known. Returns the empty set if this is
  // undecided.
  Diagram WorldsAgainst(const GroundQuery& query, const Arrivals& here) {
    if (query.kind == GroundQuery::Kind::kKnown) {
      return worlds_.And(here.worlds, worlds_.Not(worlds_.Where(query.literal)));
    }
    if (query.kind != GroundQuery::Kind::kAnd) {
      return SurelyFails(query, here) ? here.worlds : kEmptySet;
    }
    for (const GroundQuery& operand : query.operands) {
      const Diagram where = WorldsAgainst(operand, here);
      if (where != kEmptySet) return where;
    }
    return kEmptySet;
  }

  // Returns true if the query holds on every path.
  bool SurelyHolds(const GroundQuery& query, const Arrivals& here) {
    const auto holds = [&](const GroundQuery& operand) { return SurelyHolds(operand, here); };
    switch (query.kind) {
      case GroundQuery::Kind::kAnd:
        return std::ranges::all_of(query.operands, holds);
      case GroundQuery::Kind::kOr:
        return std::ranges::any_of(query.operands, holds);
      case GroundQuery::Kind::kNot:
        return SurelyFails(query.operands.front(), here);
      case GroundQuery::Kind::kKnown:
        return worlds_.Implies(here.worlds, worlds_.Where(query.literal));
      case GroundQuery::Kind::kKnownWhether:
        return here.sensed.contains(query.formula) || IsDetermined(query.formula, here);
      case GroundQuery::Kind::kBoundKnown:
      case GroundQuery::Kind::kValueSensed:
        break;
    }
    return false;
  }

  bool IsDetermined(FormulaId formula, const Arrivals& here) {
    const Diagram where = worlds_.Where(task_.formulas[formula.index()]);
    return worlds_.Implies(here.worlds, where) || worlds_.And(here.worlds, where) == kEmptySet;
  }

  // Returns true if, on each path, the formula is true in some worlds and false in others.
  bool IsOpen(FormulaId formula, const Arrivals& here) const {
    return std::ranges::all_of(task_.formulas[formula.index()].literals,
                               [&](const GroundLiteral& l) { return here.open.contains(l.atom); });
  }

  // Returns true if the query fails on every path. The set joins the worlds of all paths. A literal
  // that is true in some of these worlds and false in others may still be known on each path.
  bool SurelyFails(const GroundQuery& query, const Arrivals& here) {
    const auto fails = [&](const GroundQuery& operand) { return SurelyFails(operand, here); };
    switch (query.kind) {
      case GroundQuery::Kind::kAnd:
        return std::ranges::any_of(query.operands, fails);
      case GroundQuery::Kind::kOr:
        return std::ranges::all_of(query.operands, fails);
      case GroundQuery::Kind::kNot:
        return SurelyHolds(query.operands.front(), here);
      case GroundQuery::Kind::kKnown:
        return here.open.contains(query.literal.atom) ||
               worlds_.And(here.worlds, worlds_.Where(query.literal)) == kEmptySet;
      case GroundQuery::Kind::kKnownWhether:
        return !here.sensed_somewhere.contains(query.formula) && IsOpen(query.formula, here);
      case GroundQuery::Kind::kBoundKnown:
      case GroundQuery::Kind::kValueSensed:
        break;
    }
    return false;
  }

  // Worlds of both cases may come from different paths, so their presence does not refute the tree.
  void Branch(const PlanNode& node, const Arrivals& here) {
    const Diagram where = worlds_.Where(task_.formulas[node.formula.index()]);
    const Diagram if_true = worlds_.And(here.worlds, where);
    const Diagram if_false = worlds_.And(here.worlds, worlds_.Not(where));
    const bool is_open = if_true != kEmptySet && if_false != kEmptySet;
    if (is_open && !here.sensed.contains(node.formula)) is_decided_ = false;
    Arrivals next = here;
    for (const GroundLiteral& l : task_.formulas[node.formula.index()].literals) {
      next.open.erase(l.atom);
    }
    next.worlds = if_true;
    Arrive(node.children[0], next);
    next.worlds = if_false;
    Arrive(node.children[1], next);
  }

  // ---- Actions

  // A sensed fact that may have changed is removed from those sensed on every path. A sensed fact
  // that may not have changed stays among those sensed on some path.
  Arrivals After(const GroundAction& action, const Arrivals& here) {
    Arrivals next = here;
    next.worlds = worlds_.Image(action, here.worlds);
    std::set<FormulaId> now;
    for (const GroundEffect& effect : action.effects) {
      for (const GroundChange& change : effect.changes) {
        if (change.kind == GroundChange::Kind::kSense) now.insert(change.formula);
        Unsense(change, next.sensed);
        if (effect.condition.IsTrue()) Unsense(change, next.sensed_somewhere);
      }
    }
    next.sensed.insert(now.begin(), now.end());
    next.sensed_somewhere.merge(now);
    next.open = OpenAfter(action, here);
    return next;
  }

  void Unsense(const GroundChange& change, std::set<FormulaId>& sensed) const {
    if (change.kind == GroundChange::Kind::kUnsense) sensed.erase(change.formula);
    std::erase_if(sensed, [&](FormulaId formula) {
      return std::ranges::count(task_.formulas[formula.index()].literals, change.literal.atom,
                                &GroundLiteral::atom) > 0;
    });
  }

  // An open atom stays open if no effect reads or writes it. An atom becomes open only if an effect
  // certainly forgets it.
  std::set<AtomId> OpenAfter(const GroundAction& action, const Arrivals& here) const {
    std::set<AtomId> open = here.open;
    std::set<AtomId> closed;
    for (const GroundEffect& effect : action.effects) {
      AddAtoms(effect.condition, closed);
      for (const GroundChange& change : effect.changes) {
        if (change.literal.atom.IsNone()) continue;
        const bool is_surely_forgotten =
            change.kind == GroundChange::Kind::kForget && effect.condition.IsTrue();
        (is_surely_forgotten ? open : closed).insert(change.literal.atom);
      }
    }
    for (const AtomId atom : closed) open.erase(atom);
    return open;
  }

  static void AddAtoms(const GroundQuery& query, std::set<AtomId>& atoms) {
    if (query.kind == GroundQuery::Kind::kKnown) atoms.insert(query.literal.atom);
    for (const GroundQuery& operand : query.operands) AddAtoms(operand, atoms);
  }

  const GroundTask& task_;
  const PlanTree& tree_;
  SymbolicWorlds worlds_;
  std::vector<Arrivals> arrivals_;  // indexed by node
  std::string failure_;
  bool is_decided_ = true;  // false if sets cannot decide some query of the tree
};

}  // namespace

std::optional<TreeCheck> CheckBySets(const GroundTask& task, const PlanTree& tree) {
  if (!IsOfEachWorld(task, tree)) return std::nullopt;
  return SymbolicCheck(task, tree).Run();
}

}  // namespace assay::contingent
