#include "planner/algebra/termwise.h"

#include <map>
#include <utility>

#include "planner/algebra/interval_arithmetic.h"

namespace assay::algebra {

Interval TermwiseRange(const NormalForm& form, std::span<const Interval> box) {
  std::map<std::pair<int, int>, Interval> known;  // by the atom's index and the exponent
  Interval sum = {0, 0};
  for (const NormalForm::Term& term : form.terms) {
    Interval product = term.coefficient;
    for (const NormalForm::Factor& factor : term.factors) {
      const auto [at, is_new] = known.try_emplace({factor.atom.index(), factor.exponent});
      if (is_new) at->second = Power(Evaluate(factor.atom, box), factor.exponent);
      product = product * at->second;
    }
    sum = sum + product;
  }
  return sum;
}

}  // namespace assay::algebra
