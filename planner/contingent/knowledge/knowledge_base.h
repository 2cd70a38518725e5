#pragma once

#include <optional>
#include <vector>

#include "planner/contingent/grounding/ground_task.h"
#include "planner/contingent/knowledge/atom_knowledge.h"
#include "planner/contingent/knowledge/knowledge_progression.h"
#include "planner/contingent/knowledge/knowledge_queries.h"
#include "planner/contingent/knowledge/knowledge_state.h"
#include "planner/contingent/knowledge/number_knowledge.h"
#include "planner/contingent/world_sets/world_sets.h"

namespace assay::contingent {

// Answers queries about knowledge, and changes knowledge by actions, sensing and update rules.
class KnowledgeBase {
 public:
  // Keeps a reference to the task.
  explicit KnowledgeBase(const GroundTask& task);
  KnowledgeBase(const KnowledgeBase&) = delete;
  KnowledgeBase& operator=(const KnowledgeBase&) = delete;

  const GroundTask& task() const { return task_; }
  const StateLayout& layout() const { return layout_; }
  WorldSets& worlds() { return atoms_.worlds(); }

  // Returns the initial knowledge. Throws InputError in three cases: an alternative of init cannot
  // hold; init contradicts itself; or an update rule excludes all alternatives of init, or all
  // values of a number. The error names the place of the alternative, the change or the rule. Like
  // every function that makes a state, it throws InputError at an update rule if the rules do not
  // come to rest.
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

  // Returns the state after an action whose precondition holds, and after the update rules. Returns
  // none in three cases: an effect on Kx or on bounds contradicts the knowledge, or may do so; the
  // action may give a function two values; or it is undecided whether an effect or a rule happens.
  std::optional<KnowledgeState> After(const GroundAction& action, const KnowledgeState& state);

  // Returns the first formula of Kw, or none if Kw is empty. If a conjunction turns out false, none
  // of its literals may become known, but the literals become related.
  FormulaId FormulaToBranch(const KnowledgeState& state) const;
  // Returns whether the value will be known at run time, and is not known at plan time.
  bool IsInKv(FunctionId function, const KnowledgeState& state) const {
    return layout_.IsSensed(state, function);
  }
  // Returns the functions of Kv whose possible values are listed by Kx.
  std::vector<FunctionId> FunctionsToBranch(const KnowledgeState& state);
  // Returns the values that the function may have: all values except those that are known not to be
  // the value of the function.
  std::vector<AtomId> PossibleValues(FunctionId function, const KnowledgeState& state) const;

  // Returns the state after the formula turned out true or false, or after the literal turned out
  // true, and after the update rules. Returns none if the new fact or a rule contradicts the
  // knowledge.
  std::optional<KnowledgeState> Learned(const KnowledgeState& state, FormulaId formula, bool value);
  std::optional<KnowledgeState> Learned(const KnowledgeState& state, GroundLiteral literal);

  std::vector<GroundLiteral> UndeterminedLiterals(FormulaId formula,
                                                  const KnowledgeState& state) const;

  // Returns true if a state was ever refused because it was undecided what happens there. A refusal
  // because of a contradiction does not count.
  bool has_doubted() const { return has_doubted_ || progression_.has_doubted(); }

 private:
  // Adds the relations in their order. Returns the first one that contradicts the state's knowledge
  // or an earlier relation, or null if there is none.
  const InitialRelation* RelateAll(KnowledgeState& state,
                                   const std::vector<InitialRelation>& relations);
  // Returns true if the relations do not contradict the state's knowledge.
  bool CanLast(const std::vector<InitialRelation>& relations, KnowledgeState state);
  // Applies the update rules until they change nothing more. Returns the rule that fails, or null.
  // A rule fails in three cases: a relation or a bound contradicts the knowledge after the rule;
  // the rule leaves no alternative of the `lasting` relations; or it is undecided whether the
  // rule's condition holds, because more may be known than the state says
  // (KnowledgeQueries::MayHold). A rule K(c) with a `c` that is simply unknown does not fail: it
  // does not apply.
  const GroundEffect* ApplyUpdates(KnowledgeState& state,
                                   const std::vector<InitialRelation>& lasting = {});
  [[noreturn]] void FailRestless(const GroundEffect& update, std::size_t rounds) const;
  // Returns the state after the update rules, in canonical form, or none if a rule fails.
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
