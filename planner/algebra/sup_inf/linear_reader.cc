#include "planner/algebra/sup_inf/linear_reader.h"

#include <cmath>

#include "planner/algebra/operators/operator_rule.h"

namespace assay::algebra {

const std::optional<LinearForm>& LinearReader::Read(const Expression& e) {
  if (const auto known = known_.find(e.index()); known != known_.end() && e.index() >= 0) {
    return known->second;
  }
  return known_[e.index()] = ReadNew(e);
}

std::optional<LinearForm> LinearReader::ReadNew(const Expression& e) {
  if (e.IsConstant()) {
    if (!std::isfinite(e.constant())) return std::nullopt;
    return LinearForm{.constant = e.constant()};
  }
  if (e.op() == Operator::kVariable) return FormOf(ColumnId(e.variable().index()));
  const auto rule = e.op().rule().read_linear;
  return rule == nullptr ? std::nullopt : rule(*this, e);
}

}  // namespace assay::algebra
