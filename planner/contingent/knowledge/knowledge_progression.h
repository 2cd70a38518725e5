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

// What effects that happen at once do to knowledge (progression). Of those whose condition is not
// known, each world has its own, if they ask the world alone (GroundEffect::is_of_worlds).
class KnowledgeProgression {
 public:
  // Keeps references.
  KnowledgeProgression(const GroundTask& task, AtomKnowledge& atoms)
      : task_(task), layout_(task), queries_(task, atoms), numbers_(task), atoms_(atoms) {}

  // None if an effect on Kx or on bounds contradicts what is known, or may do so, if a function may
  // get two values, or if it cannot be told whether an effect happens.
  std::optional<KnowledgeState> After(const std::vector<GroundEffect>& effects,
                                      const KnowledgeState& before);
  // The same of one effect that happens.
  std::optional<KnowledgeState> AfterCertain(const GroundEffect& effect,
                                             const KnowledgeState& before);

  // Whether a state was ever refused because it could not be told what happens.
  bool has_doubted() const { return has_doubted_; }

 private:
  struct Changes {
    OpenBounds bounds;
    std::vector<const GroundChange*> certain = {};
    std::map<AtomId, PossibleChange> possible = {};
    // Of numbers, which may have happened, and where.
    std::vector<ChangeSomewhere> unsettled = {};
    std::set<FunctionId> deciding = {};  // numbers on which it depends what happens
    bool are_told = true;                // else whether an effect happens is not
  };

  Changes ChangesOf(const std::vector<GroundEffect>& effects, const KnowledgeState& state);
  void AddOfWorlds(const GroundEffect& effect, const KnowledgeState& state, Changes& changes);
  // What an effect does to the world whose condition is not known, but true in the worlds `where`.
  void AddPossible(const GroundChange& change, Diagram where, Changes& changes);
  void JoinWithPossible(Changes& changes) const;
  // Whether there are worlds in which a function is given two values.
  bool MayGiveTwoValues(const Changes& changes, const KnowledgeState& before);

  std::optional<KnowledgeState> After(const Changes& changes, const KnowledgeState& before);
  void Apply(const GroundChange& change, const KnowledgeState& before, KnowledgeState& state);
  void ApplyUnsettled(const Changes& changes, const KnowledgeState& before, KnowledgeState& state);
  // False if a bound is told of a number that hangs together with something else: it might tell
  // of that, or contradict it.
  bool CanTellBounds(const Changes& changes, const KnowledgeState& state) const;
  // False if a relation or a bound contradicts what is known.
  bool Relate(const GroundChange& change, KnowledgeState& state);

  const GroundTask& task_;
  StateLayout layout_;
  KnowledgeQueries queries_;
  NumberKnowledge numbers_;
  AtomKnowledge& atoms_;
  bool has_doubted_ = false;
};

}  // namespace assay::contingent
