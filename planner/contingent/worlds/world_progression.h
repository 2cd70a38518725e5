#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include "planner/contingent/grounding/ground_task.h"
#include "planner/contingent/worlds/initial_worlds.h"

namespace assay::contingent {

using Worlds = std::vector<World>;

// The worlds that one history leads to, and what has been sensed on it.
struct History {
  Worlds worlds;
  std::set<FormulaId> sensed;
  std::map<FunctionId, double> values_sensed;  // with their errors

  bool operator==(const History&) const = default;
  auto operator<=>(const History&) const = default;
};

// Whether a query holds after a history. Worlds that are a sample show that something is not known,
// by one where it is false; where it is true in all of them, they cannot tell that it is not known.
enum class Answer : std::int8_t { kNo, kCannotTell, kYes };

// What is true in worlds, what is known in all worlds of a history, and how actions change them
// (progression, world by world). Naive by purpose: the checker of plan trees relies on it
// (tree_check.h).
class WorldProgression {
 public:
  // Keeps references. `are_sample`: of the worlds, or of their numbers. Where there would be more
  // than `most_worlds` in a history, not all are made.
  WorldProgression(const GroundTask& task, const NumberMarks& marks, bool are_sample,
                   std::size_t most_worlds)
      : task_(task), marks_(marks), are_sample_(are_sample), most_worlds_(most_worlds) {}

  bool HasMadeTooMany() const { return has_made_too_many_; }
  // Whether there was an effect of which a sample cannot tell that it happens.
  bool CouldNotTell() const { return could_not_tell_; }
  // The function that has been given two values at once, if any.
  FunctionId TwoValued() const { return two_valued_; }
  // Whether update rules did not come to rest.
  bool IsRestless() const { return is_restless_; }

  static bool IsTrue(GroundLiteral literal, const World& world);
  bool IsTrue(const Formula& formula, const World& world) const;
  Answer Ask(const GroundQuery& query, const History& history) const;

  // Two worlds for each that leaves the atom open.
  void SplitBy(AtomId atom, Worlds& worlds);

  // Effects that happen at once.
  void Apply(const std::vector<GroundEffect>& effects, History& history);
  // Update rules, until nothing changes or they are restless.
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
