#include "planner/algebra/methods/first_order.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "planner/algebra/numeric/interval_arithmetic.h"

namespace assay::algebra {
namespace {

// A bound of the rounding error of a few operations on doubles, relative to their operands.
constexpr double kRounding = 1e-15;

// Returns an upper bound of the exact sum of non-negative numbers. `sum` is their rounded sum.
double AtLeast(double sum) { return sum * (1 + 1e-12); }

Interval ValueAt(const Expression& e, std::span<const double> point) {
  std::vector<Interval> thin;
  thin.reserve(point.size());
  for (const double x : point) thin.push_back({x, x});
  return Evaluate(e, thin);
}

}  // namespace

Glance FirstOrderForms::Above(const Expression& e, std::span<const Interval> box, double limit) {
  if (e.IsConstant()) return {e.constant(), e.constant()};
  const Form& form = FormOf(e, box);
  if (!std::isfinite(form.rest)) return {kInfinity, -kInfinity};
  const double greatest = form.centre + form.reach;
  const double off = AtLeast(form.rest + 4 * kRounding * (std::abs(form.centre) + form.reach));
  Glance glance = {greatest + off, greatest - off};
  if (glance.bound >= limit && glance.attained < limit) {
    glance.attained = std::max(glance.attained, ValueAt(e, Corner(e, 1, box)).low);
  }
  return glance;
}

Glance FirstOrderForms::Below(const Expression& e, std::span<const Interval> box, double limit) {
  if (e.IsConstant()) return {e.constant(), e.constant()};
  const Form& form = FormOf(e, box);
  if (!std::isfinite(form.rest)) return {-kInfinity, kInfinity};
  const double least = form.centre - form.reach;
  const double off = AtLeast(form.rest + 4 * kRounding * (std::abs(form.centre) + form.reach));
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
  const Form form = FormOf(e, box);
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
    const Form x = OfVariable(variable, box[static_cast<std::size_t>(variable)]);
    const double multiple = slope / x.reach;
    affine.linear = affine.linear + multiple * e.pool()->Variable(VariableId(variable));
    middle -= multiple * x.centre;
    half += std::abs(multiple) * x.rest;
    sizes += std::abs(multiple * x.centre);
  }
  half = AtLeast(half + 8 * kRounding * sizes);
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
  for (const Slope& slope : Of(e).slopes) {
    const Interval& range = box[static_cast<std::size_t>(slope.variable)];
    corner[static_cast<std::size_t>(slope.variable)] =
        sign * slope.value > 0 ? range.high : range.low;
  }
  return corner;
}

const FirstOrderForms::Form& FirstOrderForms::FormOf(const Expression& e,
                                                     std::span<const Interval> box) {
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

FirstOrderForms::Form FirstOrderForms::Made(const Expression& e, std::span<const Interval> box) {
  switch (e.op()) {
    case Operator::kConstant:
      return OfNumber(e.constant());
    case Operator::kVariable:
      return OfVariable(e.variable().index(), box[e.variable().index()]);
    case Operator::kSum:
      return OfSum(e.operands());
    case Operator::kProduct:
      return OfProduct(e.operands());
    case Operator::kPower: {
      const std::vector<Expression> factors(std::max(e.exponent(), 0), e.operands()[0]);
      return OfProduct(factors);
    }
    case Operator::kSin: {
      const Form& a = Of(e.operands()[0]);
      return Wave(a, std::sin(a.centre), std::cos(a.centre));
    }
    case Operator::kCos: {
      const Form& a = Of(e.operands()[0]);
      return Wave(a, std::cos(a.centre), -std::sin(a.centre));
    }
    case Operator::kQuotient:
    case Operator::kSqrt:
    case Operator::kAbs:
    case Operator::kMin:
    case Operator::kMax:
      break;
  }
  return {.rest = kInfinity};
}

FirstOrderForms::Form FirstOrderForms::OfNumber(double value) { return {.centre = value}; }

// The rest allows for an end of the interval that lies a rounding error beyond t = 1 or -1.
FirstOrderForms::Form FirstOrderForms::OfVariable(int variable, const Interval& range) {
  const double centre = Midpoint(range);
  const double radius = std::max(range.high - centre, centre - range.low);
  if (!std::isfinite(centre) || !std::isfinite(radius)) return {.rest = kInfinity};
  return {.centre = centre,
          .rest = kRounding * (std::abs(centre) + radius),
          .reach = radius,
          .slopes = {{variable, radius}}};
}

void FirstOrderForms::Slopes::Add(int variable, double slope) {
  if (variable >= std::ssize(total_)) total_.resize(variable + 1, kNone);
  double& total = total_[variable];
  if (std::isnan(total)) {
    variables_.push_back(variable);
    total = slope;
  } else {
    total += slope;
  }
}

std::vector<FirstOrderForms::Slope> FirstOrderForms::Slopes::Take() {
  std::ranges::sort(variables_);
  std::vector<Slope> slopes;
  slopes.reserve(variables_.size());
  for (const int variable : variables_) {
    slopes.push_back({variable, std::exchange(total_[variable], kNone)});
  }
  variables_.clear();
  return slopes;
}

FirstOrderForms::Form FirstOrderForms::OfSum(std::span<const Expression> terms) {
  Form sum;
  double sizes = 0;
  for (const Expression& term : terms) {
    const Form& form = Of(term);
    sum.centre += form.centre;
    sum.rest += form.rest;
    sizes += std::abs(form.centre) + form.reach;
    for (const auto& [variable, slope] : form.slopes) total_.Add(variable, slope);
  }
  sum.slopes = total_.Take();
  for (const Slope& slope : sum.slopes) sum.reach += std::abs(slope.value);
  sum.rest = AtLeast(sum.rest + kRounding * static_cast<double>(terms.size()) * sizes);
  return sum;
}

FirstOrderForms::Form FirstOrderForms::OfProduct(std::span<const Expression> factors) const {
  if (factors.empty()) return {.rest = kInfinity};  // the power is negative
  Form product = Of(factors[0]);
  for (const Expression& factor : factors.subspan(1)) product = Product(product, Of(factor));
  return product;
}

// Computes (a + A + r) * (b + B + s), where A and B are the linear parts, and r and s the rests.
// The result is a*b + a*B + b*A plus a rest: A*B, and the products with r or s. In A*B, the product
// of both slopes of one variable is a multiple of t^2, whose sign is known.
FirstOrderForms::Form FirstOrderForms::Product(const Form& a, const Form& b) {
  Form product = {.centre = a.centre * b.centre};
  product.slopes.reserve(a.slopes.size() + b.slopes.size());
  double squares = 0;  // the sum of half the coefficients of t^2
  double squares_size = 0;
  auto x = a.slopes.begin();
  auto y = b.slopes.begin();
  const auto add = [&](int variable, double of_a, double of_b) {
    const double slope = b.centre * of_a + a.centre * of_b;
    if (slope != 0) product.slopes.push_back({variable, slope});
  };
  while (x != a.slopes.end() || y != b.slopes.end()) {
    if (y == b.slopes.end() || (x != a.slopes.end() && x->variable < y->variable)) {
      add(x->variable, x->value, 0);
      ++x;
    } else if (x == a.slopes.end() || y->variable < x->variable) {
      add(y->variable, 0, y->value);
      ++y;
    } else {
      add(x->variable, x->value, y->value);
      squares += x->value * y->value / 2;
      squares_size += std::abs(x->value * y->value) / 2;
      ++x;
      ++y;
    }
  }
  product.centre += squares;
  for (const Slope& slope : product.slopes) product.reach += std::abs(slope.value);
  const double size_a = std::abs(a.centre) + a.reach;
  const double size_b = std::abs(b.centre) + b.reach;
  const double second = a.reach * b.reach - squares_size;
  product.rest = AtLeast(second + a.rest * (size_b + b.rest) + b.rest * size_a +
                         8 * kRounding * size_a * size_b);
  return product;
}

// Computes sine or cosine by Taylor's theorem: f(c + d) = f(c) + f'(c) * d - f(x) * d^2 / 2 for an
// x between c and c + d.
FirstOrderForms::Form FirstOrderForms::Wave(const Form& a, double value, double slope) {
  const double farthest = AtLeast(a.reach + a.rest);
  if (!(farthest < 1)) return {.rest = kInfinity};
  const double half_square = farthest * farthest / 2;
  const double low = std::min(0.0, -half_square * std::min(value + farthest, 1.0));
  const double high = std::max(0.0, half_square * std::min(farthest - value, 1.0));
  Form wave = {.centre = value + (low + high) / 2, .slopes = a.slopes};
  for (Slope& s : wave.slopes) {
    s.value *= slope;
    wave.reach += std::abs(s.value);
  }
  wave.rest = AtLeast((high - low) / 2 + std::abs(slope) * a.rest + 8 * kRounding);
  return wave;
}

}  // namespace assay::algebra
