#pragma once

#include <map>
#include <optional>
#include <set>
#include <vector>

#include "planner/contingent/grounding/ground_task.h"
#include "planner/contingent/knowledge/atom_knowledge.h"
#include "planner/contingent/knowledge/knowledge_queries.h"
#include "planner/contingent/knowledge/knowledge_state.h"
#include "planner/contingent/knowledge/number_knowledge.h"
#include "planner/contingent/knowledge/open_bounds.h"
#include "planner/contingent/language/two_values.h"

namespace assay::contingent {

// Computes how effects that happen at once change knowledge (progression). An effect whose
// condition is not known happens in some worlds and not in others, provided that the condition asks
// only about the world (GroundEffect::is_of_worlds).
class KnowledgeProgression {
 public:
  // Keeps references to the task and the atoms.
  KnowledgeProgression(const GroundTask& task, AtomKnowledge& atoms)
      : task_(task), layout_(task), queries_(task, atoms), numbers_(task), atoms_(atoms) {}

  // Returns the state after the effects. Returns none in three cases: an effect on Kx or on bounds
  // contradicts the knowledge, or may do so; a function may get two values; or it is undecided
  // whether an effect happens.
  std::optional<KnowledgeState> After(const std::vector<GroundEffect>& effects,
                                      const KnowledgeState& before);
  // Returns the state after one effect that certainly happens. Returns none in the three cases in
  // which After does.
  std::optional<KnowledgeState> AfterCertain(const GroundEffect& effect,
                                             const KnowledgeState& before);

  // Returns true if a state was ever refused because it was undecided what happens.
  bool has_doubted() const { return has_doubted_; }

 private:
  struct Changes {
    OpenBounds bounds;
    std::vector<const GroundChange*> certain = {};
    std::map<AtomId, PossibleChange> possible = {};
    // changes of numbers that may have happened, with the worlds where they happen
    std::vector<ChangeSomewhere> unsettled = {};
    std::set<FunctionId> deciding = {};  // the numbers that decide which changes happen
    bool are_decided = true;             // false if it is undecided whether an effect happens
  };

  Changes ChangesOf(const std::vector<GroundEffect>& effects, const KnowledgeState& state);
  void AddOfWorlds(const GroundEffect& effect, const KnowledgeState& state, Changes& changes);
  // Adds a change by an effect whose condition is not known but holds in the worlds `where`.
  void AddPossible(const GroundChange& change, Diagram where, Changes& changes);
  void JoinWithPossible(Changes& changes) const;
  // Returns true if there are worlds in which a function is given two values.
  bool MayGiveTwoValues(const Changes& changes, const KnowledgeState& before);

  std::optional<KnowledgeState> After(const Changes& changes, const KnowledgeState& before);
  void Apply(const GroundChange& change, const KnowledgeState& before, KnowledgeState& state);
  void ApplyUnsettled(const Changes& changes, const KnowledgeState& before, KnowledgeState& state);
  // Returns false if a change bounds a number that depends on something else. Such a bound might
  // say something about the other quantity, or contradict it.
  bool CanTellBounds(const Changes& changes, const KnowledgeState& state) const;
  // Applies a relation or a bound. Returns false if it contradicts the knowledge.
  bool Relate(const GroundChange& change, KnowledgeState& state);

  const GroundTask& task_;
  StateLayout layout_;
  KnowledgeQueries queries_;
  NumberKnowledge numbers_;
  AtomKnowledge& atoms_;
  bool has_doubted_ = false;
};

}  // namespace assay::contingent
