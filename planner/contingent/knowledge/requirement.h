#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "planner/contingent/knowledge/knowledge_space.h"
#include "planner/contingent/language/two_values.h"

namespace assay::contingent {

// What a knowledge state must be like for a sub-plan to work from it. A sub-plan works from a state
// if it does from every world that the state allows; so what it requires is a set of worlds, its
// weakest precondition, and the sub-plan of one state serves every state within that set. What a
// plan asks that is not about worlds (that something is not known, what is in Kw and Kv, intervals)
// is required to be as it was.
struct Requirement {
  Diagram worlds = kAllSets;
  std::vector<bool> same;  // aspects of the state, by AspectOf...; empty: none
};

// Requirements of sub-plans from those of their parts: what must hold before a step, so that what
// is required after it holds then (regression).
class Regression {
 public:
  explicit Regression(KnowledgeSpace& space);

  Requirement OfGoal(StateId state);
  // `after`: the requirements of the sub-plans that follow, by outcome.
  Requirement OfStep(StateId state, const Transition& transition,
                     const std::vector<const Requirement*>& after);

  // Whether a sub-plan that was made in the state `made_in` works in the other as well.
  bool Suits(const Requirement& requirement, StateId made_in, StateId other);

 private:
  const GroundTask& task() const { return space_.task(); }
  std::size_t AspectOf(AtomId atom) const { return atom.index(); }
  std::size_t AspectOf(FormulaId formula) const { return first_formula_ + formula.index(); }
  std::size_t AspectOf(FunctionId function) const { return first_function_ + function.index(); }
  // The interval of a numeric function; AspectOf is what has been sensed of it.
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
  // Adds what makes the query hold, given that it holds in the state.
  void Require(const GroundQuery& query, StateId state, Requirement& requirement);
  // Adds what the formula is known to be in the state, true or false.
  void RequireDetermined(FormulaId formula, const KnowledgeState& here, Requirement& requirement);
  // Keeps what tells whether the formula is true.
  void KeepDetermining(FormulaId formula, Requirement& requirement) const;
  // Keeps everything that the query asks of.
  void KeepAsked(const GroundQuery& query, Requirement& requirement) const;
  Requirement WithTold(const GroundAction& action, const Requirement& after) const;
  // What an action does in the worlds, where bounds are variables.
  struct Happening {
    std::vector<ChangeSomewhere> changes;
    Diagram told = kAllSets;     // the worlds that it says are left
    std::vector<int> forgotten;  // variables
  };
  Happening WhatHappens(const GroundAction& action, StateId state, OpenBounds& bounds);
  // By variable, of the atoms that may change.
  std::unordered_map<int, Diagram> ValuesAfter(const Happening& happening);
  void RegressWorlds(const GroundAction& action, StateId state, const Requirement& after,
                     Requirement& before);
  void RegressAspects(const GroundAction& action, const Requirement& after, Requirement& before);
  std::vector<std::size_t> AspectsOf(const GroundChange& change) const;
  bool Settles(const GroundChange& change) const;
  // If something of the atom's relation is kept, then all that branching on the atom depends on.
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
