#include "planner/contingent/knowledge/number_knowledge.h"

#include <algorithm>

#include "planner/contingent/language/decimal.h"
#include "planner/numeric/interval_arithmetic.h"

namespace assay::contingent {
namespace {

bool IsSingle(const Range& range) { return range.low == range.high; }

Range Hull(const Range& a, const Range& b) {
  Range hull = a.low <= b.low ? a : b;
  if (a.low == b.low) hull.excludes_low = a.excludes_low && b.excludes_low;
  const Range& higher = a.high >= b.high ? a : b;
  hull.high = higher.high;
  hull.excludes_high = higher.excludes_high;
  if (a.high == b.high) hull.excludes_high = a.excludes_high && b.excludes_high;
  return hull;
}

}  // namespace

bool NumberKnowledge::MayHold(const Bound& bound, const KnowledgeState& state) const {
  return Holds(bound, state) ||
         (RangeOf(bound.function, state).is_outer && !Holds(Negation(bound), state));
}

bool NumberKnowledge::CanBe(FunctionId function, const KnowledgeState& state) const {
  const Range& range = RangeOf(function, state);
  return range.low < range.high ||
         (range.low == range.high && !range.excludes_low && !range.excludes_high);
}

void NumberKnowledge::Assign(const GroundChange& change, const KnowledgeState& before,
                             KnowledgeState& state) const {
  layout_.SetSensed(state, change.function, false);
  Range& range = MutableRangeOf(change.function, state);
  range = SumOf(change.sum, before);
  // If more becomes known about the sum or about one of its numbers, this also tells something
  // about the other numbers. The ranges do not express this dependence.
  for (const auto& [function, sign] : change.sum.functions) {
    const bool is_alone = function == change.function && change.sum.functions.size() == 1;
    if (is_alone || IsSingle(RangeOf(function, before))) continue;
    Entangle(state, function);
    range.is_outer = true;
  }
}

Range NumberKnowledge::SumOf(const GroundSum& sum, const KnowledgeState& state) const {
  Interval total = sum.constant;
  Range result;
  for (const auto& [function, sign] : sum.functions) {
    const Range& range = RangeOf(function, state);
    const Interval interval{range.low, range.high};
    total = EnclosingSum(total, sign > 0 ? interval : -(interval));
    result.excludes_low |= sign > 0 ? range.excludes_low : range.excludes_high;
    result.excludes_high |= sign > 0 ? range.excludes_high : range.excludes_low;
    result.is_outer |= range.is_outer;
  }
  result.low = total.low;
  result.high = total.high;
  return result;
}

void NumberKnowledge::Forget(KnowledgeState& state, FunctionId function) const {
  layout_.SetSensed(state, function, false);
  MutableRangeOf(function, state) = {.low = -kInfinity, .high = kInfinity};
}

void NumberKnowledge::Unsettle(KnowledgeState& state, FunctionId function,
                               const Range& otherwise) const {
  Range& range = MutableRangeOf(function, state);
  range = Hull(range, otherwise);
  range.is_outer = true;
}

void NumberKnowledge::Sense(KnowledgeState& state, FunctionId function, double error) const {
  if (IsNumber(function)) {
    double& known = MutableRangeOf(function, state).error;
    known = layout_.IsSensed(state, function) ? std::min(known, error) : error;
  }
  layout_.SetSensed(state, function, true);
}

void NumberKnowledge::Learn(KnowledgeState& state, const Bound& bound) const {
  Range& range = MutableRangeOf(bound.function, state);
  range = Narrowed(range, bound);
}

}  // namespace assay::contingent
