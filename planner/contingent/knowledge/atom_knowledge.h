#pragma once

#include <map>
#include <vector>

#include "planner/contingent/grounding/ground_task.h"
#include "planner/contingent/knowledge/knowledge_state.h"
#include "planner/contingent/knowledge/open_bounds.h"
#include "planner/contingent/worlds/world_sets.h"

namespace assay::contingent {

// What effects that may happen do to an atom: where it becomes true, where else false, and where
// else it may be either.
struct PossibleChange {
  Diagram becomes_true = kEmptySet;
  Diagram becomes_false = kEmptySet;
  Diagram becomes_open = kEmptySet;
};

// What a state knows of atoms, Kf and Kx, and how that changes: sound and, for what they can say,
// complete. A literal that follows from a state's Kx is in its Kf, and that a function has one
// value (unique names) holds without being said. What changes an atom takes it out of Kw and Kv.
class AtomKnowledge {
 public:
  // Keeps a reference to the task.
  explicit AtomKnowledge(const GroundTask& task);

  WorldSets& worlds() { return worlds_; }

  // Whether all worlds that the state allows are in the set.
  bool IsWithin(const KnowledgeState& state, Diagram worlds);
  // Whether the literals all hold in no world that the state allows.
  bool NeverHold(const KnowledgeState& state, const std::vector<GroundLiteral>& literals) {
    return IsWithin(state, worlds_.Not(worlds_.WhereAll(literals)));
  }
  // The set with what is known put in.
  Diagram Restricted(Diagram worlds, const KnowledgeState& state);
  // What Kx and unique names say together of the atoms of a set, and of those related to them.
  Diagram RelationsWith(const KnowledgeState& state, Diagram of);
  // Kx's relation that the atom is in; kAllSets if none.
  Diagram RelationOf(const KnowledgeState& state, AtomId atom);

  // The world changes.
  void Set(KnowledgeState& state, GroundLiteral literal);
  void Forget(KnowledgeState& state, AtomId atom);
  // All at once, where the bounds tell which of them happen; then nothing of the bounds is kept.
  void Change(KnowledgeState& state, const std::map<AtomId, PossibleChange>& changes,
              const OpenBounds& bounds);

  // Whether more may be known of the atom than the state says: that it is not known cannot be told.
  bool IsOuter(const KnowledgeState& state, AtomId atom) const;
  // The atoms that the set depends on hang together with a number from now on.
  void Entangle(KnowledgeState& state, Diagram worlds);
  // More is known of something that hangs together with a number, and so perhaps of all such atoms.
  void LearnOfNumbers(KnowledgeState& state) const { layout_.SetEntangledOuter(state); }

  // More is known of the world. A literal that may hold:
  void Learn(KnowledgeState& state, GroundLiteral literal);
  // False if the literals cannot all hold (`value`), or not all.
  bool LearnConjunction(KnowledgeState& state, const std::vector<GroundLiteral>& literals,
                        bool value);
  // That exactly one holds, or at least one; false if that contradicts what is known.
  bool Relate(KnowledgeState& state, const std::vector<GroundLiteral>& literals, bool is_inclusive);

 private:
  void UnsenseWith(KnowledgeState& state, AtomId atom);
  void Disentangle(KnowledgeState& state, AtomId atom) const;
  void Entangle(KnowledgeState& state, AtomId atom, bool is_outer) const;
  // What is related to an atom that is entangled, or outer, is so as well.
  void SpreadEntanglement(KnowledgeState& state);
  void SpreadEntanglement(KnowledgeState& state, const std::vector<int>& variables) const;
  void Unrelate(KnowledgeState& state, AtomId atom);
  // Adds a relation to those that are there; false if they cannot hold together.
  bool RelateAsWell(KnowledgeState& state, Diagram relation);
  // Takes out the relations that have one of the variables, or another value of a function of which
  // they have one, and returns what they say together, with unique names.
  Diagram TakeRelations(KnowledgeState& state, std::vector<int> variables);
  // Puts in a relation, and into Kf what follows from it; false if it cannot hold.
  bool PutRelation(KnowledgeState& state, Diagram relation);

  FunctionId FunctionOf(int variable) const;
  // The values that are neither known to be the function's nor not to be.
  std::vector<int> OpenValues(FunctionId function, const KnowledgeState& state) const;
  // Where the functions of which there are values among the variables have one value at most.
  Diagram UniqueNames(const std::vector<int>& variables, const KnowledgeState& state);

  const GroundTask& task_;
  StateLayout layout_;
  WorldSets worlds_;
  std::vector<std::vector<FormulaId>> formulas_of_atom_;
};

}  // namespace assay::contingent
