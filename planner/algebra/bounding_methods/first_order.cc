#include "planner/algebra/bounding_methods/first_order.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "planner/algebra/expression/evaluation.h"
#include "planner/algebra/operators/operator_rule.h"
#include "planner/numeric/interval_arithmetic.h"

namespace assay::algebra {
namespace {

Interval ValueAt(const Expression& e, std::span<const double> point) {
  std::vector<Interval> thin;
  thin.reserve(point.size());
  for (const double x : point) thin.push_back({x, x});
  return Evaluate(e, thin);
}

}  // namespace

Glance FirstOrderForms::Above(const Expression& e, std::span<const Interval> box, double limit) {
  if (e.IsConstant()) return {e.constant(), e.constant()};
  const FirstOrderForm& form = FormOf(e, box);
  if (!std::isfinite(form.rest)) return {kInfinity, -kInfinity};
  const double greatest = form.centre + form.reach;
  const double off = AtLeast(form.rest + 4 * kFewRoundings * (std::abs(form.centre) + form.reach));
  Glance glance = {greatest + off, greatest - off};
  if (glance.bound >= limit && glance.attained < limit) {
    glance.attained = std::max(glance.attained, ValueAt(e, Corner(e, 1, box)).low);
  }
  return glance;
}

Glance FirstOrderForms::Below(const Expression& e, std::span<const Interval> box, double limit) {
  if (e.IsConstant()) return {e.constant(), e.constant()};
  const FirstOrderForm& form = FormOf(e, box);
  if (!std::isfinite(form.rest)) return {-kInfinity, kInfinity};
  const double least = form.centre - form.reach;
  const double off = AtLeast(form.rest + 4 * kFewRoundings * (std::abs(form.centre) + form.reach));
  Glance glance = {least - off, least + off};
  if (glance.bound <= limit && glance.attained > limit) {
    glance.attained = std::min(glance.attained, ValueAt(e, Corner(e, -1, box)).high);
  }
  return glance;
}

Bound FirstOrderForms::BoundAbove(const Expression& e, std::span<const Interval> box) {
  Bound bound = {.value = Above(e, box, -kInfinity).bound,
                 .method = BoundingMethod::kCentred,
                 .gap = kInfinity};
  if (!std::isfinite(bound.value)) return bound;
  bound.at = Corner(e, 1, box);
  bound.gap = std::max(0.0, RoundedUp(bound.value - ValueAt(e, bound.at).low));
  return bound;
}

Bound FirstOrderForms::BoundBelow(const Expression& e, std::span<const Interval> box) {
  Bound bound = {.value = Below(e, box, kInfinity).bound,
                 .method = BoundingMethod::kCentred,
                 .gap = kInfinity};
  if (!std::isfinite(bound.value)) return bound;
  bound.at = Corner(e, -1, box);
  bound.gap = std::max(0.0, RoundedUp(ValueAt(e, bound.at).high - bound.value));
  return bound;
}

std::optional<AffineForm> FirstOrderForms::Affine(const Expression& e,
                                                  std::span<const Interval> box,
                                                  double negligible) {
  if (e.IsConstant()) return AffineForm{0, {e.constant(), e.constant()}};
  const FirstOrderForm form = FormOf(e, box);
  if (!std::isfinite(form.rest)) return std::nullopt;
  AffineForm affine = {.linear = 0, .rest = {}};
  double middle = form.centre;  // the middle of the rest
  double half = form.rest;
  double sizes = std::abs(form.centre) + form.reach;
  for (const auto& [variable, slope] : form.slopes) {
    if (std::abs(slope) <= negligible * form.reach) {
      half += std::abs(slope);
      continue;
    }
    const FirstOrderForm x =
        FirstOrderForm::OfVariable(variable, box[static_cast<std::size_t>(variable)]);
    const double multiple = slope / x.reach;
    affine.linear = affine.linear + multiple * e.pool()->Variable(VariableId(variable));
    middle -= multiple * x.centre;
    half += std::abs(multiple) * x.rest;
    sizes += std::abs(multiple * x.centre);
  }
  half = AtLeast(half + 8 * kFewRoundings * sizes);
  affine.rest = {middle - half, middle + half};
  return affine;
}

// Returns the corner of the box at which the linear part of e is greatest (sign = 1) or least (sign
// = -1). Variables without a slope are at their midpoints.
std::vector<double> FirstOrderForms::Corner(const Expression& e, double sign,
                                            std::span<const Interval> box) const {
  std::vector<double> corner;
  corner.reserve(box.size());
  for (const Interval& range : box) corner.push_back(Midpoint(range));
  if (e.IsConstant()) return corner;
  for (const FirstOrderForm::Slope& slope : Of(e).slopes) {
    const Interval& range = box[static_cast<std::size_t>(slope.variable)];
    corner[static_cast<std::size_t>(slope.variable)] =
        sign * slope.value > 0 ? range.high : range.low;
  }
  return corner;
}

const FirstOrderForm& FirstOrderForms::FormOf(const Expression& e, std::span<const Interval> box) {
  if (e.index() >= static_cast<int>(known_.size())) known_.resize(e.pool()->node_count());
  open_.assign(1, e);
  while (!open_.empty()) {
    const Expression next = open_.back();
    const std::size_t before = open_.size();
    for (const Expression& operand : next.operands()) {
      if (!known_[operand.index()].is_known) open_.push_back(operand);
    }
    if (open_.size() > before) continue;
    open_.pop_back();
    if (!known_[next.index()].is_known) known_[next.index()] = {true, Made(next, box)};
  }
  return known_[e.index()].form;
}

FirstOrderForm FirstOrderForms::Made(const Expression& e, std::span<const Interval> box) {
  if (e.IsConstant()) return {.centre = e.constant()};
  if (e.op() == Operator::kVariable) {
    return FirstOrderForm::OfVariable(e.variable().index(), box[e.variable().index()]);
  }
  const auto rule = e.op().rule().first_order;
  if (rule == nullptr) return FirstOrderForm::Unknown();
  operands_.clear();
  for (const Expression& operand : e.operands()) operands_.push_back(&Of(operand));
  return rule(arithmetic_, operands_, e.exponent());
}

}  // namespace assay::algebra
