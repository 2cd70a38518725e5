#include <array>
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

constexpr Folding kSumFolding = {.op = Operator::kSum, .neutral = 0};

void WriteSum(TextWriter& writer, const Expression& e, TextPlace) {
  const std::span<const Expression> terms = e.operands();
  writer.Put(terms[0], TextPlace::kTerm);
  for (const Expression& term : terms.subspan(1)) {
    const bool is_negated = !writer.IsShared(term) && TextWriter::IsNegated(term);
    writer.Put(is_negated ? " - " : " + ");
    writer.Put(term, is_negated ? TextPlace::kNegatedTerm : TextPlace::kTerm);
  }
}

double SumOf(std::span<const double> x, int) { return std::accumulate(x.begin(), x.end(), 0.0); }

Interval SumOf(std::span<const Interval> x, int) {
  Interval sum = x[0];
  for (const Interval& term : x.subspan(1)) sum = sum + term;
  return sum;
}

std::optional<LinearForm> ReadSum(LinearReader& reader, const Expression& e) {
  LinearForm sum;
  for (const Expression& operand : e.operands()) {
    const std::optional<LinearForm>& form = reader.Read(operand);
    if (!form) return std::nullopt;
    for (const auto& [column, coefficient] : form->coefficients) sum.Add(column, coefficient);
    sum.constant = sum.constant + form->constant;
  }
  return sum;
}

}  // namespace

const OperatorRule kSumRule = {
    .make = [](std::span<const Expression> terms, int) { return Sum(terms); },
    .write = &WriteSum,
    .parenthesized_from = TextPlace::kTerm,
    .value = &SumOf,
    .range = &SumOf,
    .compile = [](StepWriter& writer, const Expression& e,
                  std::span<const int> terms) { return writer.AddChain(e.op(), terms); },
    .expand = [](Expansion& expansion,
                 const Expression& e) { return expansion.SumOf(e.operands()); },
    .read_linear = &ReadSum,
    .first_order = [](FirstOrderArithmetic& arithmetic,
                      std::span<const FirstOrderForm* const> terms,
                      int) { return arithmetic.Sum(terms); },
};

Expression Sum(std::span<const Expression> terms) { return Combined(kSumFolding, terms); }
Expression operator+(const Expression& a, const Expression& b) { return Sum(std::array{a, b}); }
Expression operator-(const Expression& a, const Expression& b) { return Sum(std::array{a, -b}); }

}  // namespace assay::algebra
