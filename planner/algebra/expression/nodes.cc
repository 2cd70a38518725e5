#include "planner/algebra/expression/nodes.h"

#include <algorithm>

#include "planner/algebra/expression/node_marks.h"

namespace assay::algebra {

namespace {

constexpr std::size_t kUsualNodes = 64;  // most expressions have fewer

// Returns the distinct sub-expressions of e in the order in which a breadth-first walk meets them.
// The first is e itself. e must belong to a pool.
std::vector<Expression> NodesAsMet(const Expression& e) {
  NodeMarks& marks = e.pool()->marks();
  marks.Begin(e.pool()->node_count());
  marks.Meet(e.index());
  std::vector<Expression> nodes;
  nodes.reserve(kUsualNodes);
  nodes.push_back(e);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    for (const Expression& operand : nodes[i].operands()) {
      if (marks.Meet(operand.index())) nodes.push_back(operand);
    }
  }
  return nodes;
}

}  // namespace

std::vector<Expression> NodesOf(const Expression& e) {
  if (e.pool() == nullptr) return {e};
  NodeMarks& marks = e.pool()->marks();
  std::vector<Expression> nodes = NodesAsMet(e);
  std::ranges::sort(nodes, {}, &Expression::index);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    marks.place(nodes[i].index()) = static_cast<int>(i);
  }
  return nodes;
}

std::size_t NodeCount(const Expression& e) {
  return e.pool() == nullptr ? 1 : NodesAsMet(e).size();
}

std::vector<Expression> NodesInPostorder(const Expression& e) {
  NodeMarks& marks = e.pool()->marks();
  marks.Begin(e.pool()->node_count());
  std::vector<Expression> nodes;
  nodes.reserve(kUsualNodes);
  struct Visit {
    Expression node;
    std::size_t next = 0;  // the next operand to visit
  };
  std::vector<Visit> path = {{e}};
  path.reserve(kUsualNodes);
  while (!path.empty()) {
    auto& [node, next] = path.back();
    if (next < node.operands().size()) {
      const Expression operand = node.operands()[next++];
      if (marks.Meet(operand.index())) path.push_back({operand});
    } else {
      marks.place(node.index()) = static_cast<int>(nodes.size());
      nodes.push_back(node);
      path.pop_back();
    }
  }
  return nodes;
}

std::vector<VariableId> VariablesOf(const Expression& e) {
  std::vector<VariableId> variables;
  if (e.pool() == nullptr) return variables;
  for (const Expression& node : NodesAsMet(e)) {
    if (node.op() == Operator::kVariable) variables.push_back(node.variable());
  }
  std::ranges::sort(variables);
  return variables;
}

std::vector<VariableId> VariablesOfAtom(const Expression& atom) {
  Expression inner = atom;
  while (inner.operands().size() == 1) inner = inner.operands()[0];
  if (inner.op() == Operator::kVariable) return {inner.variable()};
  return VariablesOf(inner);
}

}  // namespace assay::algebra
