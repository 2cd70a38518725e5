#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "planner/algebra/operators/operator.h"
#include "planner/base/check.h"
#include "planner/base/id.h"
#include "planner/base/interval.h"

namespace assay::algebra {

using VariableId = Id<struct BoundedVariableTag>;  // identifies a variable of one ExpressionPool

class ExpressionPool;
class KeptNormalForms;  // defined in normalization.cc
class NodeMarks;        // defined in node_marks.h

// An immutable expression over the bounded variables of a pool. It is a value and cheap to copy.
// The pool stores equal sub-expressions once (hash-consing), so that == is structural and takes
// constant time. A number is an expression without a pool. The operands of an operation must not
// belong to two different pools, and the result belongs to their pool. The pool must outlive its
// expressions.
//
// The operations below apply only rules that are exact and need no search. 0 and 1 act as neutral
// and absorbing elements, and --e = e. Numbers are folded where the double result is exact, or
// where there is no pool that could store them separately. A sum (product) is flattened into the
// sum (product) that it is an operand of, if it has at most kMostFlattened operands. Larger ones
// are kept, so that a chain of n additions takes memory proportional to n. Simplify (simplify.h)
// does the rest. An operation on plain numbers without a real result (1 / 0, the root of -1) breaks
// an invariant; in a pool the operation is kept as written.
class Expression {
 public:
  static constexpr std::size_t kMostFlattened = 64;

  Expression(double constant = 0) : constant_(constant) {}  // NOLINT: numbers are expressions

  Operator op() const;
  double constant() const;      // only for kConstant
  VariableId variable() const;  // only for kVariable
  int exponent() const;         // 0 unless the expression is a power
  std::span<const Expression> operands() const;

  bool IsConstant() const { return op() == Operator::kConstant; }
  bool IsConstant(double value) const { return IsConstant() && constant() == value; }

  // Returns null for a plain number.
  ExpressionPool* pool() const { return pool_; }
  // Returns the number of this expression in its pool, or -1 for a plain number. Operands have
  // smaller numbers than the expression that contains them.
  int index() const { return pool_ == nullptr ? -1 : node_; }

  // Returns true if the expression contains a square root or a division, so it may have no value at
  // some points.
  bool MayBeUndefined() const;

  // Two numbers are equal if their values are equal, whether or not they are in a pool.
  bool operator==(const Expression& other) const;

 private:
  friend class ExpressionPool;
  Expression(ExpressionPool* pool, int node) : pool_(pool), node_(node) {}
  const struct StoredNode& node() const;

  ExpressionPool* pool_ = nullptr;
  union {
    double constant_;  // for a plain number
    int node_;         // for an expression of a pool: the value of index()
  };
};

// The record that a pool stores for one expression.
struct StoredNode {
  Operator op = Operator::kConstant;
  const Expression* operands = nullptr;
  double constant = 0;  // only for kConstant
  int number = 0;       // the variable's number, or the exponent of a power
  std::uint32_t operand_count : 31 = 0;
  bool may_be_undefined : 1 = false;
};

// The operations. Each of them is defined in the file of its operator (planner/algebra/operators).
Expression operator-(const Expression& a);
Expression operator+(const Expression& a, const Expression& b);
Expression operator-(const Expression& a, const Expression& b);
Expression operator*(const Expression& a, const Expression& b);
Expression operator/(const Expression& a, const Expression& b);
Expression Power(const Expression& a, int exponent);  // returns 1 for exponent 0
Expression Sin(const Expression& a);
Expression Cos(const Expression& a);
Expression Sqrt(const Expression& a);
Expression Abs(const Expression& a);
Expression Min(const Expression& a, const Expression& b);
Expression Max(const Expression& a, const Expression& b);
Expression Sum(std::span<const Expression> terms);        // returns 0 for no terms
Expression Product(std::span<const Expression> factors);  // returns 1 for no factors

// Owns expressions and the bounded variables in them. It is single-threaded and not copyable.
class ExpressionPool {
 public:
  // `further_operators` are those that Parse knows by name besides the built-in ones.
  explicit ExpressionPool(std::vector<Operator> further_operators = {});
  ~ExpressionPool();
  ExpressionPool(const ExpressionPool&) = delete;
  ExpressionPool& operator=(const ExpressionPool&) = delete;

  // Adds a variable. The name is a letter or _, followed by letters, digits and _. A name that is
  // already taken, a bound that is NaN, and a lower bound above the upper one each break an
  // invariant.
  Expression Declare(std::string name, const Interval& bounds);
  Expression Variable(VariableId id);
  Expression Constant(double value);  // stored in the pool, so never rounded away

  int variable_count() const;
  const std::string& name(VariableId id) const;
  const Interval& bounds(VariableId id) const;
  std::optional<VariableId> Find(std::string_view name) const;
  int node_count() const;

  // The operators beyond the built-in ones that texts over this pool may name.
  std::span<const Operator> further_operators() const { return further_operators_; }

  // Returns the stored expression that is equal to the node, and adds it if there is none. The
  // operands must be expressions of this pool. Only the rules of operators call this, since they
  // decide which nodes there may be.
  Expression Store(const StoredNode& node);

  // Memory that operations and walks use again and again.
  std::vector<Expression>& scratch_operands();
  NodeMarks& marks();

  // Returns null until KeepNormalForms has been called.
  KeptNormalForms* kept_normal_forms() const { return kept_normal_forms_.get(); }

 private:
  friend class Expression;
  friend void KeepNormalForms(ExpressionPool& pool);
  struct Storage;
  Expression At(int node) { return {this, node}; }

  std::vector<StoredNode> nodes_;     // indexed by Expression::index
  std::unique_ptr<Storage> storage_;  // hash table, operands and variables
  std::shared_ptr<KeptNormalForms> kept_normal_forms_;
  std::vector<Operator> further_operators_;
};

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

inline int Expression::exponent() const { return op() == Operator::kPower ? node().number : 0; }

inline std::span<const Expression> Expression::operands() const {
  if (pool_ == nullptr) return {};
  return {node().operands, node().operand_count};
}

inline bool Expression::MayBeUndefined() const {
  return pool_ != nullptr && node().may_be_undefined;
}

inline bool Expression::operator==(const Expression& other) const {
  if (pool_ == other.pool_ && pool_ != nullptr) return node_ == other.node_;
  return IsConstant() && other.IsConstant() && constant() == other.constant();
}

}  // namespace assay::algebra
