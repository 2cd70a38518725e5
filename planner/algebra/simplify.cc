#include "planner/algebra/simplify.h"

#include "planner/algebra/normal_form.h"

namespace assay::algebra {

Expression Simplify(const Expression& e, int most_terms) {
  return SimplifiedExpression(e, most_terms);
}

}  // namespace assay::algebra
