#include "sim/execution/walk/tree_walk.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "planner/base/check.h"
#include "planner/contingent/plan_tree/tree_text.h"
#include "planner/geometry/pose.h"

namespace assay::execution {

using contingent::AtomId;
using contingent::FormulaId;
using contingent::FunctionId;
using contingent::GroundAction;
using contingent::KnowledgeState;
using contingent::NodeId;
using contingent::PlanNode;

namespace {

constexpr int kMostActions = 1000;
constexpr int kMostSensings = 5;  // of the same thing in a row

// Returns whether the action only senses, so that it can be repeated.
bool IsSensing(const GroundAction& action) {
  using Kind = contingent::GroundChange::Kind;
  return std::ranges::all_of(action.effects, [](const contingent::GroundEffect& effect) {
    return std::ranges::all_of(effect.changes, [](const contingent::GroundChange& change) {
      return change.kind == Kind::kSense || change.kind == Kind::kSenseValue;
    });
  });
}

Pose DrawnHandError(const domain::PoseError& error, RandomStream& random) {
  const auto draw = [&](const Interval& range) { return random.Uniform(range.low, range.high); };
  const double x = draw(error.x);
  const double y = draw(error.y);
  const double z = draw(error.z);
  return geometry::Translation(x, y, z) * geometry::RotationZ(draw(error.theta));
}

}  // namespace

TreeWalk::TreeWalk(const Interpretation& interpretation, const contingent::PlanTree& tree,
                   Situation& situation, const WalkOptions& options)
    : interpretation_(interpretation),
      tree_(tree),
      situation_(situation),
      options_(options),
      audit_(interpretation, situation.problem()),
      knowledge_(interpretation.task),
      state_(knowledge_.Initial()) {}

Walk TreeWalk::Go() {
  AuditNow();
  std::optional<NodeId> at = tree_.root;
  while (at) {
    const PlanNode& node = tree_.node(*at);
    at_ = *at;
    switch (node.kind) {
      case PlanNode::Kind::kGoal:
        at = Arrive();
        break;
      case PlanNode::Kind::kAct:
        at = Act(node);
        break;
      case PlanNode::Kind::kWhether:
        at = Whether(*at);
        break;
      case PlanNode::Kind::kValue:
        at = ByValue(*at);
        break;
    }
  }
  return std::move(walk_);
}

template <class Ask>
auto TreeWalk::Sensed(const Ask& ask) -> decltype(ask()) {
  for (int times = 1;; ++times) {
    const auto answer = ask();
    if (answer || times == kMostSensings || last_.IsNone()) return answer;
    const GroundAction& last = interpretation_.task.actions[last_.index()];
    if (!IsSensing(last) || Do(last)) return std::nullopt;
  }
}

// A plan may end with something sensed. Sensors must then have read it if the goal needs it, and
// their reading is claimed as knowledge. A goal may also require that something is sensed but not
// yet known. Such a goal holds before the reading is learned, so `sensed` is asked, too.
std::optional<NodeId> TreeWalk::Arrive() {
  KnowledgeState sensed = state_;
  std::vector<std::string> not_observed = LearnSensedFormulas(sensed);
  std::ranges::move(LearnSensedValues(sensed), std::back_inserter(not_observed));
  AuditNow();
  const contingent::GroundQuery& goal = interpretation_.task.goal;
  if (knowledge_.Holds(goal, sensed) || knowledge_.Holds(goal, state_)) return std::nullopt;
  ASSAY_CHECK(!not_observed.empty(), "the plan ends where its goal does not hold");
  return NotObserved(not_observed.front());
}

std::vector<std::string> TreeWalk::LearnSensedFormulas(KnowledgeState& sensed) {
  std::vector<std::string> not_observed;
  for (std::size_t i = 0; i < interpretation_.task.formulas.size(); ++i) {
    const FormulaId formula(i);
    if (!knowledge_.layout().IsSensed(state_, formula)) continue;
    const auto observed = Sensed([&] { return Observed(formula); });
    if (!observed || !Learn(knowledge_.Learned(state_, formula, *observed != IsFlipped()))) {
      knowledge_.layout().SetSensed(state_, formula, false);
      knowledge_.layout().SetSensed(sensed, formula, false);
      not_observed.push_back(WordsOf(formula));
    }
  }
  return not_observed;
}

// Only functions whose values are symbols are learned here. The audit checks readings of numeric
// functions itself.
std::vector<std::string> TreeWalk::LearnSensedValues(KnowledgeState& sensed) {
  std::vector<std::string> not_observed;
  for (std::size_t i = 0; i < interpretation_.task.functions.size(); ++i) {
    const FunctionId function(i);
    const bool is_number = interpretation_.task.functions[i].slot >= 0;
    if (is_number || !knowledge_.layout().IsSensed(state_, function)) continue;
    const std::vector<AtomId> values = knowledge_.PossibleValues(function, state_);
    std::optional<std::size_t> observed = Sensed([&] { return ObservedValue(values); });
    if (observed && values.size() > 1 && IsFlipped()) observed = Flipped(*observed, values.size());
    if (!observed || !Learn(knowledge_.Learned(state_, {values[*observed], true}))) {
      knowledge_.layout().SetSensed(state_, function, false);
      knowledge_.layout().SetSensed(sensed, function, false);
      not_observed.push_back(WordsOf(function));
    }
  }
  return not_observed;
}

bool TreeWalk::Learn(std::optional<KnowledgeState> learned) {
  if (learned) state_ = std::move(*learned);
  return learned.has_value();
}

std::optional<NodeId> TreeWalk::Act(const PlanNode& node) {
  const GroundAction& action = interpretation_.task.actions[node.action.index()];
  if (walk_.steps.size() >= kMostActions) {
    return End(TrialOutcome::kEndless, fmt::format("more than {} actions", kMostActions));
  }
  if (options_.on_step_start) options_.on_step_start(action.name);
  if (const Progress failure = Do(action)) {
    const bool is_called = failure->outcome == TrialOutcome::kOperatorCalled;
    return End(is_called ? failure->outcome : TrialOutcome::kStopped, failure->reason);
  }
  last_ = node.action;
  const auto after = knowledge_.After(action, state_);
  ASSAY_CHECK(after, "the plan's {} contradicts what is known", TextOf(action));
  state_ = *after;
  AuditNow();
  if (options_.on_step_end) options_.on_step_end(walk_.steps.back());
  return node.children.front();
}

Progress TreeWalk::Do(const GroundAction& action) {
  const Roles roles = RolesOf(situation_.problem(), action.arguments);
  const std::string text = TextOf(action);
  const Skill& skill = *interpretation_.skills.at(action.name);
  Progress failure = situation_.robots.TakeOver(roles.robot);
  Execution& execution = situation_.execution();
  if (!roles.part.IsNone()) {  // a step of an assembly plan declares itself what it handles
    std::vector<PartId> handled = situation_.robots.Held();
    handled.push_back(roles.part);
    execution.Handle(std::move(handled), skill.HeldMayTouch());
  }
  execution.SetHandError(DrawnHandError(situation_.problem().gripper_error, *options_.random));
  if (!failure) failure = skill.Do(roles, situation_);
  if (failure) {
    failure->reason = text + ": " + failure->reason;
  } else {
    FlipReadings(action);
  }
  walk_.steps.push_back({text, execution.data().time(), at_});
  return failure;
}

std::optional<bool> TreeWalk::Observed(AtomId atom) const {
  const Predicate* const predicate = interpretation_.PredicateOf(atom);
  if (predicate == nullptr) return std::nullopt;
  const auto& arguments = interpretation_.task.ground_atoms[atom.index()].arguments;
  return predicate->Observed(situation_.readings, RolesOf(situation_.problem(), arguments));
}

std::optional<bool> TreeWalk::Observed(const contingent::Bound& bound) const {
  const Quantity* const quantity = interpretation_.QuantityOf(bound.function);
  if (quantity == nullptr) return std::nullopt;
  const auto& arguments = interpretation_.task.functions[bound.function.index()].arguments;
  const auto reading =
      quantity->Observed(situation_.readings, RolesOf(situation_.problem(), arguments));
  return reading ? execution::Observed(bound, *reading) : std::nullopt;
}

std::optional<bool> TreeWalk::Observed(FormulaId id) const {
  const contingent::Formula& formula = interpretation_.task.formulas[id.index()];
  if (formula.bound) return Observed(*formula.bound);
  bool are_all_observed = true;
  for (const contingent::GroundLiteral& literal : formula.literals) {
    if (knowledge_.layout().IsKnown(state_, literal)) continue;
    const std::optional<bool> observed = Observed(literal.atom);
    if (observed && *observed != literal.is_positive) return false;
    are_all_observed &= observed.has_value();
  }
  return are_all_observed ? std::optional(true) : std::nullopt;
}

bool TreeWalk::IsFlipped() {
  const bool is_flipped = options_.random->Uniform() < options_.sensing_errors;
  walk_.is_flipped |= is_flipped;
  return is_flipped;
}

void TreeWalk::FlipReadings(const GroundAction& action) {
  for (const contingent::GroundEffect& effect : action.effects) {
    for (const contingent::GroundChange& change : effect.changes) {
      if (change.kind != contingent::GroundChange::Kind::kSenseValue) continue;
      const Quantity* const quantity = interpretation_.QuantityOf(change.function);
      if (quantity == nullptr) continue;
      const auto& arguments = interpretation_.task.functions[change.function.index()].arguments;
      const Roles roles = RolesOf(situation_.problem(), arguments);
      const auto reading = quantity->Observed(situation_.readings, roles);
      if (!reading || !IsFlipped()) continue;
      quantity->Shift(situation_.readings, roles, 2 * (reading->error + change.error));
    }
  }
}

std::optional<NodeId> TreeWalk::Whether(NodeId id) {
  const PlanNode& node = tree_.node(id);
  const auto observed = Sensed([&] { return Observed(node.formula); });
  if (!observed) return NotObserved(WordsOf(node.formula));
  const bool is_flipped = IsFlipped();
  const bool value = *observed != is_flipped;
  if (!Learn(knowledge_.Learned(state_, node.formula, value)))
    return NotObserved(WordsOf(node.formula));
  return Take(id, value ? 0 : 1, is_flipped);
}

std::string TreeWalk::WordsOf(FormulaId formula) const {
  const contingent::GroundTask& task = interpretation_.task;
  return fmt::format("whether {}", TextOf(task, task.formulas[formula.index()]));
}

const std::string& TreeWalk::WordsOf(FunctionId function) const {
  return interpretation_.task.functions[function.index()].text;
}

std::optional<NodeId> TreeWalk::NotObserved(const std::string& what) {
  return End(TrialOutcome::kUncertain, fmt::format("the sensors do not tell {}", what));
}

std::optional<std::size_t> TreeWalk::ObservedValue(const std::vector<AtomId>& values) const {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (Observed(values[i]) == std::optional(true)) return i;
  }
  return std::nullopt;
}

std::optional<NodeId> TreeWalk::ByValue(NodeId id) {
  const PlanNode& node = tree_.node(id);
  const auto observed = Sensed([&] { return ObservedValue(node.values); });
  if (!observed) return NotObserved(WordsOf(node.function));
  const bool is_flipped = node.values.size() > 1 && IsFlipped();
  const std::size_t child = is_flipped ? Flipped(*observed, node.values.size()) : *observed;
  if (!Learn(knowledge_.Learned(state_, {node.values[child], true}))) {
    return NotObserved(WordsOf(node.function));
  }
  return Take(id, child, is_flipped);
}

std::optional<NodeId> TreeWalk::Take(NodeId id, std::size_t child, bool is_flipped) {
  const PlanNode& node = tree_.node(id);
  walk_.branches.push_back({id, child, OutcomeText(interpretation_.task, node, child), is_flipped});
  AuditNow();
  return node.children[child];
}

std::optional<NodeId> TreeWalk::End(TrialOutcome end, const std::string& reason) {
  walk_.end = end;
  walk_.reason = reason;
  return std::nullopt;
}

void TreeWalk::AuditNow() {
  Execution& execution = situation_.execution();
  const Truth truth{situation_.problem(), execution.scene(), execution.data()};
  const int step = static_cast<int>(walk_.steps.size());
  for (FalseClaim& claim :
       audit_.FalseClaims(knowledge_, state_, truth, situation_.readings, step)) {
    const auto is_same = [&](const FalseClaim& other) {
      return other.atom == claim.atom && other.claimed == claim.claimed;
    };
    if (std::ranges::none_of(walk_.false_claims, is_same)) {
      walk_.false_claims.push_back(std::move(claim));
    }
  }
}

}  // namespace assay::execution
