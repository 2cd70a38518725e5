#include "planner/algebra/compiled_forms/compiler.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "planner/algebra/compiled_forms/step_writer.h"
#include "planner/algebra/expression/nodes.h"
#include "planner/base/intern_table.h"

namespace assay::algebra {
namespace {

using Factor = NormalForm::Factor;

class Compiler {
 public:
  explicit Compiler(std::span<const VariableId> variables)
      : writer_(variables), affine_(variables.size(), true) {}

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
    if (!writer_.IsLast(value)) writer_.AddBinary(Operator::kSum, value, AddConstant({0, 0}));
    return writer_.Finish(std::move(affine_));
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
      affine_[writer_.NumberOf(variable)] = false;
  }

  int AddConstant(const Interval& value) { return writer_.AddConstant(value); }

  // Finds the most frequent factor, and takes it out of all terms that contain it: the sum of the
  // remainders is multiplied by the factor. Repeats this with the remaining terms until no two of
  // them share a factor.
  int AddSum(std::span<Term> terms) {
    int sum = -1;
    const auto add = [&](int step) {
      sum = sum < 0 ? step : writer_.AddBinary(Operator::kSum, sum, step);
    };
    while (terms.size() > 1) {
      const int factor = SharedFactor(terms);
      if (factor < 0) break;
      const std::span<Term> sharing = MoveSharingBehind(factor, terms);
      const int other = AddSum(sharing);
      terms = terms.first(terms.size() - sharing.size());
      add(writer_.AddBinary(Operator::kProduct, AddFactor(factor), other));
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
      product = product < 0 ? step : writer_.AddBinary(Operator::kProduct, product, step);
    }
    if (term.coefficient == Interval{1, 1}) return product;
    const int coefficient = AddConstant(term.coefficient);
    return writer_.AddBinary(Operator::kProduct, coefficient, product);
  }

  int AddFactor(int number) {
    int& step = step_of_factor_[number];
    if (step < 0) {
      const Factor& factor = factors_[number];
      const int atom = writer_.AddExpression(factor.atom);
      step = factor.exponent == 1 ? atom : writer_.AddPower(atom, factor.exponent);
    }
    return step;
  }

  StepWriter writer_;
  std::vector<bool> affine_;  // indexed by variable
  std::vector<Factor> factors_;
  InternTable numbers_;               // indices of factors_
  std::vector<Term> sharing_;         // scratch of MoveSharingBehind
  std::vector<int> count_of_factor_;  // scratch, all zero between uses
  std::vector<int> step_of_factor_;   // -1 if the factor has no step yet
};

}  // namespace

CompiledForm Compile(const NormalForm& form, std::span<const VariableId> variables) {
  return Compiler(variables).Compile(form);
}

}  // namespace assay::algebra
