#include "planner/algebra/bounding_methods/termwise.h"

#include "planner/algebra/expression/evaluation.h"
#include "planner/algebra/operators/operator_rule.h"
#include "planner/base/index_map.h"
#include "planner/numeric/interval_arithmetic.h"

namespace assay::algebra {
namespace {

// The common atoms, a variable and a function of one variable, are evaluated directly for speed.
Interval RangeOfAtom(const Expression& atom, std::span<const Interval> box) {
  if (atom.op() == Operator::kVariable) return box[atom.variable().index()];
  if (atom.operands().size() != 1 || atom.operands()[0].op() != Operator::kVariable) {
    return Evaluate(atom, box);
  }
  const Interval& x = box[atom.operands()[0].variable().index()];
  return atom.op().rule().range({&x, 1}, atom.exponent());
}

}  // namespace

Interval TermwiseRange(const NormalForm& form, std::span<const Interval> box) {
  IndexMap<Interval> known;  // ranges of the atoms
  Interval sum = {0, 0};
  for (const NormalForm::Term& term : form.terms) {
    Interval product = term.coefficient;
    for (const NormalForm::Factor& factor : term.factors) {
      const auto [range, is_new] = known.Insert(factor.atom.index());
      if (is_new) range = RangeOfAtom(factor.atom, box);
      product = product * Power(range, factor.exponent);
    }
    sum = sum + product;
  }
  return sum;
}

}  // namespace assay::algebra
