#pragma once

#include <map>
#include <vector>

#include "planner/contingent/grounding/ground_task.h"
#include "planner/contingent/knowledge/knowledge_state.h"
#include "planner/contingent/knowledge/open_bounds.h"
#include "planner/contingent/world_sets/world_sets.h"

namespace assay::contingent {

// The change of an atom by effects that may happen: the worlds where it becomes true, the other
// worlds where it becomes false, and the remaining worlds where it may become either.
struct PossibleChange {
  Diagram becomes_true = kEmptySet;
  Diagram becomes_false = kEmptySet;
  Diagram becomes_open = kEmptySet;
};

// The knowledge of a state about atoms, Kf and Kx, and its changes. Answers are sound, and they are
// complete for everything that Kf and Kx can express. A literal that follows from a state's Kx is
// in its Kf. Each function has one value (unique names); this rule is not stored. A change of an
// atom removes the atom from Kw and Kv.
class AtomKnowledge {
 public:
  // Keeps a reference to the task.
  explicit AtomKnowledge(const GroundTask& task);

  WorldSets& worlds() { return worlds_; }

  // Returns true if all worlds that the state allows are in the set.
  bool IsWithin(const KnowledgeState& state, Diagram worlds);
  // Returns true if the literals hold together in no world that the state allows.
  bool NeverHold(const KnowledgeState& state, const std::vector<GroundLiteral>& literals) {
    return IsWithin(state, worlds_.Not(worlds_.WhereAll(literals)));
  }
  // Returns the set with the values of all known atoms substituted.
  Diagram Restricted(Diagram worlds, const KnowledgeState& state);
  // Returns the conjunction of Kx and unique names for the atoms of the set `of` and for all atoms
  // related to them.
  Diagram RelationsWith(const KnowledgeState& state, Diagram of);
  // Returns the relation of Kx that contains the atom, or kAllSets if there is none.
  Diagram RelationOf(const KnowledgeState& state, AtomId atom);

  // Makes the literal true in the world.
  void Set(KnowledgeState& state, GroundLiteral literal);
  void Forget(KnowledgeState& state, AtomId atom);
  // Makes all changes at once. `bounds` contains the bounds that decide which changes happen. The
  // bounds are not kept afterwards.
  void Change(KnowledgeState& state, const std::map<AtomId, PossibleChange>& changes,
              const OpenBounds& bounds);

  // Returns true if more may be known about the atom than the state says. Then it is undecided
  // whether the atom is unknown.
  bool IsOuter(const KnowledgeState& state, AtomId atom) const;
  // Marks the atoms of the set as dependent on a number from then on.
  void Entangle(KnowledgeState& state, Diagram worlds);
  // Records that more is known about something that depends on a number. All atoms that depend on
  // numbers become outer, because the new knowledge may say something about any of them.
  void LearnOfNumbers(KnowledgeState& state) const { layout_.SetEntangledOuter(state); }

  // Learns that a literal, which is not known to be false, is true in the unchanged world.
  void Learn(KnowledgeState& state, GroundLiteral literal);
  // Learns that all literals hold (`value` is true) or that not all of them hold. Returns false if
  // that contradicts the state's knowledge.
  bool LearnConjunction(KnowledgeState& state, const std::vector<GroundLiteral>& literals,
                        bool value);
  // Learns that exactly one, or at least one, of the literals holds. Returns false if that
  // contradicts the state's knowledge.
  bool Relate(KnowledgeState& state, const std::vector<GroundLiteral>& literals, bool is_inclusive);

 private:
  void UnsenseWith(KnowledgeState& state, AtomId atom);
  void Disentangle(KnowledgeState& state, AtomId atom) const;
  void Entangle(KnowledgeState& state, AtomId atom, bool is_outer) const;
  // Marks every atom that is related to an entangled atom as entangled, too. If one of the related
  // atoms is outer, all of them become outer.
  void SpreadEntanglement(KnowledgeState& state);
  void SpreadEntanglement(KnowledgeState& state, const std::vector<int>& variables) const;
  void Unrelate(KnowledgeState& state, AtomId atom);
  // Adds a relation to the state. Returns false if the relations cannot all hold.
  bool RelateAsWell(KnowledgeState& state, Diagram relation);
  // Removes the relations that contain one of the variables. If a variable stands for a value of a
  // function, relations that contain another value of this function are removed, too. Returns the
  // conjunction of these relations and of unique names.
  Diagram TakeRelations(KnowledgeState& state, std::vector<int> variables);
  // Adds a relation, and adds to Kf the literals that follow from it. Returns false if the relation
  // cannot hold.
  bool PutRelation(KnowledgeState& state, Diagram relation);

  FunctionId FunctionOf(int variable) const;
  // Returns the values, as variables, that are known neither to be nor not to be the function's
  // value.
  std::vector<int> OpenValues(FunctionId function, const KnowledgeState& state) const;
  // Returns the set of worlds in which each function with values among the variables has at most
  // one of them.
  Diagram UniqueNames(const std::vector<int>& variables, const KnowledgeState& state);

  const GroundTask& task_;
  StateLayout layout_;
  WorldSets worlds_;
  std::vector<std::vector<FormulaId>> formulas_of_atom_;
};

}  // namespace assay::contingent
