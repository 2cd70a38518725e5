#include <array>

#include "planner/algebra/compiled_forms/step_writer.h"
#include "planner/algebra/expression/text_writer.h"
#include "planner/algebra/normal_forms/expansion.h"
#include "planner/algebra/operators/function.h"
#include "planner/algebra/operators/operator_rule.h"
#include "planner/algebra/operators/point_or_box.h"
#include "planner/algebra/sup_inf/linear_reader.h"
#include "planner/base/check.h"
#include "planner/numeric/interval_arithmetic.h"

namespace assay::algebra {

namespace {

std::optional<LinearForm> ReadQuotient(LinearReader& reader, const Expression& e) {
  const std::optional<LinearForm> divisor = reader.Read(e.operands()[1]);
  if (!divisor || !divisor->IsConstant() || divisor->constant.IsZero()) return std::nullopt;
  const std::optional<LinearForm>& dividend = reader.Read(e.operands()[0]);
  if (!dividend) return std::nullopt;
  return numeric::Rational(1) / divisor->constant * *dividend;
}

Definedness WhereQuotientIsDefined(std::span<const Interval> x, int) {
  if (!Contains(x[1], 0)) return Definedness::kEverywhere;
  return IsZero(x[1]) ? Definedness::kNowhere : Definedness::kSomewhere;
}

}  // namespace

const OperatorRule kQuotientRule = {
    .operand_count = 2,
    .make = [](std::span<const Expression> x, int) { return x[0] / x[1]; },
    .write =
        [](TextWriter& writer, const Expression& e, TextPlace) {
          writer.Put(e.operands()[0], TextPlace::kNumerator);
          writer.Put("/");
          writer.Put(e.operands()[1], TextPlace::kFactor);
        },
    .parenthesized_from = TextPlace::kFactor,
    .value = [](std::span<const double> x,
                int) { return x[1] == 0 ? Unknown<double>() : x[0] / x[1]; },
    .range = [](std::span<const Interval> x, int) { return x[0] / x[1]; },
    .definedness = &WhereQuotientIsDefined,
    .compile =
        [](StepWriter& writer, const Expression&, std::span<const int> operands) {
          const int reciprocal = writer.AddPower(operands[1], -1);
          return writer.AddChain(Operator::kProduct, std::array{operands[0], reciprocal});
        },
    .expand =
        [](Expansion& expansion, const Expression& e) {
          return expansion.QuotientOf(e.operands()[0], e.operands()[1]);
        },
    .read_linear = &ReadQuotient,
};

Expression operator/(const Expression& a, const Expression& b) {
  const std::array operands = {a, b};
  ExpressionPool* const pool = JoinedPool(operands);
  if (b.IsConstant(1)) return InPool(a, pool);
  ASSAY_CHECK(pool != nullptr || !b.IsConstant(0), "a plain number is divided by 0");
  return FunctionOf(Operator::kQuotient, operands);
}

}  // namespace assay::algebra
