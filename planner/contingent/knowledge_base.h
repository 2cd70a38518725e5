#pragma once

#include <map>
#include <optional>
#include <vector>

#include "planner/contingent/decision_diagram.h"
#include "planner/contingent/ground_task.h"
#include "planner/contingent/knowledge_state.h"

namespace assay::contingent {

// How knowledge is asked and how it changes: queries, actions, sensing, update rules. Sound and,
// for what Kf and Kx can say, complete: a literal that follows from a state's Kx is in its Kf.
class KnowledgeBase {
 public:
  // Keeps a reference to the task.
  explicit KnowledgeBase(const GroundTask& task);

  const GroundTask& task() const { return task_; }
  const StateLayout& layout() const { return layout_; }
  DecisionDiagrams& diagrams() { return diagrams_; }

  // Throws InputError, with the place of an alternative that cannot hold, if init contradicts
  // itself, and with that of an update rule that leaves no alternative of init, or no number. This
  // and all that makes other states throws it at an update rule, if the rules do not come to rest.
  KnowledgeState Initial();

  bool Holds(const GroundQuery& query, const KnowledgeState& state) const;

  // After an action whose precondition holds, and the update rules. None if an effect on Kx or
  // on bounds contradicts what is known.
  std::optional<KnowledgeState> After(const GroundAction& action, const KnowledgeState& state);

  // A formula of Kw that branches now: it has one undetermined literal, all others are known to be
  // true (a conjunction's negation could else not be told), or it is a bound. None if there is
  // none.
  FormulaId FormulaToBranch(const KnowledgeState& state) const;
  // The functions of Kv whose possible values Kx tells.
  std::vector<FunctionId> FunctionsToBranch(const KnowledgeState& state);
  // The values that a function may have: those not known to be none.
  std::vector<AtomId> PossibleValues(FunctionId function, const KnowledgeState& state) const;

  // When the formula turns out true or false, when a literal turns out to hold.
  KnowledgeState Learned(const KnowledgeState& state, FormulaId formula, bool value);
  KnowledgeState Learned(const KnowledgeState& state, GroundLiteral literal);

  // The one undetermined literal of a formula that branches; none of a bound.
  GroundLiteral UndeterminedLiteral(FormulaId formula, const KnowledgeState& state) const;

  // Diagrams over worlds. The variable of an atom; the atom of a variable.
  int Variable(AtomId atom) const { return 2 * places_[atom.index()]; }
  AtomId AtomOf(int variable) const { return atom_at_[variable / 2]; }
  Diagram WorldsWhere(GroundLiteral literal) {
    return diagrams_.Literal({Variable(literal.atom), literal.is_positive});
  }
  // Where a condition that asks K of literals alone is true.
  Diagram WorldsWhere(const GroundQuery& condition);
  // Where exactly one, or at least one, of the literals holds.
  Diagram WorldsWhere(const std::vector<GroundLiteral>& literals, bool is_inclusive);
  // Whether all worlds that the state allows are in the set.
  bool IsWithin(const KnowledgeState& state, Diagram worlds);
  // Kx's relation that the atom is in; kAllSets if none.
  Diagram RelationOf(const KnowledgeState& state, AtomId atom);

 private:
  // What a possible effect does to an atom: where it becomes true, where false.
  struct Possible {
    Diagram becomes_true = kEmptySet;
    Diagram becomes_false = kEmptySet;
  };
  struct Changes {
    std::vector<const GroundChange*> certain;
    std::map<AtomId, Possible> possible;
    std::vector<FunctionId> unsettled;  // numbers that may have been assigned something else
  };

  bool BoundHolds(const Bound& bound, const KnowledgeState& state) const;
  bool IsDetermined(const Formula& formula, const KnowledgeState& state) const;

  Changes ChangesOf(const std::vector<GroundEffect>& effects, const KnowledgeState& state);
  // What an effect may do whose condition is undetermined, true in the worlds `where`.
  void AddPossible(const GroundChange& change, Diagram where, Changes& changes);
  // False if a relation or a bound contradicts what is known.
  bool Apply(const Changes& changes, const KnowledgeState& before, KnowledgeState& state);
  void Apply(const GroundChange& change, const KnowledgeState& before, KnowledgeState& state);
  void ApplyPossible(const std::map<AtomId, Possible>& possible, KnowledgeState& state);
  // The rule after which a relation or a bound contradicts what is known, or which leaves no
  // alternative of the relations that last; null: there is none.
  const GroundEffect* ApplyUpdates(KnowledgeState& state,
                                   const std::vector<InitialRelation>& lasting = {});
  [[noreturn]] void FailRestless(const GroundEffect& update, std::size_t rounds) const;
  // The first of the relations that contradicts what is known or those before; null: none does.
  const InitialRelation* RelateAll(KnowledgeState& state,
                                   const std::vector<InitialRelation>& relations);
  void Canonicalize(KnowledgeState& state) const;

  void Set(KnowledgeState& state, GroundLiteral literal);
  void Forget(KnowledgeState& state, AtomId atom);
  void SenseValue(KnowledgeState& state, FunctionId function, double error) const;
  void ForgetNumber(KnowledgeState& state, FunctionId function) const;
  void Unrelate(KnowledgeState& state, AtomId atom);
  void UnsenseWith(KnowledgeState& state, AtomId atom);
  void Learn(KnowledgeState& state, GroundLiteral literal);
  void Learn(KnowledgeState& state, const Bound& bound) const;
  bool Relate(KnowledgeState& state, const std::vector<GroundLiteral>& literals, bool is_inclusive);
  // Takes out the relations that have one of the variables, and returns what they say together.
  Diagram TakeRelations(KnowledgeState& state, const std::vector<int>& variables);
  Diagram RelationsWith(const KnowledgeState& state, Diagram of);
  // Puts in a relation, and into Kf what follows from it; false if it cannot hold.
  bool PutRelation(KnowledgeState& state, Diagram relation);
  // The set with what is known put in.
  Diagram Restricted(Diagram worlds, const KnowledgeState& state);
  Range SumOf(const GroundSum& sum, const KnowledgeState& state) const;

  const GroundTask& task_;
  StateLayout layout_;
  DecisionDiagrams diagrams_;
  std::vector<int> places_;
  std::vector<AtomId> atom_at_;
  std::vector<std::vector<FormulaId>> formulas_of_atom_;
};

}  // namespace assay::contingent
