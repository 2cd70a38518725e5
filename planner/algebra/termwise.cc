#include "planner/algebra/termwise.h"

#include "planner/algebra/index_map.h"
#include "planner/algebra/interval_arithmetic.h"

namespace assay::algebra {

Interval TermwiseRange(const NormalForm& form, std::span<const Interval> box) {
  IndexMap<Interval> known;  // of the atoms
  Interval sum = {0, 0};
  for (const NormalForm::Term& term : form.terms) {
    Interval product = term.coefficient;
    for (const NormalForm::Factor& factor : term.factors) {
      const auto [range, is_new] = known.Insert(factor.atom.index());
      if (is_new) range = Evaluate(factor.atom, box);
      product = product * Power(range, factor.exponent);
    }
    sum = sum + product;
  }
  return sum;
}

}  // namespace assay::algebra
