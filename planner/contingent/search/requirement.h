#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "planner/contingent/knowledge/knowledge_space.h"
#include "planner/contingent/language/two_values.h"

namespace assay::contingent {

// The requirement on a knowledge state for a sub-plan to work from it. A sub-plan works from a
// state if it works from every world that the state allows. Its requirement is therefore a set of
// worlds, the weakest precondition, and the sub-plan serves every state within that set. Some
// conditions of a plan are not about worlds: that something is not known, Kw, Kv and intervals. For
// these, the state must equal the state for which the sub-plan was made.
struct Requirement {
  Diagram worlds = kAllSets;
  // The aspects of the state, by AspectOf..., that must stay the same. Empty if there are none.
  std::vector<bool> same;
};

// Computes the requirement of a sub-plan from the requirements of its parts (regression): the
// condition before a step that ensures the required condition after it.
class Regression {
 public:
  explicit Regression(KnowledgeSpace& space);

  Requirement OfGoal(StateId state);
  // Returns the requirement before a step. `after` contains the requirements of the sub-plans that
  // follow, by outcome.
  Requirement OfStep(StateId state, const Transition& transition,
                     const std::vector<const Requirement*>& after);

  // Returns true if a sub-plan that was made in the state `made_in` works in the state `other`.
  bool Suits(const Requirement& requirement, StateId made_in, StateId other);

 private:
  const GroundTask& task() const { return space_.task(); }
  std::size_t AspectOf(AtomId atom) const { return atom.index(); }
  std::size_t AspectOf(FormulaId formula) const { return first_formula_ + formula.index(); }
  std::size_t AspectOf(FunctionId function) const { return first_function_ + function.index(); }
  // Returns the aspect of a numeric function's interval. AspectOf returns the aspect of its sensed
  // value.
  std::size_t AspectOfRange(FunctionId function) const {
    return first_range_ + task().functions[function.index()].slot;
  }
  void Keep(Requirement& requirement, std::size_t aspect) const;
  bool Keeps(const Requirement& requirement, std::size_t aspect) const {
    return !requirement.same.empty() && requirement.same[aspect];
  }
  void KeepAll(Requirement& requirement, const std::vector<bool>& same) const;

  Requirement OfAction(StateId state, const GroundAction& action, const Requirement& after);
  Requirement OfFormula(StateId state, FormulaId formula, const Requirement& if_true,
                        const Requirement& if_false);
  Requirement OfValue(StateId state, const Transition& transition,
                      const std::vector<Requirement>& after);
  Requirement BeforeUpdates(const Requirement& after, StateId outcome);
  // Adds the condition that makes the query hold, given that it holds in the state.
  void Require(const GroundQuery& query, StateId state, Requirement& requirement);
  // Adds the condition that the formula is known to have its truth value in the state.
  void RequireDetermined(FormulaId formula, const KnowledgeState& here, Requirement& requirement);
  // Keeps the aspects that determine whether the formula is true.
  void KeepDetermining(FormulaId formula, Requirement& requirement) const;
  // Keeps the aspects of everything that the query asks about.
  void KeepAsked(const GroundQuery& query, Requirement& requirement) const;
  Requirement WithAsserted(const GroundAction& action, const Requirement& after) const;
  // The changes of an action by world. The bounds are variables of the diagrams.
  struct Happening {
    std::vector<ChangeSomewhere> changes;
    Diagram asserted = kAllSets;  // the worlds that remain after the action's relations and bounds
    std::vector<int> forgotten;   // variables of forgotten atoms
  };
  Happening WhatHappens(const GroundAction& action, StateId state, OpenBounds& bounds);
  // Returns the value after the action of each atom that may change, by variable.
  std::unordered_map<int, Diagram> ValuesAfter(const Happening& happening);
  void RegressWorlds(const GroundAction& action, StateId state, const Requirement& after,
                     Requirement& before);
  void RegressAspects(const GroundAction& action, const Requirement& after, Requirement& before);
  std::vector<std::size_t> AspectsOf(const GroundChange& change) const;
  bool Settles(const GroundChange& change) const;
  // If an atom of the relation is kept, keeps everything on which a branch on the atom depends.
  void KeepRelation(AtomId atom, StateId state, Requirement& requirement);

  KnowledgeSpace& space_;
  KnowledgeBase& knowledge_;
  WorldSets& worlds_;
  std::size_t first_formula_;
  std::size_t first_function_;
  std::size_t first_range_;
  std::size_t aspects_;
};

}  // namespace assay::contingent
