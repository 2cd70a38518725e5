#include "planner/algebra/operators/operator_rule.h"

namespace assay::algebra {

// Constants and variables have no operands, and each computation begins with them. They need no
// rules.
const OperatorRule kConstantRule;
const OperatorRule kVariableRule;

}  // namespace assay::algebra
