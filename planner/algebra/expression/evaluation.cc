#include "planner/algebra/expression/evaluation.h"

#include <vector>

#include "planner/algebra/expression/node_marks.h"
#include "planner/algebra/expression/nodes.h"
#include "planner/algebra/operators/function.h"
#include "planner/algebra/operators/operator_rule.h"
#include "planner/base/check.h"

namespace assay::algebra {

namespace {

// Applies `apply(node, values of its operands)` once to each node, in the given order, and returns
// the result for e. `apply` must not start another walk.
template <class Result, class Apply>
Result ForwardPass(const Expression& e, const std::vector<Expression>& nodes, const Apply& apply) {
  NodeMarks& marks = e.pool()->marks();
  std::vector<Result> results;
  results.reserve(nodes.size());
  std::vector<Result> operands;
  for (const Expression& node : nodes) {
    operands.clear();
    for (const Expression& operand : node.operands()) {
      operands.push_back(results[marks.place(operand.index())]);
    }
    results.push_back(apply(node, std::span<const Result>(operands)));
  }
  return results.back();
}

}  // namespace

Expression Apply(Operator op, std::span<const Expression> operands) {
  ASSAY_CHECK(!operands.empty(), "has no operands");
  const auto make = op.rule().make;
  return make != nullptr ? make(operands, 0) : FunctionOf(op, operands);
}

double Evaluate(const Expression& e, std::span<const double> point) {
  const auto apply = [&](const Expression& node, std::span<const double> operands) {
    if (node.op() == Operator::kVariable) return point[node.variable().index()];
    if (node.IsConstant()) return node.constant();
    return node.op().rule().value(operands, node.exponent());
  };
  if (e.pool() == nullptr) return e.constant();
  return ForwardPass<double>(e, NodesInPostorder(e), apply);
}

Interval Evaluate(const Expression& e, std::span<const Interval> box) {
  const auto apply = [&](const Expression& node, std::span<const Interval> operands) {
    if (node.op() == Operator::kVariable) return box[node.variable().index()];
    if (node.IsConstant()) return IntervalOf(node);
    return node.op().rule().range(operands, node.exponent());
  };
  if (e.pool() == nullptr) return IntervalOf(e);
  return ForwardPass<Interval>(e, NodesInPostorder(e), apply);
}

}  // namespace assay::algebra
