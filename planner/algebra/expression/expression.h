#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "planner/base/check.h"
#include "planner/base/id.h"
#include "planner/base/interval.h"

namespace assay::algebra {

using VariableId = Id<struct BoundedVariableTag>;  // a variable of one ExpressionPool

enum class Operator : std::uint8_t {
  kConstant,
  kVariable,
  kSum,       // of two or more
  kProduct,   // of two or more
  kPower,     // operand ^ exponent(), an integer, not 0 or 1
  kQuotient,  // operand 0 / operand 1
  kSin,
  kCos,
  kSqrt,
  kAbs,
  kMin,  // of two
  kMax,  // of two
};

class ExpressionPool;
class KeptNormalForms;  // normal_form.h

// An immutable expression over the bounded variables of a pool: a value, cheap to copy. Equal
// sub-expressions are stored once in the pool (hash-consing), so that == is structural and takes
// constant time. A number is an expression of no pool; an operation joins the pools of its
// operands, which must not be two different ones. The pool must outlive its expressions.
//
// The operations below apply what holds exactly and without search: 0 and 1 as neutral and
// absorbing elements, numbers folded where the double result is exact or no pool is there to hold
// them apart, sums and products of up to kMostFlattened operands flattened into the one that they
// stand in (larger ones stay, so that a chain of n additions takes room in proportion to n), --e =
// e. Simplify (simplify.h) does the rest. Between plain numbers an operation without a real result
// (1 / 0, the root of -1) is a broken invariant; in a pool it stands as written.
class Expression {
 public:
  static constexpr std::size_t kMostFlattened = 64;

  Expression(double constant = 0) : constant_(constant) {}  // NOLINT: numbers are expressions

  Operator op() const;
  double constant() const;      // of kConstant
  VariableId variable() const;  // of kVariable
  int exponent() const;         // of kPower
  std::span<const Expression> operands() const;

  bool IsConstant() const { return op() == Operator::kConstant; }
  bool IsConstant(double value) const { return IsConstant() && constant() == value; }

  // Null for a plain number.
  ExpressionPool* pool() const { return pool_; }
  // Among the expressions of one pool: its number; operands have smaller ones. -1: a plain number.
  int index() const { return pool_ == nullptr ? -1 : node_; }

  // Whether there are square roots or divisions in it, so that it may have no value somewhere.
  bool MayBeUndefined() const;

  // Numbers are equal if their values are, in a pool or not.
  bool operator==(const Expression& other) const;

 private:
  friend class ExpressionPool;
  Expression(ExpressionPool* pool, int node) : pool_(pool), node_(node) {}
  const struct StoredNode& node() const;

  ExpressionPool* pool_ = nullptr;
  union {
    double constant_;  // of a plain number
    int node_;         // of the pool
  };
};

// What a pool keeps of an expression.
struct StoredNode {
  Operator op = Operator::kConstant;
  bool may_be_undefined = false;
  int number = 0;       // the variable's, or the exponent
  double constant = 0;  // of kConstant
  std::span<const Expression> operands = {};
};

Expression operator-(const Expression& a);
Expression operator+(const Expression& a, const Expression& b);
Expression operator-(const Expression& a, const Expression& b);
Expression operator*(const Expression& a, const Expression& b);
Expression operator/(const Expression& a, const Expression& b);
Expression Power(const Expression& a, int exponent);  // exponent 0 gives 1
Expression Sin(const Expression& a);
Expression Cos(const Expression& a);
Expression Sqrt(const Expression& a);
Expression Abs(const Expression& a);
Expression Min(const Expression& a, const Expression& b);
Expression Max(const Expression& a, const Expression& b);
Expression Sum(std::span<const Expression> terms);        // of none: 0
Expression Product(std::span<const Expression> factors);  // of none: 1

// Owns expressions and the bounded variables that they speak of. Single-threaded; not copyable.
class ExpressionPool {
 public:
  ExpressionPool();
  ~ExpressionPool();
  ExpressionPool(const ExpressionPool&) = delete;
  ExpressionPool& operator=(const ExpressionPool&) = delete;

  // A new variable. `name` (a letter or _, then letters, digits, _) is not taken yet, the bounds
  // have no NaN and do not go down: broken invariants otherwise.
  Expression Declare(std::string name, const Interval& bounds);
  Expression Variable(VariableId id);
  Expression Constant(double value);  // a number kept in the pool: operations do not round it away

  int variable_count() const;
  const std::string& name(VariableId id) const;
  const Interval& bounds(VariableId id) const;
  std::optional<VariableId> Find(std::string_view name) const;
  int node_count() const;

  // None until KeepNormalForms.
  KeptNormalForms* kept_normal_forms() const { return kept_normal_forms_.get(); }

 private:
  friend class Expression;
  friend void KeepNormalForms(ExpressionPool& pool);
  friend struct NodeAccess;  // of the operations (expression.cc)
  struct Storage;
  Expression At(int node) { return {this, node}; }

  std::vector<StoredNode> nodes_;     // by Expression::index
  std::unique_ptr<Storage> storage_;  // what finds them again, and their operands
  std::shared_ptr<KeptNormalForms> kept_normal_forms_;
};

// The distinct expressions that e is made of, by increasing index: operands before what they stand
// in, e itself last. A loop over them costs time in proportion to the stored expression, however
// deep it is and however often its parts occur.
std::vector<Expression> NodesOf(const Expression& e);
std::size_t NodeCount(const Expression& e);

// As many operands as the operator has, at least one; the exponent is that of a power.
Expression Apply(Operator op, std::span<const Expression> operands, int exponent = 0);

// The variables that occur, in increasing number.
std::vector<VariableId> VariablesOf(const Expression& e);

// e with every variable of the map replaced, all at once.
Expression Substitute(const Expression& e, const std::map<VariableId, Expression>& replacements);

// The value at a point (coordinates by VariableId), in doubles: not rounded outward. NaN where a
// square root or a quotient has no real value.
double Evaluate(const Expression& e, std::span<const double> point);

// The range over a box (intervals by VariableId) by interval arithmetic on the expression as it
// stands; contains every value.
Interval Evaluate(const Expression& e, std::span<const Interval> box);

inline const StoredNode& Expression::node() const { return pool_->nodes_[node_]; }

inline Operator Expression::op() const {
  return pool_ == nullptr ? Operator::kConstant : node().op;
}

inline double Expression::constant() const {
  if (pool_ == nullptr) return constant_;
  ASSAY_CHECK(node().op == Operator::kConstant);
  return node().constant;
}

inline VariableId Expression::variable() const {
  ASSAY_CHECK(op() == Operator::kVariable);
  return VariableId(node().number);
}

inline int Expression::exponent() const {
  ASSAY_CHECK(op() == Operator::kPower);
  return node().number;
}

inline std::span<const Expression> Expression::operands() const {
  if (pool_ == nullptr) return {};
  return node().operands;
}

inline bool Expression::MayBeUndefined() const {
  return pool_ != nullptr && node().may_be_undefined;
}

inline bool Expression::operator==(const Expression& other) const {
  if (pool_ == other.pool_ && pool_ != nullptr) return node_ == other.node_;
  return IsConstant() && other.IsConstant() && constant() == other.constant();
}

}  // namespace assay::algebra
