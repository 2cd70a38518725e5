#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "planner/contingent/plan_tree/plan_tree.h"
#include "sim/execution/trial/trial_outcome.h"
#include "sim/execution/walk/audit.h"

namespace assay::execution {

// A branch of the tree that a walk took.
struct TakenBranch {
  contingent::NodeId node;
  std::size_t child = 0;
  std::string text;         // "isSpillable(can1)"
  bool is_flipped = false;  // the sensed value was made wrong on purpose

  bool operator==(const TakenBranch&) const = default;
};

struct WalkedStep {
  std::string action;  // "grasp(can1)"
  double end = 0;      // seconds of simulated time
  // The action's node. If a sensing action is repeated, the branch that asked for it.
  contingent::NodeId node = contingent::NodeId::None();
};

struct Walk {
  std::vector<WalkedStep> steps = {};
  std::vector<TakenBranch> branches = {};
  std::vector<FalseClaim> false_claims = {};    // the first occurrence of each false claim
  bool is_flipped = false;                      // some sensed value was made wrong on purpose
  TrialOutcome end = TrialOutcome::kSucceeded;  // the walk reached a leaf, or why it ended before
  std::string reason = {};                      // why the walk ended before a leaf
};

struct WalkOptions {
  double sensing_errors = 0;       // probability that a sensed value is made wrong
  RandomStream* random = nullptr;  // draws the errors of sensing and of the hand
  // Called with the action's name in the task.
  std::function<void(const std::string& action)> on_step_start = {};
  std::function<void(const WalkedStep&)> on_step_end = {};
};

// Executes a contingent plan. An action node runs the skill of its action, and a branch node
// follows what the sensors have read. After each action and each branch an audit compares the
// knowledge that the plan claims with the truth.
class TreeWalk {
 public:
  // Keeps references to all arguments.
  TreeWalk(const Interpretation& interpretation, const contingent::PlanTree& tree,
           Situation& situation, const WalkOptions& options);

  Walk Go();

 private:
  // Each of these functions executes one node and returns the next one, or std::nullopt at the end
  // of the walk.
  std::optional<contingent::NodeId> Arrive();
  std::optional<contingent::NodeId> Act(const contingent::PlanNode& node);
  std::optional<contingent::NodeId> Whether(contingent::NodeId id);
  std::optional<contingent::NodeId> ByValue(contingent::NodeId id);
  Progress Do(const contingent::GroundAction& action);
  std::optional<bool> Observed(contingent::AtomId atom) const;
  std::optional<bool> Observed(const contingent::Bound& bound) const;
  std::optional<bool> Observed(contingent::FormulaId formula) const;
  // Returns the index of the value that sensors have observed; none if the sensors leave the value
  // open.
  std::optional<std::size_t> ObservedValue(const std::vector<contingent::AtomId>& values) const;
  // Returns the answer of `ask`. While the answer is open, the last action is repeated if it is a
  // sensing action.
  template <class Ask>
  auto Sensed(const Ask& ask) -> decltype(ask());
  // Turn the facts that count as sensed into knowledge, by the readings of the sensors. Return, in
  // words, the facts that the sensors left open. These facts then count as sensed neither in state_
  // nor in `sensed`. Nothing else in `sensed` changes.
  std::vector<std::string> LearnSensedFormulas(contingent::KnowledgeState& sensed);
  std::vector<std::string> LearnSensedValues(contingent::KnowledgeState& sensed);
  // Takes over the new knowledge. Returns false, and changes nothing, if there is none because the
  // readings contradict what is known.
  bool Learn(std::optional<contingent::KnowledgeState> learned);
  std::string WordsOf(contingent::FormulaId formula) const;
  const std::string& WordsOf(contingent::FunctionId function) const;
  std::optional<contingent::NodeId> NotObserved(const std::string& what);
  // Draws whether the value that is sensed now is made wrong.
  bool IsFlipped();
  // Draws which numbers of a sensing action are made wrong, by more than their claims allow.
  void FlipReadings(const contingent::GroundAction& action);
  std::size_t Flipped(std::size_t value, std::size_t count) const { return (value + 1) % count; }
  std::optional<contingent::NodeId> Take(contingent::NodeId id, std::size_t child, bool is_flipped);
  std::optional<contingent::NodeId> End(TrialOutcome end, const std::string& reason);
  void AuditNow();

  const Interpretation& interpretation_;
  const contingent::PlanTree& tree_;
  Situation& situation_;
  const WalkOptions& options_;
  Audit audit_;
  contingent::KnowledgeBase knowledge_;
  contingent::KnowledgeState state_;
  contingent::NodeId at_;
  contingent::ActionId last_;
  Walk walk_;
};

}  // namespace assay::execution
