#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include "planner/contingent/grounding/ground_task.h"
#include "planner/contingent/world_sets/initial_worlds.h"

namespace assay::contingent {

using Worlds = std::vector<World>;

// The worlds that one history leads to, and the facts sensed in it.
struct History {
  Worlds worlds;
  std::set<FormulaId> sensed;
  std::map<FunctionId, double> values_sensed;  // sensed functions with their sensor errors

  bool operator==(const History&) const = default;
  auto operator<=>(const History&) const = default;
};

// The answer to a query after a history. If the worlds are a sample, one world where a fact is
// false shows that the fact is not known. If the fact is true in all worlds of the sample, it
// cannot be decided whether it is known, and the answer is kCannotTell.
enum class Answer : std::int8_t { kNo, kCannotTell, kYes };

// Evaluates what is true in worlds and what is known in all worlds of a history, and computes how
// actions change them (progression, world by world). The algorithm is naive on purpose, because the
// checker of plan trees relies on it (tree_check.h).
class WorldProgression {
 public:
  // Keeps references. `are_sample` is true if the worlds or their numbers are a sample. If a
  // history would have more than `most_worlds` worlds, not all of them are made.
  WorldProgression(const GroundTask& task, const NumberMarks& marks, bool are_sample,
                   std::size_t most_worlds)
      : task_(task), marks_(marks), are_sample_(are_sample), most_worlds_(most_worlds) {}

  bool HasMadeTooMany() const { return has_made_too_many_; }
  // Returns true if a sample of worlds could not decide whether some effect happens.
  bool CouldNotTell() const { return could_not_tell_; }
  // Returns a function that was given two values at once, or none.
  FunctionId TwoValued() const { return two_valued_; }
  // Returns true if the update rules did not reach a fixed point.
  bool IsRestless() const { return is_restless_; }

  static bool IsTrue(GroundLiteral literal, const World& world);
  bool IsTrue(const Formula& formula, const World& world) const;
  Answer Ask(const GroundQuery& query, const History& history) const;

  // Replaces each world that leaves the atom open by two worlds.
  void SplitBy(AtomId atom, Worlds& worlds);

  // Applies effects that happen at once.
  void Apply(const std::vector<GroundEffect>& effects, History& history);
  // Applies the update rules until nothing changes or too many rounds have passed.
  void Update(History& history);

 private:
  bool IsTrue(const Bound& bound, const World& world) const;
  bool IsTrue(const GroundQuery& condition, const World& world) const;
  bool IsFalse(const Formula& formula, const World& world) const;
  bool IsDetermined(const Formula& formula, const History& history) const;
  bool IsValueKnown(const GroundQuery& query, const History& history) const;
  bool Happens(const GroundEffect& effect, const History& history);
  bool MayHappen(const GroundEffect& effect, const Worlds& worlds) const;
  bool HasTooMany(const Worlds& worlds);
  void SplitByAll(const GroundQuery& condition, Worlds& worlds);
  void MakeOnlyValue(AtomId atom, World& world) const;
  void ForgetSensed(const std::vector<GroundEffect>& effects, const std::vector<bool>& may_happen,
                    History& history) const;
  void ForgetSensed(const GroundChange& change, History& history) const;
  void ChangeWorlds(const std::vector<GroundEffect>& effects, const std::vector<bool>& happens,
                    Worlds& worlds);
  void NoteValue(const GroundChange& change, std::map<FunctionId, const GroundChange*>& given);
  void Change(const GroundChange& change, const World& before, Worlds& now);
  void Assign(const GroundChange& change, const World& before, Worlds& now) const;
  void OpenForgotten(int slot, Worlds& worlds) const;

  const GroundTask& task_;
  const NumberMarks& marks_;
  bool are_sample_;
  std::size_t most_worlds_;
  bool has_made_too_many_ = false;
  bool could_not_tell_ = false;
  bool is_restless_ = false;
  FunctionId two_valued_;
};

}  // namespace assay::contingent
