#include "planner/algebra/bounding_methods/first_order_form.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "planner/numeric/interval_arithmetic.h"

namespace assay::algebra {

// By rounding, an end of the range may lie slightly beyond t = 1 or t = -1. The member `rest` of
// the result covers this difference.
FirstOrderForm FirstOrderForm::OfVariable(int variable, const Interval& range) {
  const double centre = Midpoint(range);
  const double radius = std::max(range.high - centre, centre - range.low);
  if (!std::isfinite(centre) || !std::isfinite(radius)) return FirstOrderForm::Unknown();
  return {.centre = centre,
          .rest = kFewRoundings * (std::abs(centre) + radius),
          .reach = radius,
          .slopes = {{variable, radius}}};
}

void FirstOrderArithmetic::Slopes::Add(const FirstOrderForm::Slope& slope) {
  const auto [variable, value] = slope;
  if (variable >= std::ssize(total_)) total_.resize(variable + 1, kNone);
  double& total = total_[variable];
  if (std::isnan(total)) {
    variables_.push_back(variable);
    total = value;
  } else {
    total += value;
  }
}

std::vector<FirstOrderForm::Slope> FirstOrderArithmetic::Slopes::Take() {
  std::ranges::sort(variables_);
  std::vector<FirstOrderForm::Slope> slopes;
  slopes.reserve(variables_.size());
  for (const int variable : variables_) {
    slopes.push_back({variable, std::exchange(total_[variable], kNone)});
  }
  variables_.clear();
  return slopes;
}

FirstOrderForm FirstOrderArithmetic::Sum(std::span<const FirstOrderForm* const> terms) {
  FirstOrderForm sum;
  double sizes = 0;
  for (const FirstOrderForm* form : terms) {
    sum.centre += form->centre;
    sum.rest += form->rest;
    sizes += std::abs(form->centre) + form->reach;
    for (const FirstOrderForm::Slope& slope : form->slopes) total_.Add(slope);
  }
  sum.slopes = total_.Take();
  for (const FirstOrderForm::Slope& slope : sum.slopes) sum.reach += std::abs(slope.value);
  sum.rest = AtLeast(sum.rest + kFewRoundings * static_cast<double>(terms.size()) * sizes);
  return sum;
}

// Computes (a + A + r) * (b + B + s), where A and B are the linear parts, and r and s the rests.
// The result is a*b + a*B + b*A plus a rest: A*B, and the products with r or s. In A*B, the product
// of both slopes of one variable is a multiple of t^2, whose sign is known.
FirstOrderForm FirstOrderArithmetic::Product(const FirstOrderForm& a, const FirstOrderForm& b) {
  FirstOrderForm product = {.centre = a.centre * b.centre};
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
  for (const FirstOrderForm::Slope& slope : product.slopes) product.reach += std::abs(slope.value);
  const double size_a = std::abs(a.centre) + a.reach;
  const double size_b = std::abs(b.centre) + b.reach;
  const double second = a.reach * b.reach - squares_size;
  product.rest = AtLeast(second + a.rest * (size_b + b.rest) + b.rest * size_a +
                         8 * kFewRoundings * size_a * size_b);
  return product;
}

// Computes sine or cosine by Taylor's theorem: f(c + d) = f(c) + f'(c) * d - f(x) * d^2 / 2 for an
// x between c and c + d.
FirstOrderForm FirstOrderArithmetic::Sinusoid(const FirstOrderForm& a, double value, double slope) {
  const double farthest = AtLeast(a.reach + a.rest);
  if (!(farthest < 1)) return FirstOrderForm::Unknown();
  const double half_square = farthest * farthest / 2;
  const double low = std::min(0.0, -half_square * std::min(value + farthest, 1.0));
  const double high = std::max(0.0, half_square * std::min(farthest - value, 1.0));
  FirstOrderForm sinusoid = {.centre = value + (low + high) / 2, .slopes = a.slopes};
  for (FirstOrderForm::Slope& s : sinusoid.slopes) {
    s.value *= slope;
    sinusoid.reach += std::abs(s.value);
  }
  sinusoid.rest = AtLeast((high - low) / 2 + std::abs(slope) * a.rest + 8 * kFewRoundings);
  return sinusoid;
}

}  // namespace assay::algebra
