#include "planner/algebra/forms/compiled_form.h"

#include <algorithm>
#include <utility>

#include "planner/algebra/expression/index_map.h"
#include "planner/algebra/expression/intern_table.h"
#include "planner/base/check.h"

namespace assay::algebra {
namespace {

using Step = CompiledForm::Step;
using Factor = NormalForm::Factor;

class Compiler {
 public:
  explicit Compiler(std::span<const VariableId> variables) : variables_(variables) {
    form_.affine.assign(variables.size(), true);
  }

  CompiledForm Compile(const NormalForm& form) {
    std::vector<int> numbers = NumbersOf(form);
    std::vector<Term> terms;
    terms.reserve(form.terms.size());
    auto begin = numbers.begin();
    for (const NormalForm::Term& term : form.terms) {
      const auto end = begin + std::ssize(term.factors);
      terms.push_back({term.coefficient, {begin, end}});
      std::sort(begin, end);
      begin = end;
    }
    count_of_factor_.assign(factors_.size(), 0);
    step_of_factor_.assign(factors_.size(), -1);
    const int value = AddSum(terms);
    // The value must be the last step, even if it is a step that other steps share.
    if (value + 1 != static_cast<int>(form_.steps.size())) {
      AddBinary(Operator::kSum, value, AddConstant({0, 0}));
    }
    return std::move(form_);
  }

 private:
  struct Term {
    Interval coefficient;
    std::span<int> factors;  // places in factors_, increasing
  };

  // Returns the numbers of all factors, term by term.
  std::vector<int> NumbersOf(const NormalForm& form) {
    std::vector<int> numbers;
    for (const NormalForm::Term& term : form.terms) {
      for (const Factor& factor : term.factors) numbers.push_back(NumberOf(factor));
    }
    return numbers;
  }

  int NumberOf(const Factor& factor) {
    const std::uint64_t hash = MixedHash(factor.exponent, factor.atom.index() + 1);
    const int known = numbers_.Find(hash, [&](int number) { return factors_[number] == factor; });
    if (known >= 0) return known;
    const int number = static_cast<int>(factors_.size());
    factors_.push_back(factor);
    NoteAffineVariables(factor);
    numbers_.Insert(hash, number);
    return number;
  }

  // The form is affine in a variable that occurs only as a separate factor, to the first power.
  void NoteAffineVariables(const Factor& factor) {
    if (factor.atom.op() == Operator::kVariable && factor.exponent == 1) return;
    for (VariableId variable : VariablesOfAtom(factor.atom))
      form_.affine[NumberOf(variable)] = false;
  }

  int NumberOf(VariableId variable) const {
    const auto at = std::lower_bound(variables_.begin(), variables_.end(), variable);
    ASSAY_CHECK(at != variables_.end() && *at == variable, "variable {} is not in the list",
                variable.index());
    return static_cast<int>(at - variables_.begin());
  }

  int AddStep(const Step& step) {
    form_.steps.push_back(step);
    return static_cast<int>(form_.steps.size()) - 1;
  }

  int AddConstant(const Interval& value) {
    form_.constants.push_back(value);
    return AddStep({.op = Operator::kConstant, .a = static_cast<int>(form_.constants.size()) - 1});
  }

  int AddBinary(Operator op, int a, int b) { return AddStep({.op = op, .a = a, .b = b}); }

  // Finds the most frequent factor, sums the terms that contain it without it, and multiplies that
  // sum by it. Repeats this with the remaining terms until no two of them share a factor.
  int AddSum(std::span<Term> terms) {
    int sum = -1;
    const auto add = [&](int step) { sum = sum < 0 ? step : AddBinary(Operator::kSum, sum, step); };
    while (terms.size() > 1) {
      const int factor = SharedFactor(terms);
      if (factor < 0) break;
      const std::span<Term> sharing = MoveSharingBehind(factor, terms);
      const int other = AddSum(sharing);
      terms = terms.first(terms.size() - sharing.size());
      add(AddBinary(Operator::kProduct, AddFactor(factor), other));
    }
    for (const Term& term : terms) add(AddProduct(term));
    return sum < 0 ? AddConstant({0, 0}) : sum;
  }

  // Returns the factor that most terms contain, the first of several, or -1 if no factor is in two
  // terms.
  int SharedFactor(std::span<const Term> terms) {
    int best = -1;
    int best_count = 1;
    for (const Term& term : terms) {
      for (int factor : term.factors) {
        const int count = ++count_of_factor_[factor];
        if (count > best_count || (count == best_count && count > 1 && factor < best)) {
          best = factor;
          best_count = count;
        }
      }
    }
    for (const Term& term : terms) {
      for (int factor : term.factors) count_of_factor_[factor] = 0;
    }
    return best;
  }

  // Moves the terms that contain the factor behind the others, removes the factor from them, and
  // returns them.
  std::span<Term> MoveSharingBehind(int factor, std::span<Term> terms) {
    const auto stays = [&](Term& term) {
      const auto at = std::ranges::find(term.factors, factor);
      if (at == term.factors.end()) return true;
      std::copy(at + 1, term.factors.end(), at);
      term.factors = term.factors.first(term.factors.size() - 1);
      return false;
    };
    sharing_.clear();
    auto end = terms.begin();
    for (Term& term : terms) {
      if (stays(term)) {
        *end++ = term;
      } else {
        sharing_.push_back(term);
      }
    }
    std::ranges::copy(sharing_, end);
    return {end, terms.end()};
  }

  int AddProduct(const Term& term) {
    if (term.factors.empty()) return AddConstant(term.coefficient);
    int product = -1;
    for (int factor : term.factors) {
      const int step = AddFactor(factor);
      product = product < 0 ? step : AddBinary(Operator::kProduct, product, step);
    }
    if (term.coefficient == Interval{1, 1}) return product;
    const int coefficient = AddConstant(term.coefficient);
    return AddBinary(Operator::kProduct, coefficient, product);
  }

  int AddFactor(int number) {
    int& step = step_of_factor_[number];
    if (step < 0) {
      const Factor& factor = factors_[number];
      const int atom = AddExpression(factor.atom);
      step = factor.exponent == 1 ? atom : AddPower(atom, factor.exponent);
    }
    return step;
  }

  int AddPower(int base, int exponent) {
    return AddStep({.op = Operator::kPower, .a = base, .exponent = exponent});
  }

  int AddExpression(const Expression& e) {
    if (e.IsConstant()) return AddConstant({e.constant(), e.constant()});
    if (const int* known = step_of_expression_.Find(e.index())) return *known;
    const int step = AddNode(e);
    step_of_expression_[e.index()] = step;
    return step;
  }

  int AddNode(const Expression& e) {
    const std::size_t first = operands_.size();
    for (const Expression& operand : e.operands()) operands_.push_back(AddExpression(operand));
    const int step = AddOperation(e, std::span<const int>(operands_).subspan(first));
    operands_.resize(first);
    return step;
  }

  int AddOperation(const Expression& e, std::span<const int> operands) {
    switch (e.op()) {
      case Operator::kConstant:
        return AddConstant({e.constant(), e.constant()});
      case Operator::kVariable:
        return AddStep({.op = Operator::kVariable, .a = NumberOf(e.variable())});
      case Operator::kSum:
      case Operator::kProduct: {
        int step = operands[0];
        for (std::size_t i = 1; i < operands.size(); ++i) {
          step = AddBinary(e.op(), step, operands[i]);
        }
        return step;
      }
      case Operator::kPower:
        return AddPower(operands[0], e.exponent());
      case Operator::kQuotient: {
        const int reciprocal = AddPower(operands[1], -1);
        return AddBinary(Operator::kProduct, operands[0], reciprocal);
      }
      case Operator::kSin:
      case Operator::kCos:
        return AddSineAndCosine(e.op(), operands[0]);
      case Operator::kSqrt:
      case Operator::kAbs:
        return AddStep({.op = e.op(), .a = operands[0]});
      case Operator::kMin:
      case Operator::kMax:
        return AddBinary(e.op(), operands[0], operands[1]);
    }
    ASSAY_CHECK(false, "no such operator");
  }

  // Adds sine and cosine together, because each is needed for the other's derivative.
  int AddSineAndCosine(Operator wanted, int angle) {
    const auto [sine, is_new] = sine_of_.Insert(angle);
    if (is_new) {
      sine = static_cast<int>(form_.steps.size());
      AddBinary(Operator::kSin, angle, sine + 1);
      AddBinary(Operator::kCos, angle, sine);
    }
    return wanted == Operator::kSin ? sine : sine + 1;
  }

  std::span<const VariableId> variables_;
  CompiledForm form_;
  std::vector<Factor> factors_;
  InternTable numbers_;        // indices of factors_
  std::vector<Term> sharing_;  // scratch of MoveSharingBehind
  std::vector<int> operands_;  // the steps of the operands of the expressions that are being added
  std::vector<int> count_of_factor_;  // scratch, all zero between uses
  std::vector<int> step_of_factor_;   // -1 if the factor has no step yet
  IndexMap<int> step_of_expression_;
  IndexMap<int> sine_of_;  // indexed by the step of the angle
};

}  // namespace

std::vector<VariableId> VariablesOfAtom(const Expression& atom) {
  Expression inner = atom;
  while (inner.operands().size() == 1) inner = inner.operands()[0];
  if (inner.op() == Operator::kVariable) return {inner.variable()};
  return VariablesOf(inner);
}

CompiledForm Compile(const NormalForm& form, std::span<const VariableId> variables) {
  return Compiler(variables).Compile(form);
}

}  // namespace assay::algebra
