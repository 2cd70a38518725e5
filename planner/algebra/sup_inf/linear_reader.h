#pragma once

#include <optional>
#include <unordered_map>

#include "planner/algebra/expression/expression.h"
#include "planner/algebra/sup_inf/linear_form.h"

namespace assay::algebra {

// Reads expressions that are linear as they are written. The column of a variable has the
// variable's number. Each sub-expression is read once, however often it occurs.
class LinearReader {
 public:
  // Returns nothing if e is not linear as it is written.
  const std::optional<LinearForm>& Read(const Expression& e);

 private:
  std::optional<LinearForm> ReadNew(const Expression& e);

  std::unordered_map<int, std::optional<LinearForm>> known_;  // indexed by an expression's index
};

}  // namespace assay::algebra
