#include <array>
#include <functional>
#include <numeric>

#include "planner/algebra/bounding_methods/first_order_form.h"
#include "planner/algebra/compiled_forms/step_writer.h"
#include "planner/algebra/expression/text_writer.h"
#include "planner/algebra/normal_forms/expansion.h"
#include "planner/algebra/operators/folding.h"
#include "planner/algebra/operators/operator_rule.h"
#include "planner/algebra/sup_inf/linear_reader.h"
#include "planner/numeric/interval_arithmetic.h"

namespace assay::algebra {

namespace {

constexpr Folding kProductFolding = {
    .op = Operator::kProduct, .neutral = 1, .is_absorbed_by_zero = true};

void WriteProduct(TextWriter& writer, const Expression& e, TextPlace place) {
  std::span<const Expression> factors = e.operands();
  if (place == TextPlace::kNegatedTerm && factors[0].IsConstant(-1)) {
    factors = factors.subspan(1);
    writer.Put(factors[0], TextPlace::kFirstFactor);
  } else {
    writer.Put(factors[0], place == TextPlace::kNegatedTerm ? place : TextPlace::kFirstFactor);
  }
  for (const Expression& factor : factors.subspan(1)) {
    writer.Put("*");
    writer.Put(factor, TextPlace::kFactor);
  }
}

double ProductOf(std::span<const double> x, int) {
  return std::accumulate(x.begin(), x.end(), 1.0, std::multiplies<>());
}

Interval ProductOf(std::span<const Interval> x, int) {
  Interval product = x[0];
  for (const Interval& factor : x.subspan(1)) product = product * factor;
  return product;
}

std::optional<LinearForm> ReadProduct(LinearReader& reader, const Expression& e) {
  LinearForm product{.constant = 1};
  for (const Expression& operand : e.operands()) {
    const std::optional<LinearForm>& form = reader.Read(operand);
    if (!form || (!form->IsConstant() && !product.IsConstant())) return std::nullopt;
    product = form->IsConstant() ? form->constant * product : product.constant * *form;
  }
  return product;
}

FirstOrderForm ProductOf(FirstOrderArithmetic&, std::span<const FirstOrderForm* const> factors,
                         int) {
  FirstOrderForm product = *factors[0];
  for (const FirstOrderForm* factor : factors.subspan(1)) {
    product = FirstOrderArithmetic::Product(product, *factor);
  }
  return product;
}

}  // namespace

const OperatorRule kProductRule = {
    .make = [](std::span<const Expression> factors, int) { return Product(factors); },
    .write = &WriteProduct,
    .parenthesized_from = TextPlace::kFirstFactor,
    .value = &ProductOf,
    .range = &ProductOf,
    .compile = [](StepWriter& writer, const Expression& e,
                  std::span<const int> factors) { return writer.AddChain(e.op(), factors); },
    .expand = [](Expansion& expansion,
                 const Expression& e) { return expansion.ProductOf(e.operands()); },
    .read_linear = &ReadProduct,
    .first_order = &ProductOf,
};

Expression Product(std::span<const Expression> factors) {
  return Combined(kProductFolding, factors);
}
Expression operator*(const Expression& a, const Expression& b) { return Product(std::array{a, b}); }
Expression operator-(const Expression& a) { return -1 * a; }

}  // namespace assay::algebra
