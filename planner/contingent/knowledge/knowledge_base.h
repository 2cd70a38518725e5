#pragma once

#include <optional>
#include <vector>

#include "planner/contingent/grounding/ground_task.h"
#include "planner/contingent/knowledge/atom_knowledge.h"
#include "planner/contingent/knowledge/knowledge_progression.h"
#include "planner/contingent/knowledge/knowledge_queries.h"
#include "planner/contingent/knowledge/knowledge_state.h"
#include "planner/contingent/knowledge/number_knowledge.h"
#include "planner/contingent/worlds/world_sets.h"

namespace assay::contingent {

// How knowledge is asked and how it changes: queries, actions, sensing, update rules.
class KnowledgeBase {
 public:
  // Keeps a reference to the task.
  explicit KnowledgeBase(const GroundTask& task);
  KnowledgeBase(const KnowledgeBase&) = delete;
  KnowledgeBase& operator=(const KnowledgeBase&) = delete;

  const GroundTask& task() const { return task_; }
  const StateLayout& layout() const { return layout_; }
  WorldSets& worlds() { return atoms_.worlds(); }

  // Throws InputError, with the place of an alternative that cannot hold, if init contradicts
  // itself, and with that of an update rule that leaves no alternative of init, or no number. This
  // and all that makes other states throws it at an update rule, if the rules do not come to rest.
  KnowledgeState Initial();

  // See KnowledgeQueries.
  bool Holds(const GroundQuery& query, const KnowledgeState& state) const {
    return queries_.Holds(query, state);
  }
  bool MayHold(const GroundQuery& query, const KnowledgeState& state) const {
    return queries_.MayHold(query, state);
  }
  // See AtomKnowledge.
  bool IsWithin(const KnowledgeState& state, Diagram worlds) {
    return atoms_.IsWithin(state, worlds);
  }
  Diagram RelationOf(const KnowledgeState& state, AtomId atom) {
    return atoms_.RelationOf(state, atom);
  }

  // After an action whose precondition holds, and the update rules. None if an effect on Kx or
  // on bounds contradicts what is known, or may do so, if it may give a function two values, or if
  // it cannot be told whether an effect or a rule happens.
  std::optional<KnowledgeState> After(const GroundAction& action, const KnowledgeState& state);

  // The first formula of Kw; none if Kw is empty. That a conjunction is false may settle none of
  // its literals, but relates them.
  FormulaId FormulaToBranch(const KnowledgeState& state) const;
  // The functions of Kv whose possible values Kx tells.
  std::vector<FunctionId> FunctionsToBranch(const KnowledgeState& state);
  // The values that a function may have: those not known to be none.
  std::vector<AtomId> PossibleValues(FunctionId function, const KnowledgeState& state) const;

  // When the formula turns out true or false, when a literal turns out to hold, and after the
  // update rules. None if that, or one of these, contradicts what is known.
  std::optional<KnowledgeState> Learned(const KnowledgeState& state, FormulaId formula, bool value);
  std::optional<KnowledgeState> Learned(const KnowledgeState& state, GroundLiteral literal);

  std::vector<GroundLiteral> UndeterminedLiterals(FormulaId formula,
                                                  const KnowledgeState& state) const;

  // Whether a state was ever refused because it could not be told what happens there, and not
  // because what would happen contradicts what is known.
  bool has_doubted() const { return has_doubted_ || progression_.has_doubted(); }

 private:
  // The first of the relations that contradicts what is known or those before; null: none does.
  const InitialRelation* RelateAll(KnowledgeState& state,
                                   const std::vector<InitialRelation>& relations);
  // Whether they do not contradict what is known.
  bool CanLast(const std::vector<InitialRelation>& relations, KnowledgeState state);
  // The rule after which a relation or a bound contradicts what is known, which leaves no
  // alternative of the relations that last, or of which it cannot be told whether it happens; null:
  // there is none.
  const GroundEffect* ApplyUpdates(KnowledgeState& state,
                                   const std::vector<InitialRelation>& lasting = {});
  [[noreturn]] void FailRestless(const GroundEffect& update, std::size_t rounds) const;
  // After the update rules, in canonical form; none if one contradicts what is known.
  std::optional<KnowledgeState> Settled(KnowledgeState state);
  void Canonicalize(KnowledgeState& state) const;

  const GroundTask& task_;
  StateLayout layout_;
  NumberKnowledge numbers_;
  AtomKnowledge atoms_;
  KnowledgeQueries queries_;
  KnowledgeProgression progression_;
  bool has_doubted_ = false;
};

}  // namespace assay::contingent
