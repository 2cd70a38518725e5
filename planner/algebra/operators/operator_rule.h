#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "planner/algebra/expression/expression.h"
#include "planner/algebra/normal_forms/polynomial.h"
#include "planner/algebra/operators/operator.h"

namespace assay::algebra {

class AtomRelations;
class Expansion;
class FirstOrderArithmetic;
struct FirstOrderForm;
struct LinearForm;
class LinearReader;
class StepWriter;
class TextWriter;

// The position of a sub-expression in a text, which decides whether it needs parentheses. Each
// position binds more tightly than the ones before it.
enum class TextPlace {
  kWhole,        // the whole text, an argument, or inside parentheses
  kTerm,         // a term of a sum, with its sign
  kNegatedTerm,  // a term of a sum whose minus sign is already written
  kNumerator,
  kFirstFactor,
  kFactor,  // a factor after the first, or a denominator
  kBase,    // the base of a power
  kNone,    // beyond every position
};

// Tells at how many points of a box an operation has a value.
enum class Definedness { kNowhere, kSomewhere, kEverywhere };

// A law by which the normal form brings operands into one of several equal arrangements.
enum class Symmetry {
  kNone,
  kEven,      // f(-a) = f(a)
  kOdd,       // f(-a) = -f(a)
  kExchange,  // f(a, b) = f(b, a) and f(a, a) = a
};

// The place at which the derivatives of a function of one or two operands are taken.
template <class Number>
struct FunctionPlace {
  const Number& a;
  const Number& b;      // the second operand; for an operator with a companion, its value
  const Number& value;  // the function's value
  int exponent = 0;
};

// One rule for doubles and one for intervals, both from one generic lambda.
template <template <class> class Rule>
class ForPointsAndBoxes {
 public:
  constexpr ForPointsAndBoxes() = default;
  template <class Generic>
  constexpr ForPointsAndBoxes(Generic rule) : at_point_(rule), over_box_(rule) {}  // NOLINT

  template <class Number>
  Rule<Number> For() const {
    if constexpr (std::is_same_v<Number, double>) {
      return at_point_;
    } else {
      return over_box_;
    }
  }

 private:
  Rule<double> at_point_ = nullptr;
  Rule<Interval> over_box_ = nullptr;
};

// Returns the derivative of a function with respect to one operand (0 or 1).
template <class Number>
using SlopeRule = Number (*)(const FunctionPlace<Number>& place, int operand);
// Returns the derivative of a function with respect to operand i and then operand j.
template <class Number>
using CurvatureRule = Number (*)(const FunctionPlace<Number>& place, int i, int j);

// Everything that the algebra knows about one operator. An operator is a function unless it has
// rules of its own for making, writing, compiling and expanding. A function is written with its
// name, takes one or two operands, and is an atom of normal forms. Rules that are null have the
// meaning that their comments give. `exponent` is 0 for all operators but the power.
struct OperatorRule {
  using Polynomial = PolynomialAlgebra::Polynomial;
  struct SquareOfAtom {
    Polynomial base;
    int power = 1;  // 1 or 2: the square of the atom is base^power
  };

  // ---- Making and writing

  std::string_view name = {};  // the name of a function in texts
  std::size_t operand_count = 0;
  // Makes the operation. Null: numbers are folded where that is exact, and nothing else is done.
  Expression (*make)(std::span<const Expression> operands, int exponent) = nullptr;
  // Writes the operation. If null, the operation is written as its name and the operands in
  // parentheses.
  void (*write)(TextWriter& writer, const Expression& e, TextPlace place) = nullptr;
  // The operation gets parentheses at this place, and at places that bind more tightly.
  TextPlace parenthesized_from = TextPlace::kNone;

  // ---- Values

  // The value in doubles: NaN where there is none.
  double (*value)(std::span<const double> operands, int exponent) = nullptr;
  // An interval that contains the values for all operands that lie in the given intervals.
  Interval (*range)(std::span<const Interval> operands, int exponent) = nullptr;
  // Null: defined everywhere.
  Definedness (*definedness)(std::span<const Interval> operands, int exponent) = nullptr;

  // ---- Derivatives (derivatives.h). Operators with a rule `compile` need none.

  ForPointsAndBoxes<SlopeRule> slope = {};
  ForPointsAndBoxes<CurvatureRule> curvature = {};
  // The operator whose value for the same operand gives the slope, as cosine for sine. Both are
  // always computed, one after the other. Null: none.
  const Operator* companion = nullptr;
  bool follows_companion = false;
  // Compiles the operation, whose operands are steps already, and returns the step of its value.
  // Null: the operation becomes one step.
  int (*compile)(StepWriter& writer, const Expression& e, std::span<const int> operands) = nullptr;

  // ---- Normal form (expansion.h)

  // Expands the operation as a polynomial. Null: it is an atom.
  Polynomial (*expand)(Expansion& expansion, const Expression& e) = nullptr;
  Symmetry symmetry = Symmetry::kNone;  // of an atom
  // Returns what replaces the square of an atom. `operand` is the expansion of its operand. Null:
  // the square is not replaced.
  SquareOfAtom (*square)(Expansion& expansion, const Expression& atom,
                         const Polynomial& operand) = nullptr;

  // ---- Linear forms

  // Reads the operation as a linear form. Returns nothing if it is none. Null: it is never one.
  std::optional<LinearForm> (*read_linear)(LinearReader& reader, const Expression& e) = nullptr;
  // States linear relations between an atom and its operands. Null: there are none.
  void (*relate)(AtomRelations& relations, const Expression& atom) = nullptr;
  // True if SUP (INF) of the operation is the operation applied to SUP (INF) of each operand.
  bool passes_bounds_through = false;

  // ---- First order (first_order_form.h)

  // Returns the form of the operation, made from the forms of the operands. Null: the form is
  // unknown.
  FirstOrderForm (*first_order)(FirstOrderArithmetic& arithmetic,
                                std::span<const FirstOrderForm* const> operands,
                                int exponent) = nullptr;
};

}  // namespace assay::algebra
