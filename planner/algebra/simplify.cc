#include "planner/algebra/simplify.h"

#include "planner/algebra/normal_form.h"

namespace assay::algebra {

Expression Simplify(const Expression& e, int most_terms) {
  const Expression simple = ToExpression(NormalFormOf(e, most_terms, AtomArguments::kRounded));
  if (e.pool() == nullptr || simple.pool() != nullptr) return simple;
  return e.pool()->Constant(simple.constant());
}

}  // namespace assay::algebra
