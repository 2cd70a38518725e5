#include "planner/contingent/knowledge/number_marks.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/contingent/language/decimal.h"
#include "planner/numeric/interval_arithmetic.h"

namespace assay::contingent {
namespace {

// The greatest number of marks of one function. Each mark gives three numbers, and the assignment
// of an interval multiplies them.
constexpr std::size_t kMostMarks = 500;
constexpr double kBeyondMarks = 1e9;
// Returns the greatest difference between two inexact sums of about this size.
double RoundingOf(double sum) {
  return 16 * std::numeric_limits<double>::epsilon() * std::max(1.0, std::abs(sum));
}

bool IsNear(double a, double b) { return std::abs(a - b) <= RoundingOf(std::max(a, b)) / 2; }

}  // namespace

NumberMarks::NumberMarks(const GroundTask& task, const PlanTree& tree)
    : marks_(task.function_of_slot.size()), is_asked_(marks_.size(), false) {
  for (const Range& range : task.initial.ranges) reach_.push_back({range.low, range.high});
  for (const Formula& formula : task.formulas) {
    if (formula.bound) Use(task, *formula.bound);
  }
  Use(task, task.updates);
  Use(task, task.goal);
  const bool is_changed_by_rules = !assignments_.empty();
  std::set<ActionId> actions;
  for (const PlanNode& node : tree.nodes) {
    if (node.kind == PlanNode::Kind::kAct) actions.insert(node.action);
  }
  for (const ActionId action : actions) {
    Use(task, task.actions[action.index()].precondition);
    Use(task, task.actions[action.index()].effects);
  }
  FindReach();
  const TreeSize size = SizeOf(tree);
  const bool is_bounded = !is_changed_by_rules && size.repeats == 0;
  const std::vector<std::set<double>> asked = marks_;
  if (!CarryBack(is_bounded ? size.depth : std::numeric_limits<int>::max())) {
    are_complete_ = false;
    marks_ = asked;
  }
  are_complete_ &= AllSumsAreOfOne();
}

// ---- Collecting bounds and assignments

void NumberMarks::Use(const GroundTask& task, const GroundQuery& query) {
  if (query.kind == GroundQuery::Kind::kBoundKnown) Use(task, query.bound);
  if (query.kind == GroundQuery::Kind::kValueSensed) {
    const int slot = task.functions[query.function.index()].slot;
    if (slot >= 0) is_asked_[slot] = true;
  }
  for (const GroundQuery& operand : query.operands) Use(task, operand);
}

void NumberMarks::Use(const GroundTask& task, const std::vector<GroundEffect>& effects) {
  for (const GroundEffect& effect : effects) {
    Use(task, effect.condition);
    for (const GroundChange& change : effect.changes) Use(task, change);
  }
}

void NumberMarks::Use(const GroundTask& task, const GroundChange& change) {
  if (change.kind == GroundChange::Kind::kNarrow) Use(task, change.bound);
  const bool is_forgotten = change.kind == GroundChange::Kind::kForgetNumber;
  if (!is_forgotten && change.kind != GroundChange::Kind::kAssign) return;
  Assignment assignment{.to = task.functions[change.function.index()].slot,
                        .added = is_forgotten ? kWholeLine : change.sum.constant,
                        .from = {}};
  for (const auto& [function, sign] : change.sum.functions) {
    assignment.from.emplace_back(task.functions[function.index()].slot, sign);
  }
  assignments_.push_back(std::move(assignment));
}

void NumberMarks::Use(const GroundTask& task, const Bound& bound) {
  const int slot = task.functions[bound.function.index()].slot;
  marks_[slot].insert(bound.value);
  is_asked_[slot] = true;
}

// ---- The reach of numbers

Interval NumberMarks::ReachOf(const Assignment& assignment) const {
  Interval sum = assignment.added;
  for (const auto& [slot, sign] : assignment.from) {
    sum = EnclosingSum(sum, sign > 0 ? reach_[slot] : -(reach_[slot]));
  }
  return sum;
}

// A number that still grows, after enough rounds for every assignment to pass on its first value,
// grows without limit.
void NumberMarks::FindReach() {
  bool has_grown = true;
  for (std::size_t round = 0; has_grown; ++round) {
    has_grown = false;
    for (const Assignment& assignment : assignments_) {
      Interval& reach = reach_[assignment.to];
      const Interval sum = Hull(reach, ReachOf(assignment));
      if (sum == reach) continue;
      has_grown = true;
      const bool is_for_ever = round > reach_.size();
      if (sum.low < reach.low) reach.low = is_for_ever ? -kInfinity : sum.low;
      if (sum.high > reach.high) reach.high = is_for_ever ? kInfinity : sum.high;
    }
  }
}

// ---- Carrying marks back

// Returns true if every sum that matters for a query has only one function.
bool NumberMarks::AllSumsAreOfOne() const {
  std::vector<bool> matters = is_asked_;
  for (std::size_t round = 0; round < matters.size(); ++round) {
    for (const Assignment& assignment : assignments_) {
      if (!matters[assignment.to]) continue;
      for (const auto& [slot, sign] : assignment.from) matters[slot] = true;
    }
  }
  return std::ranges::none_of(assignments_, [&](const Assignment& assignment) {
    return matters[assignment.to] && assignment.from.size() > 1;
  });
}

bool NumberMarks::CarryBack(int most_rounds) {
  std::set<std::pair<int, double>> fresh;
  for (std::size_t slot = 0; slot < marks_.size(); ++slot) {
    for (const double mark : marks_[slot]) fresh.emplace(slot, mark);
  }
  for (int round = 0; round < most_rounds && !fresh.empty(); ++round) {
    std::set<std::pair<int, double>> next;
    for (const auto& [slot, mark] : fresh) {
      for (const Assignment& assignment : assignments_) {
        if (assignment.to == slot) CarryBack(assignment, mark, next);
      }
    }
    const auto is_full = [](const std::set<double>& marks) { return marks.size() > kMostMarks; };
    if (std::ranges::any_of(marks_, is_full)) return false;
    fresh = std::move(next);
  }
  return true;
}

void NumberMarks::CarryBack(const Assignment& assignment, double mark,
                            std::set<std::pair<int, double>>& fresh) {
  if (assignment.from.size() != 1) return;
  const auto [slot, sign] = assignment.from.front();
  for (const double added : {assignment.added.low, assignment.added.high}) {
    const double before = sign * NearestSum(mark, -added);
    if (before < reach_[slot].low || before > reach_[slot].high) continue;
    if (std::isinf(before) || IsNearMark(before, slot)) continue;
    are_complete_ &= IsNear(NearestSum(sign * before, added), mark);
    marks_[slot].insert(before);
    fresh.emplace(slot, before);
  }
}

bool NumberMarks::IsNearMark(double value, int slot) const {
  const std::set<double>& marks = marks_[slot];
  const auto above = marks.lower_bound(value);
  return (above != marks.end() && IsNear(*above, value)) ||
         (above != marks.begin() && IsNear(*std::prev(above), value));
}

// ---- Numbers that represent a range

std::vector<Number> NumberMarks::In(const Range& range, int slot) const {
  const auto finite = [&](double end) {
    if (std::isfinite(end)) return end;
    const std::set<double>& marks = marks_[slot];
    const double most =
        marks.empty() ? 0 : std::max(std::abs(*marks.begin()), std::abs(*marks.rbegin()));
    return std::copysign(std::max(kBeyondMarks, 2 * most), end);
  };
  return Between({finite(range.low), range.excludes_low ? 1 : 0},
                 {finite(range.high), range.excludes_high ? -1 : 0}, slot);
}

std::vector<Number> NumberMarks::Between(Number low, Number high, int slot) const {
  if (high < low) return {};
  std::set<Number> numbers = {low, high};
  const std::set<double>& marks = marks_[slot];
  const auto last = marks.upper_bound(high.value);
  for (auto mark = marks.lower_bound(low.value); mark != last; ++mark) {
    for (const int beside : {-1, 0, 1}) {
      const Number number{*mark, beside};
      if (low <= number && number <= high) numbers.insert(number);
    }
  }
  if (!are_complete_ && low.value < high.value) {  // the middle is an extra number for a sample
    numbers.insert({low.value / 2 + high.value / 2, 0});
  }
  return {numbers.begin(), numbers.end()};
}

std::vector<Number> NumberMarks::BetweenSums(Number low, Number high, int slot) const {
  const std::set<double>& marks = marks_[slot];
  const auto first = marks.lower_bound(low.value - RoundingOf(low.value));
  if (first != marks.end()) low.value = std::min(low.value, *first);
  const auto last = marks.upper_bound(high.value + RoundingOf(high.value));
  if (last != marks.begin()) high.value = std::max(high.value, *std::prev(last));
  return Between(low, high, slot);
}

}  // namespace assay::contingent
