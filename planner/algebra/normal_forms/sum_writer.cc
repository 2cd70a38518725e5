#include "planner/algebra/normal_forms/sum_writer.h"

#include "planner/numeric/interval_arithmetic.h"

namespace assay::algebra {

void SumWriter::BeginTerm(const Interval& coefficient) {
  EndTerm();
  factors_.assign(1, IsSingle(coefficient) ? coefficient.low : Midpoint(coefficient));
  is_rounding_alone_ = IsRoundingAlone(coefficient);
}

// A power of a reciprocal is written as one negative power.
void SumWriter::Multiply(const NormalForm::Factor& factor) {
  const Expression& atom = factor.atom;
  const bool is_reciprocal = atom.op() == Operator::kPower && atom.exponent() == -1;
  factors_.push_back(is_reciprocal ? Power(atom.operands()[0], -factor.exponent)
                                   : Power(atom, factor.exponent));
}

void SumWriter::EndTerm() {
  if (!factors_.empty() && !is_rounding_alone_) terms_.push_back(Product(factors_));
}

Expression SumWriter::Finish() {
  EndTerm();
  return Sum(terms_);
}

Expression ToExpression(const NormalForm& form) {
  SumWriter writer;
  for (const NormalForm::Term& term : form.terms) {
    writer.BeginTerm(term.coefficient);
    for (const NormalForm::Factor& factor : term.factors) writer.Multiply(factor);
  }
  return writer.Finish();
}

}  // namespace assay::algebra
