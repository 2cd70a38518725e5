#pragma once

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "planner/contingent/grounding/ground_task.h"

namespace assay::oracle {

// Contingent planning by brute force over sets of possible worlds. The depth of trees is increased
// by one action at a time. The oracle can be trusted for tasks of a few atoms, without functions
// and update rules. Conditions of effects must be about worlds or about knowledge. Sensing must be
// followed by its branch at once, and deletions must be unconditional.
class WorldSetSearch {
 public:
  explicit WorldSetSearch(const contingent::GroundTask& task) : task_(task) {}

  // Returns the least depth of a plan tree, or nothing if each tree needs more than `most` actions
  // on some way.
  std::optional<int> LeastDepth(int most) {
    for (int depth = 0; depth <= most; ++depth) {
      if (CanSolve(Initial(), depth)) return depth;
    }
    return std::nullopt;
  }

 private:
  using World = unsigned;  // a bit for each atom
  using WorldSet = std::set<World>;
  using Query = contingent::GroundQuery;
  using Sensed = std::set<contingent::FormulaId>;

  static bool Is(World world, contingent::GroundLiteral l) {
    return ((world >> l.atom.index() & 1U) != 0) == l.is_positive;
  }

  WorldSet Initial() const {
    WorldSet worlds;
    for (World world = 0; world < 1U << task_.atoms.size(); ++world) {
      const auto holds = [&](const contingent::GroundLiteral& l) { return Is(world, l); };
      const auto& known = task_.initial.known;
      bool is_possible = std::all_of(known.begin(), known.end(), holds);
      for (const contingent::InitialRelation& relation : task_.initial.relations) {
        const auto count = std::count_if(relation.literals.begin(), relation.literals.end(), holds);
        is_possible &= count == 1 || (count > 1 && relation.is_inclusive);
      }
      if (is_possible) worlds.insert(world);
    }
    return worlds;
  }

  static bool Is(World world, const contingent::Formula& conjunction) {
    return std::all_of(conjunction.literals.begin(), conjunction.literals.end(),
                       [&](const contingent::GroundLiteral& l) { return Is(world, l); });
  }

  static bool IsTrue(const Query& condition, World world) {
    const auto is_true = [&](const Query& operand) { return IsTrue(operand, world); };
    const auto& operands = condition.operands;
    if (condition.kind == Query::Kind::kKnown) return Is(world, condition.literal);
    return condition.kind == Query::Kind::kAnd
               ? std::all_of(operands.begin(), operands.end(), is_true)
               : std::any_of(operands.begin(), operands.end(), is_true);
  }

  // Returns whether the query is true. `sensed` holds the formulas that have been sensed and on
  // which no branch has been made.
  bool IsKnown(const Query& query, const WorldSet& worlds, const Sensed& sensed = {}) const {
    const auto is_known = [&](const Query& operand) { return IsKnown(operand, worlds, sensed); };
    const auto& operands = query.operands;
    switch (query.kind) {
      case Query::Kind::kKnown:
        return std::all_of(worlds.begin(), worlds.end(),
                           [&](World world) { return Is(world, query.literal); });
      case Query::Kind::kNot:
        return !is_known(operands.front());
      case Query::Kind::kKnownWhether: {
        const auto is_true = [&](World world) {
          return Is(world, task_.formulas[query.formula.index()]);
        };
        return sensed.contains(query.formula) ||
               std::all_of(worlds.begin(), worlds.end(), is_true) ||
               std::none_of(worlds.begin(), worlds.end(), is_true);
      }
      case Query::Kind::kAnd:
        return std::all_of(operands.begin(), operands.end(), is_known);
      default:
        return std::any_of(operands.begin(), operands.end(), is_known);
    }
  }

  WorldSet After(const contingent::GroundAction& action, const WorldSet& worlds) const {
    WorldSet after;
    for (const World world : worlds) {
      std::set<World> now = {world};
      for (const bool value : {false, true}) {
        for (const contingent::GroundEffect& effect : action.effects) {
          const bool happens = effect.is_of_worlds ? IsTrue(effect.condition, world)
                                                   : IsKnown(effect.condition, worlds);
          if (!happens) continue;
          for (const contingent::GroundChange& change : effect.changes) {
            now = Changed(now, change, value);
          }
        }
      }
      after.insert(now.begin(), now.end());
    }
    return after;
  }

  // Applies a change to each world. The effects are applied in two passes. The pass with `value`
  // false sets literals to false, and the other one sets them to true. Both passes forget literals.
  static std::set<World> Changed(const std::set<World>& worlds,
                                 const contingent::GroundChange& change, bool value) {
    using Kind = contingent::GroundChange::Kind;
    if (change.kind != Kind::kSet && change.kind != Kind::kForget) return worlds;
    const World bit = 1U << change.literal.atom.index();
    std::set<World> changed;
    for (const World world : worlds) {
      const bool sets = change.kind == Kind::kSet && change.literal.is_positive == value;
      if (change.kind == Kind::kForget) {
        changed.insert({world | bit, world & ~bit});
      } else {
        changed.insert(!sets ? world : value ? world | bit : world & ~bit);
      }
    }
    return changed;
  }

  Sensed SensedBy(const contingent::GroundAction& action, const WorldSet& worlds) const {
    Sensed sensed;
    for (const contingent::GroundEffect& effect : action.effects) {
      if (!IsKnown(effect.condition, worlds)) continue;
      for (const contingent::GroundChange& change : effect.changes) {
        if (change.kind == contingent::GroundChange::Kind::kSense) sensed.insert(change.formula);
      }
    }
    return sensed;
  }

  // Returns whether the goal can be reached with branches on the sensed formulas, one after the
  // other. Branches end when the goal is true.
  bool CanSolveSensed(const WorldSet& worlds, Sensed sensed, int depth) {
    if (sensed.empty()) return CanSolve(worlds, depth);
    if (IsKnown(task_.goal, worlds, sensed)) return true;
    const auto& asked = task_.formulas[sensed.begin()->index()];
    sensed.erase(sensed.begin());
    WorldSet parts[2];
    for (const World world : worlds) parts[Is(world, asked) ? 1 : 0].insert(world);
    return std::all_of(std::begin(parts), std::end(parts), [&](const WorldSet& part) {
      return part.empty() || CanSolveSensed(part, sensed, depth);
    });
  }

  bool CanSolve(const WorldSet& worlds, int depth) {
    if (IsKnown(task_.goal, worlds)) return true;
    if (depth == 0) return false;
    const auto [entry, is_new] = solved_.try_emplace({worlds, depth}, false);
    if (!is_new) return entry->second;
    for (const contingent::GroundAction& action : task_.actions) {
      if (!IsKnown(action.precondition, worlds)) continue;
      if (CanSolveSensed(After(action, worlds), SensedBy(action, worlds), depth - 1)) {
        return entry->second = true;
      }
    }
    return false;
  }

  const contingent::GroundTask& task_;
  std::map<std::pair<WorldSet, int>, bool> solved_;
};

}  // namespace assay::oracle
