#include "planner/algebra/compiled_forms/step_writer.h"

#include <algorithm>
#include <utility>

#include "planner/algebra/operators/function.h"
#include "planner/algebra/operators/operator_rule.h"
#include "planner/base/check.h"

namespace assay::algebra {

namespace {

std::uint64_t HashOfStep(Operator op, int operand) {
  return MixedHash(reinterpret_cast<std::uintptr_t>(&op.rule()),
                   static_cast<std::uint64_t>(operand));
}

}  // namespace

CompiledForm StepWriter::Finish(std::vector<bool> affine) {
  form_.affine = std::move(affine);
  return std::move(form_);
}

int StepWriter::NumberOf(VariableId variable) const {
  const auto at = std::lower_bound(variables_.begin(), variables_.end(), variable);
  ASSAY_CHECK(at != variables_.end() && *at == variable, "variable {} is not in the list",
              variable.index());
  return static_cast<int>(at - variables_.begin());
}

int StepWriter::AddStep(const CompiledForm::Step& step) {
  form_.steps.push_back(step);
  return static_cast<int>(form_.steps.size()) - 1;
}

int StepWriter::AddConstant(const Interval& value) {
  form_.constants.push_back(value);
  return AddStep({.op = Operator::kConstant, .a = static_cast<int>(form_.constants.size()) - 1});
}

int StepWriter::AddBinary(Operator op, int a, int b) { return AddStep({.op = op, .a = a, .b = b}); }

int StepWriter::AddChain(Operator op, std::span<const int> operands) {
  int step = operands[0];
  for (const int operand : operands.subspan(1)) step = AddBinary(op, step, operand);
  return step;
}

int StepWriter::AddPower(int base, int exponent) {
  return AddFunction(Operator::kPower, {&base, 1}, exponent);
}

int StepWriter::AddExpression(const Expression& e) {
  if (e.IsConstant()) return AddConstant({e.constant(), e.constant()});
  if (const int* known = step_of_expression_.Find(e.index())) return *known;
  const int step = AddNode(e);
  step_of_expression_[e.index()] = step;
  return step;
}

int StepWriter::AddNode(const Expression& e) {
  if (e.op() == Operator::kVariable) return AddStep({.op = e.op(), .a = NumberOf(e.variable())});
  const std::size_t first = operands_.size();
  for (const Expression& operand : e.operands()) operands_.push_back(AddExpression(operand));
  const int step = AddOperation(e, std::span<const int>(operands_).subspan(first));
  operands_.resize(first);
  return step;
}

int StepWriter::AddOperation(const Expression& e, std::span<const int> operands) {
  const auto compile = e.op().rule().compile;
  return compile != nullptr ? compile(*this, e, operands)
                            : AddFunction(e.op(), operands, e.exponent());
}

int StepWriter::AddFunction(Operator op, std::span<const int> operands, int exponent) {
  if (op.rule().companion != nullptr) return AddWithCompanion(op, operands[0]);
  return AddStep({.op = op,
                  .a = operands[0],
                  .b = operands.size() > 1 ? operands[1] : -1,
                  .exponent = exponent,
                  .may_be_undefined = MayLackValue(op, exponent)});
}

// Adds the operator and its companion together, because each is needed for the other's derivative.
int StepWriter::AddWithCompanion(Operator op, int operand) {
  if (const int known = FindWithCompanion(op, operand); known >= 0) return known;
  const Operator companion = *op.rule().companion;
  const int first = static_cast<int>(form_.steps.size());
  const bool is_second = op.rule().follows_companion;
  AddBinary(is_second ? companion : op, operand, first + 1);
  AddBinary(is_second ? op : companion, operand, first);
  for (const int step : {first, first + 1}) {
    with_companion_.Insert(HashOfStep(form_.steps[step].op, operand), step);
  }
  return is_second ? first + 1 : first;
}

int StepWriter::FindWithCompanion(Operator op, int operand) const {
  return with_companion_.Find(HashOfStep(op, operand), [&](int step) {
    return form_.steps[step].op == op && form_.steps[step].a == operand;
  });
}

}  // namespace assay::algebra
