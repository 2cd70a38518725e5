#pragma once

#include <span>
#include <vector>

#include "planner/algebra/compiled_forms/compiled_form.h"
#include "planner/algebra/expression/expression.h"
#include "planner/base/index_map.h"
#include "planner/base/intern_table.h"

namespace assay::algebra {

// Writes the steps of a compiled form. Each function returns the step that gives the value.
class StepWriter {
 public:
  // A variable's number is its place in `variables`, which are in increasing order.
  explicit StepWriter(std::span<const VariableId> variables) : variables_(variables) {}

  int AddConstant(const Interval& value);
  // Adds the steps of an expression. Sub-expressions that have steps already are not added again.
  int AddExpression(const Expression& e);
  int AddBinary(Operator op, int a, int b);
  // Adds a sum or a product of any number of operands.
  int AddChain(Operator op, std::span<const int> operands);
  int AddPower(int base, int exponent);

  int NumberOf(VariableId variable) const;
  bool IsLast(int step) const { return step + 1 == static_cast<int>(form_.steps.size()); }
  CompiledForm Finish(std::vector<bool> affine);

 private:
  int AddStep(const CompiledForm::Step& step);
  int AddNode(const Expression& e);
  int AddOperation(const Expression& e, std::span<const int> operands);
  int AddFunction(Operator op, std::span<const int> operands, int exponent);
  int AddWithCompanion(Operator op, int operand);
  int FindWithCompanion(Operator op, int operand) const;

  std::span<const VariableId> variables_;
  CompiledForm form_;
  std::vector<int> operands_;  // the steps of the operands of the expressions that are being added
  IndexMap<int> step_of_expression_;
  InternTable with_companion_;  // the steps of operators that have a companion
};

}  // namespace assay::algebra
