#include <fmt/format.h>

#include <array>

#include "planner/algebra/bounding_methods/first_order_form.h"
#include "planner/algebra/expression/text_writer.h"
#include "planner/algebra/normal_forms/expansion.h"
#include "planner/algebra/operators/function.h"
#include "planner/algebra/operators/operator_rule.h"
#include "planner/algebra/operators/point_or_box.h"
#include "planner/base/check.h"

namespace assay::algebra {

namespace {

Definedness WherePowerIsDefined(std::span<const Interval> x, int exponent) {
  if (exponent > 0 || !Contains(x[0], 0)) return Definedness::kEverywhere;
  return IsZero(x[0]) ? Definedness::kNowhere : Definedness::kSomewhere;
}

FirstOrderForm RepeatedProduct(FirstOrderArithmetic&, std::span<const FirstOrderForm* const> base,
                               int exponent) {
  if (exponent < 0) return FirstOrderForm::Unknown();
  FirstOrderForm power = *base[0];
  for (int i = 1; i < exponent; ++i) power = FirstOrderArithmetic::Product(power, *base[0]);
  return power;
}

}  // namespace

const OperatorRule kPowerRule = {
    .operand_count = 1,
    .make = [](std::span<const Expression> base, int exponent) { return Power(base[0], exponent); },
    .write =
        [](TextWriter& writer, const Expression& e, TextPlace) {
          writer.Put(e.operands()[0], TextPlace::kBase);
          writer.Put(fmt::format("^{}", e.exponent()));
        },
    .parenthesized_from = TextPlace::kBase,
    .value =
        [](std::span<const double> x, int exponent) {
          return x[0] == 0 && exponent < 0 ? Unknown<double>() : RaisedTo(x[0], exponent);
        },
    .range = [](std::span<const Interval> x, int exponent) { return RaisedTo(x[0], exponent); },
    .definedness = &WherePowerIsDefined,
    .slope = []<class Number>(const FunctionPlace<Number>& at, int) -> Number {
      return Exactly<Number>(at.exponent) * RaisedTo(at.a, at.exponent - 1);
    },
    .curvature = []<class Number>(const FunctionPlace<Number>& at, int, int) -> Number {
      return Exactly<Number>(static_cast<double>(at.exponent) * (at.exponent - 1.0)) *
             RaisedTo(at.a, at.exponent - 2);
    },
    .expand = [](Expansion& expansion,
                 const Expression& e) { return expansion.PowerOf(e.operands()[0], e.exponent()); },
    .first_order = &RepeatedProduct,
};

Expression Power(const Expression& a, int exponent) {
  if (exponent == 0) return Number(1, a.pool());
  if (exponent == 1) return a;
  ASSAY_CHECK(a.pool() != nullptr || exponent > 0 || !a.IsConstant(0),
              "a negative power of the plain number 0");
  return FunctionOf(Operator::kPower, std::array{a}, exponent);
}

}  // namespace assay::algebra
