#pragma once

#include <map>
#include <optional>
#include <set>
#include <vector>

#include "planner/contingent/decision_diagram.h"
#include "planner/contingent/ground_task.h"
#include "planner/contingent/knowledge_state.h"
#include "planner/contingent/open_bounds.h"

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

  // Surely: that something is not known does not hold where more may be known than the state says
  // (of numbers that hang together with others).
  bool Holds(const GroundQuery& query, const KnowledgeState& state) const;
  // Not surely not.
  bool MayHold(const GroundQuery& query, const KnowledgeState& state) const;

  // After an action whose precondition holds, and the update rules. None if an effect on Kx or
  // on bounds contradicts what is known, or may do so, if it may give a function two values, or if
  // it cannot be told whether an effect or a rule happens.
  std::optional<KnowledgeState> After(const GroundAction& action, const KnowledgeState& state);

  // A formula of Kw that branches now: it has one undetermined literal, all others are known to be
  // true (a conjunction's negation could else not be told), or it is a bound. None if there is
  // none.
  FormulaId FormulaToBranch(const KnowledgeState& state) const;
  // The functions of Kv whose possible values Kx tells.
  std::vector<FunctionId> FunctionsToBranch(const KnowledgeState& state);
  // The values that a function may have: those not known to be none.
  std::vector<AtomId> PossibleValues(FunctionId function, const KnowledgeState& state) const;

  // When the formula turns out true or false, when a literal turns out to hold, and after the
  // update rules. None if that, or one of these, contradicts what is known.
  std::optional<KnowledgeState> Learned(const KnowledgeState& state, FormulaId formula, bool value);
  std::optional<KnowledgeState> Learned(const KnowledgeState& state, GroundLiteral literal);

  // The one undetermined literal of a formula that branches; none of a bound.
  GroundLiteral UndeterminedLiteral(FormulaId formula, const KnowledgeState& state) const;

  // Diagrams over worlds. The variable of an atom; the atom of a variable, which is of one, or of
  // an open bound.
  int Variable(AtomId atom) const { return 2 * places_[atom.index()]; }
  AtomId AtomOf(int variable) const { return atom_at_[variable / 2]; }
  bool IsOfAtom(int variable) const { return variable < 2 * std::ssize(atom_at_); }
  Diagram WorldsWhere(GroundLiteral literal) {
    return diagrams_.Literal({Variable(literal.atom), literal.is_positive});
  }
  // Where a condition that asks K alone is true.
  Diagram WorldsWhere(const GroundQuery& condition, OpenBounds& bounds);
  // Where exactly one, or at least one, of the literals holds.
  Diagram WorldsWhere(const std::vector<GroundLiteral>& literals, bool is_inclusive);
  // Whether all worlds that the state allows are in the set.
  bool IsWithin(const KnowledgeState& state, Diagram worlds);
  // Kx's relation that the atom is in; kAllSets if none.
  Diagram RelationOf(const KnowledgeState& state, AtomId atom);

 private:
  // What possible effects do to an atom: where it becomes true, where else false, and where else it
  // may be either.
  struct Possible {
    Diagram becomes_true = kEmptySet;
    Diagram becomes_false = kEmptySet;
    Diagram becomes_open = kEmptySet;
  };
  struct Changes {
    OpenBounds bounds;
    std::vector<const GroundChange*> certain = {};
    std::map<AtomId, Possible> possible = {};
    // Of numbers, which may have happened, and where.
    std::vector<std::pair<const GroundChange*, Diagram>> unsettled = {};
    std::set<FunctionId> deciding = {};  // numbers on which it depends what happens
    bool are_told = true;                // else whether an effect happens is not
  };

  bool BoundHolds(const Bound& bound, const KnowledgeState& state) const;
  bool IsValueKnown(const GroundQuery& query, const KnowledgeState& state) const;
  const Range& RangeOf(FunctionId function, const KnowledgeState& state) const {
    return state.ranges[task_.functions[function.index()].slot];
  }
  Range& RangeOf(FunctionId function, KnowledgeState& state) const {
    return state.ranges[task_.functions[function.index()].slot];
  }
  bool IsDetermined(const Formula& formula, const KnowledgeState& state) const;

  Changes ChangesOf(const std::vector<GroundEffect>& effects, const KnowledgeState& state);
  void JoinWithPossible(Changes& changes) const;
  void AddOfWorlds(const GroundEffect& effect, const KnowledgeState& state, Changes& changes);
  // What an effect does to the world whose condition is not known, but true in the worlds `where`.
  void AddPossible(const GroundChange& change, Diagram where, Changes& changes);
  // Whether there are worlds in which a function is given two values.
  bool MayGiveTwoValues(const Changes& changes, const KnowledgeState& before);
  // False if a relation or a bound contradicts what is known, or a function may get two values.
  bool Apply(const Changes& changes, const KnowledgeState& before, KnowledgeState& state);
  // False if a bound is told of a number that hangs together with something else: it might tell
  // of that, or contradict it.
  bool CanTellBounds(const Changes& changes, const KnowledgeState& state) const;
  void Apply(const GroundChange& change, const KnowledgeState& before, KnowledgeState& state);
  void ApplyPossible(const Changes& changes, KnowledgeState& state);
  // The rule after which a relation or a bound contradicts what is known, which leaves no
  // alternative of the relations that last, or of which it cannot be told whether it happens; null:
  // there is none.
  const GroundEffect* ApplyUpdates(KnowledgeState& state,
                                   const std::vector<InitialRelation>& lasting = {});
  // After the update rules, in canonical form; none if one contradicts what is known.
  std::optional<KnowledgeState> Settled(KnowledgeState state);
  [[noreturn]] void FailRestless(const GroundEffect& update, std::size_t rounds) const;
  // The first of the relations that contradicts what is known or those before; null: none does.
  const InitialRelation* RelateAll(KnowledgeState& state,
                                   const std::vector<InitialRelation>& relations);
  void Canonicalize(KnowledgeState& state) const;

  void Set(KnowledgeState& state, GroundLiteral literal);
  void Forget(KnowledgeState& state, AtomId atom);
  void SenseValue(KnowledgeState& state, FunctionId function, double error) const;
  void ForgetNumber(KnowledgeState& state, FunctionId function) const;
  void Assign(const GroundChange& change, const KnowledgeState& before,
              KnowledgeState& state) const;
  // What may have happened to a number leaves its interval wide enough for both.
  void Unsettle(const GroundChange& change, const KnowledgeState& before, KnowledgeState& state);
  void Unrelate(KnowledgeState& state, AtomId atom);
  void UnsenseWith(KnowledgeState& state, AtomId atom);
  void Learn(KnowledgeState& state, GroundLiteral literal);
  void Learn(KnowledgeState& state, const Bound& bound) const;
  bool Relate(KnowledgeState& state, const std::vector<GroundLiteral>& literals, bool is_inclusive);
  // False if the literals cannot all hold (`value`), or not all.
  bool LearnConjunction(KnowledgeState& state, const std::vector<GroundLiteral>& literals,
                        bool value);
  // Adds a relation of unknown atoms to those that are there; false if they cannot hold together.
  bool RelateAsWell(KnowledgeState& state, Diagram relation);
  // Takes out the relations that have one of the variables, or another value of a function of which
  // they have one, and returns what they say together, with unique names.
  Diagram TakeRelations(KnowledgeState& state, std::vector<int> variables);
  FunctionId FunctionOf(int variable) const;
  // The values that are neither known to be the function's nor not to be.
  std::vector<int> OpenValues(FunctionId function, const KnowledgeState& state) const;
  // Where the functions of which there are values among the variables have one value at most.
  Diagram UniqueNames(const std::vector<int>& variables, const KnowledgeState& state);
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
