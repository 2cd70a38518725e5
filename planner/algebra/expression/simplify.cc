#include "planner/algebra/expression/simplify.h"

#include "planner/algebra/normal_forms/normal_form.h"
#include "planner/algebra/normal_forms/normalization.h"

namespace assay::algebra {

Expression Simplify(const Expression& e, int most_terms) {
  return SimplifiedExpression(e, most_terms);
}

}  // namespace assay::algebra
