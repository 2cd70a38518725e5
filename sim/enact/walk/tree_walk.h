#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "planner/contingent/tree/plan_tree.h"
#include "sim/enact/walk/audit.h"

namespace assay::enact {

// A branch that was taken.
struct TakenBranch {
  contingent::NodeId node;
  std::size_t child = 0;
  std::string text;         // "isSpillable(can1)"
  bool is_flipped = false;  // what was sensed has been made wrong

  bool operator==(const TakenBranch&) const = default;
};

struct WalkedStep {
  std::string action;  // "grasp(can1)"
  double end = 0;      // seconds of simulated time
};

enum class WalkEnd {
  kGoal,       // a leaf was come to
  kOperator,   // a person takes over: that leaf, or nothing that was tried mended an error
  kStopped,    // a skill could not be done
  kUncertain,  // what was sensed left a branch open, however often it was sensed
  kEndless,    // too many actions
};

struct Walk {
  std::vector<WalkedStep> steps = {};
  std::vector<TakenBranch> branches = {};
  std::vector<FalseClaim> false_claims = {};  // the first of each
  bool is_flipped = false;                    // something that was sensed has been made wrong
  WalkEnd end = WalkEnd::kGoal;
  std::string reason = {};  // of another end
};

struct WalkOptions {
  double sensing_errors = 0;       // probability that what is sensed is made wrong
  RandomStream* random = nullptr;  // of these errors, and of the hand's
  std::function<void(const std::string& action)> on_step_start = {};  // its name in the task
  std::function<void(const WalkedStep&)> on_step_end = {};
};

// A contingent plan on its way: nodes that act run the skill of their action, branches follow what
// sensors have told. After each action the knowledge that the plan claims is audited.
class TreeWalk {
 public:
  // Keeps references.
  TreeWalk(const Interpretation& interpretation, const contingent::PlanTree& tree,
           Situation& situation, const WalkOptions& options);

  Walk Go();

 private:
  // One node; none: the walk ends here.
  std::optional<contingent::NodeId> Arrive();
  std::optional<contingent::NodeId> Act(const contingent::PlanNode& node);
  std::optional<contingent::NodeId> Whether(contingent::NodeId id);
  std::optional<contingent::NodeId> ByValue(contingent::NodeId id);
  exec::Progress Do(const contingent::GroundAction& action);
  std::optional<bool> Told(contingent::AtomId atom) const;
  std::optional<bool> Told(const contingent::Bound& bound) const;
  std::optional<bool> Told(contingent::FormulaId formula) const;
  // The place of the value that is told; none: nothing tells which of them it is.
  std::optional<std::size_t> ToldValue(const std::vector<contingent::AtomId>& values) const;
  // What `ask` answers; as long as it is open, the last action, if it senses, is done again.
  template <class Ask>
  auto Sensed(const Ask& ask) -> decltype(ask());
  // What counts as sensed becomes known as sensors tell it. What they do not tell, in words; it no
  // longer counts as sensed, in `sensed` neither, which otherwise stays as it is.
  std::vector<std::string> LearnSensedFormulas(contingent::KnowledgeState& sensed);
  std::vector<std::string> LearnSensedValues(contingent::KnowledgeState& sensed);
  // False if what sensors tell contradicts what is known: then they have told nothing.
  bool Learn(std::optional<contingent::KnowledgeState> learned);
  std::string WordsOf(contingent::FormulaId formula) const;
  const std::string& WordsOf(contingent::FunctionId function) const;
  std::optional<contingent::NodeId> NotTold(const std::string& what);
  // Whether what is sensed now is to be wrong.
  bool IsFlipped();
  // A number that the action has read becomes further off than its claim allows.
  void FlipReadings(const contingent::GroundAction& action);
  std::size_t Flipped(std::size_t value, std::size_t count) const { return (value + 1) % count; }
  std::optional<contingent::NodeId> Take(contingent::NodeId id, std::size_t child, bool is_flipped);
  std::optional<contingent::NodeId> End(WalkEnd end, const std::string& reason);
  void AuditNow();

  const Interpretation& interpretation_;
  const contingent::PlanTree& tree_;
  Situation& situation_;
  const WalkOptions& options_;
  Audit audit_;
  contingent::KnowledgeBase knowledge_;
  contingent::KnowledgeState state_;
  contingent::ActionId last_;
  Walk walk_;
};

}  // namespace assay::enact
