#include "planner/algebra/expression/expression.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numeric>
#include <utility>

#include "planner/algebra/expression/intern_table.h"
#include "planner/algebra/expression/name.h"
#include "planner/algebra/numeric/interval_arithmetic.h"
#include "planner/base/check.h"

namespace assay::algebra {

namespace {

std::uint64_t HashOf(const StoredNode& node) {
  std::uint64_t hash =
      MixedHash(static_cast<std::uint64_t>(node.op),
                static_cast<std::uint64_t>(static_cast<std::uint32_t>(node.number)));
  hash = MixedHash(hash, std::bit_cast<std::uint64_t>(node.constant));
  for (const Expression& operand : node.operands) {
    hash = MixedHash(hash, static_cast<std::uint64_t>(operand.index()));
  }
  return hash;
}

bool AreSame(const StoredNode& a, const StoredNode& b) {
  const auto have_one_index = [](const Expression& x, const Expression& y) {
    return x.index() == y.index();
  };
  return a.op == b.op && a.number == b.number && a.constant == b.constant &&
         std::ranges::equal(a.operands, b.operands, have_one_index);
}

bool MayBeUndefined(const StoredNode& node) {
  if (node.op == Operator::kSqrt || node.op == Operator::kQuotient) return true;
  if (node.op == Operator::kPower && node.number < 0) return true;
  return std::ranges::any_of(node.operands, &Expression::MayBeUndefined);
}

}  // namespace

struct ExpressionPool::Storage {
  // Stores lists of operands. A stored list never moves in memory.
  class OperandArena {
   public:
    std::span<const Expression> Keep(std::span<const Expression> operands) {
      if (blocks_.empty() || blocks_.back().capacity() - blocks_.back().size() < operands.size()) {
        blocks_.emplace_back().reserve(std::max(kBlock, operands.size()));
      }
      std::vector<Expression>& block = blocks_.back();
      const std::size_t begin = block.size();
      block.insert(block.end(), operands.begin(), operands.end());
      return std::span<const Expression>(block).subspan(begin);
    }

   private:
    static constexpr std::size_t kBlock = 4096;
    std::vector<std::vector<Expression>> blocks_;
  };

  struct DeclaredVariable {
    std::string name;
    Interval bounds;
    int node = -1;
  };

  InternTable table;
  OperandArena arena;
  std::vector<Expression> listed;  // scratch: the operands of a sum or product under construction
  std::vector<DeclaredVariable> variables;
  std::map<std::string, VariableId, std::less<>> by_name;
  // Scratch of a walk over the nodes. `met_by` holds the last walk that met each node, and `place`
  // holds the place which that walk gave to the node.
  std::vector<std::uint32_t> met_by;
  std::vector<int> place;
  std::uint32_t walk = 0;

  void BeginWalk(std::size_t node_count) {
    met_by.resize(node_count, walk);
    place.resize(node_count);
    if (++walk == 0) {
      std::ranges::fill(met_by, 0);
      walk = 1;
    }
  }

  // Returns true if the current walk meets the node for the first time.
  bool Meet(int index) { return std::exchange(met_by[index], walk) != walk; }
};

struct NodeAccess {
  static ExpressionPool::Storage& StorageOf(const ExpressionPool& pool) { return *pool.storage_; }

  static Expression Intern(ExpressionPool& pool, const StoredNode& node) {
    ExpressionPool::Storage& storage = *pool.storage_;
    const std::uint64_t hash = HashOf(node);
    const auto is_same = [&](int index) { return AreSame(pool.nodes_[index], node); };
    const int known = storage.table.Find(hash, is_same);
    if (known >= 0) return pool.At(known);
    const int index = pool.node_count();
    pool.nodes_.push_back(node);
    pool.nodes_.back().operands = storage.arena.Keep(node.operands);
    pool.nodes_.back().may_be_undefined = MayBeUndefined(node);
    storage.table.Insert(hash, index);
    return pool.At(index);
  }

  static Expression Make(ExpressionPool* pool, Operator op, std::span<const Expression> operands,
                         int exponent = 0) {
    return Intern(*pool, {.op = op, .number = exponent, .operands = operands});
  }
};

namespace {

// Returns the pool of both operands, or null if both are plain numbers.
ExpressionPool* JoinedPool(ExpressionPool* a, const Expression& b) {
  ASSAY_CHECK(a == nullptr || b.pool() == nullptr || a == b.pool(),
              "an operation joins expressions of two pools");
  return a == nullptr ? b.pool() : a;
}

ExpressionPool* JoinedPool(std::span<const Expression> operands) {
  ExpressionPool* pool = nullptr;
  for (const Expression& operand : operands) {
    if (operand.pool() != pool) pool = JoinedPool(pool, operand);
  }
  return pool;
}

// Returns the number, stored in the pool if there is one.
Expression Number(double value, ExpressionPool* pool) {
  if (pool != nullptr) return pool->Constant(value);
  ASSAY_CHECK(!std::isnan(value), "an operation on numbers has no real result");
  return value;
}

Expression InPool(const Expression& e, ExpressionPool* pool) {
  return e.pool() == nullptr ? pool->Constant(e.constant()) : e;
}

// The rules by which sums and products fold their numbers, and the neutral number that they leave
// out.
struct Folding {
  Operator op;
  double neutral;
  double (*rounded)(double, double);
  Interval (*enclosed)(const Interval&, const Interval&);
};

constexpr Folding kSumFolding = {
    .op = Operator::kSum,
    .neutral = 0,
    .rounded = [](double a, double b) { return a + b; },
    .enclosed = [](const Interval& a, const Interval& b) { return a + b; }};
constexpr Folding kProductFolding = {
    .op = Operator::kProduct,
    .neutral = 1,
    .rounded = [](double a, double b) { return a * b; },
    .enclosed = [](const Interval& a, const Interval& b) { return a * b; }};

// The operands of a sum or product under construction in a pool.
class OperandList {
 public:
  OperandList(const Folding& folding, ExpressionPool* pool)
      : folding_(folding), pool_(pool), operands_(NodeAccess::StorageOf(*pool).listed) {
    operands_.clear();
  }

  void Add(const Expression& e) {
    if (e.op() == folding_.op && e.operands().size() <= Expression::kMostFlattened) {
      for (const Expression& operand : e.operands()) AddOne(operand);
    } else {
      AddOne(e);
    }
  }

  Expression Finish() {
    if (is_absorbed_) return Number(0, pool_);
    if (operands_.empty()) return Number(folding_.neutral, pool_);
    if (operands_.size() == 1) return operands_[0];
    return NodeAccess::Make(pool_, folding_.op, operands_);
  }

 private:
  void AddOne(const Expression& e) {
    if (!e.IsConstant()) {
      operands_.push_back(e);
    } else if (!e.IsConstant(folding_.neutral)) {
      AddNumber(e.constant());
    }
  }

  // Folds the number with numbers of the list until no two of them fold exactly. The result takes
  // the place of the number that was folded last.
  void AddNumber(double value) {
    if (folding_.op == Operator::kProduct && value == 0) is_absorbed_ = true;
    std::size_t place = operands_.size();
    for (std::size_t i = 0; i < operands_.size(); ++i) {
      if (!operands_[i].IsConstant() || !Folds(operands_[i].constant(), value)) continue;
      value = folding_.rounded(operands_[i].constant(), value);
      operands_.erase(operands_.begin() + static_cast<std::ptrdiff_t>(i));
      place = std::exchange(i, std::size_t(-1));  // start again from the front
    }
    if (value == folding_.neutral) return;
    operands_.insert(operands_.begin() + static_cast<std::ptrdiff_t>(place), Number(value, pool_));
  }

  bool Folds(double a, double b) const { return IsSingle(folding_.enclosed({a, a}, {b, b})); }

  const Folding& folding_;
  ExpressionPool* pool_;
  std::vector<Expression>& operands_;
  bool is_absorbed_ = false;
};

Expression CombinedNumbers(const Folding& folding, std::span<const Expression> numbers) {
  double value = folding.neutral;
  for (const Expression& number : numbers) value = folding.rounded(value, number.constant());
  return Number(value + 0.0, nullptr);  // avoids -0
}

// Returns the result if at most one operand differs from the neutral number, or if one operand
// absorbs the others. This shortcut pays because most operands in products of transforms are 0 or
// 1.
std::optional<Expression> CombinedAtOnce(const Folding& folding, ExpressionPool* pool,
                                         std::span<const Expression> operands) {
  const Expression* result = &operands.front();
  int speaking = 0;
  for (const Expression& operand : operands) {
    if (operand.IsConstant()) {
      const double number = operand.constant();
      if (folding.op == Operator::kProduct && number == 0) return InPool(operand, pool);
      if (number == folding.neutral) continue;
    }
    result = &operand;
    if (++speaking > 1) return std::nullopt;
  }
  return InPool(*result, pool);
}

Expression Combined(const Folding& folding, std::span<const Expression> operands) {
  ExpressionPool* const pool = JoinedPool(operands);
  if (pool == nullptr) return CombinedNumbers(folding, operands);
  if (const auto result = CombinedAtOnce(folding, pool, operands)) return *result;
  OperandList list(folding, pool);
  for (const Expression& operand : operands) list.Add(operand);
  return list.Finish();
}

// Returns the result of an operation on numbers. In a pool, it returns nothing if the result is not
// exact.
std::optional<Expression> FoldedNumber(ExpressionPool* pool, double rounded,
                                       const Interval& enclosed) {
  if (pool != nullptr && !(IsSingle(enclosed) && enclosed.low == rounded)) return std::nullopt;
  return Number(rounded, pool);
}

Interval Single(const Expression& number) { return {number.constant(), number.constant()}; }

Expression MakeUnary(Operator op, const Expression& a, double (*rounded)(double),
                     Interval (*enclosed)(const Interval&)) {
  if (a.IsConstant()) {
    const double value = rounded(a.constant());
    if (const auto folded = FoldedNumber(a.pool(), value, enclosed(Single(a)))) return *folded;
  }
  return NodeAccess::Make(a.pool(), op, std::array{a});
}

Expression MakeBinary(Operator op, const Expression& a, const Expression& b) {
  ExpressionPool* const pool = JoinedPool(a.pool(), b);
  return NodeAccess::Make(pool, op, std::array{InPool(a, pool), InPool(b, pool)});
}

bool AreNumbers(const Expression& a, const Expression& b) {
  return a.IsConstant() && b.IsConstant();
}

constexpr double kNotReal = std::numeric_limits<double>::quiet_NaN();

}  // namespace

Expression operator-(const Expression& a) { return -1 * a; }
Expression operator+(const Expression& a, const Expression& b) { return Sum(std::array{a, b}); }
Expression operator-(const Expression& a, const Expression& b) { return Sum(std::array{a, -b}); }
Expression operator*(const Expression& a, const Expression& b) { return Product(std::array{a, b}); }

Expression operator/(const Expression& a, const Expression& b) {
  ExpressionPool* const pool = JoinedPool(a.pool(), b);
  if (b.IsConstant(1)) return pool == nullptr ? a : InPool(a, pool);
  if (AreNumbers(a, b) && !(pool != nullptr && b.IsConstant(0))) {
    const double quotient = a.constant() / b.constant();
    ASSAY_CHECK(!b.IsConstant(0), "a plain number is divided by 0");
    if (const auto folded = FoldedNumber(pool, quotient, Single(a) / Single(b))) return *folded;
  }
  return MakeBinary(Operator::kQuotient, a, b);
}

Expression Power(const Expression& a, int exponent) {
  if (exponent == 0) return Number(1, a.pool());
  if (exponent == 1) return a;
  if (a.IsConstant() && !(a.IsConstant(0) && exponent < 0)) {
    const double power = std::pow(a.constant(), exponent);
    if (const auto folded = FoldedNumber(a.pool(), power, Power(Single(a), exponent))) {
      return *folded;
    }
  }
  ASSAY_CHECK(a.pool() != nullptr, "a negative power of the plain number 0");
  return NodeAccess::Make(a.pool(), Operator::kPower, std::array{a}, exponent);
}

Expression Sin(const Expression& a) {
  return MakeUnary(
      Operator::kSin, a, [](double x) { return std::sin(x); }, &Sin);
}

Expression Cos(const Expression& a) {
  return MakeUnary(
      Operator::kCos, a, [](double x) { return std::cos(x); }, &Cos);
}

Expression Sqrt(const Expression& a) {
  return MakeUnary(
      Operator::kSqrt, a, [](double x) { return std::sqrt(x); }, &Sqrt);
}

Expression Abs(const Expression& a) {
  return MakeUnary(
      Operator::kAbs, a, [](double x) { return std::abs(x); }, &Abs);
}

Expression Min(const Expression& a, const Expression& b) {
  if (AreNumbers(a, b)) {
    return Number(std::min(a.constant(), b.constant()), JoinedPool(a.pool(), b));
  }
  return MakeBinary(Operator::kMin, a, b);
}

Expression Max(const Expression& a, const Expression& b) {
  if (AreNumbers(a, b)) {
    return Number(std::max(a.constant(), b.constant()), JoinedPool(a.pool(), b));
  }
  return MakeBinary(Operator::kMax, a, b);
}

Expression Sum(std::span<const Expression> terms) { return Combined(kSumFolding, terms); }

Expression Product(std::span<const Expression> factors) {
  return Combined(kProductFolding, factors);
}

ExpressionPool::ExpressionPool() : storage_(std::make_unique<Storage>()) {}
ExpressionPool::~ExpressionPool() = default;

Expression ExpressionPool::Declare(std::string name, const Interval& bounds) {
  ASSAY_CHECK(IsName(name), "'{}' is not a variable's name", name);
  ASSAY_CHECK(bounds.low <= bounds.high, "bounds of '{}': [{}, {}]", name, bounds.low, bounds.high);
  const VariableId id(variable_count());
  ASSAY_CHECK(storage_->by_name.emplace(name, id).second, "'{}' is declared twice", name);
  const Expression variable =
      NodeAccess::Intern(*this, {.op = Operator::kVariable, .number = id.index()});
  storage_->variables.push_back(
      {.name = std::move(name), .bounds = bounds, .node = variable.index()});
  return variable;
}

Expression ExpressionPool::Variable(VariableId id) {
  return At(storage_->variables.at(id.index()).node);
}

Expression ExpressionPool::Constant(double value) {
  ASSAY_CHECK(!std::isnan(value), "a number is NaN");
  return NodeAccess::Intern(*this, {.constant = value + 0.0});  // avoids -0
}

int ExpressionPool::variable_count() const { return static_cast<int>(storage_->variables.size()); }

const std::string& ExpressionPool::name(VariableId id) const {
  return storage_->variables.at(id.index()).name;
}

const Interval& ExpressionPool::bounds(VariableId id) const {
  return storage_->variables.at(id.index()).bounds;
}

std::optional<VariableId> ExpressionPool::Find(std::string_view name) const {
  const auto found = storage_->by_name.find(name);
  if (found == storage_->by_name.end()) return std::nullopt;
  return found->second;
}

int ExpressionPool::node_count() const { return static_cast<int>(nodes_.size()); }

namespace {

constexpr std::size_t kUsualNodes = 64;  // most expressions have fewer

// Returns the distinct sub-expressions of e in the order in which a breadth-first walk meets them.
// The first is e itself. e must belong to a pool.
std::vector<Expression> NodesAsMet(const Expression& e) {
  auto& stored = NodeAccess::StorageOf(*e.pool());
  stored.BeginWalk(e.pool()->node_count());
  stored.Meet(e.index());
  std::vector<Expression> nodes;
  nodes.reserve(kUsualNodes);
  nodes.push_back(e);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    for (const Expression& operand : nodes[i].operands()) {
      if (stored.Meet(operand.index())) nodes.push_back(operand);
    }
  }
  return nodes;
}

}  // namespace

std::vector<Expression> NodesOf(const Expression& e) {
  if (e.pool() == nullptr) return {e};
  auto& stored = NodeAccess::StorageOf(*e.pool());
  std::vector<Expression> nodes = NodesAsMet(e);
  std::ranges::sort(nodes, {}, &Expression::index);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    stored.place[nodes[i].index()] = static_cast<int>(i);
  }
  return nodes;
}

std::size_t NodeCount(const Expression& e) {
  return e.pool() == nullptr ? 1 : NodesAsMet(e).size();
}

namespace {

// Returns the distinct sub-expressions of e, operands before the expressions that they stand in.
// Unlike NodesOf it does not sort them by index. e must belong to a pool.
std::vector<Expression> NodesInPostorder(const Expression& e) {
  auto& stored = NodeAccess::StorageOf(*e.pool());
  stored.BeginWalk(e.pool()->node_count());
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
      if (stored.Meet(operand.index())) path.push_back({operand});
    } else {
      stored.place[node.index()] = static_cast<int>(nodes.size());
      nodes.push_back(node);
      path.pop_back();
    }
  }
  return nodes;
}

// Applies `apply(node, values of its operands)` once to each node, in the given order, and returns
// the result for e. `apply` may add nodes, but must not start another walk.
template <class Result, class Apply>
Result ForwardPass(const Expression& e, const std::vector<Expression>& nodes, const Apply& apply) {
  const auto& stored = NodeAccess::StorageOf(*e.pool());
  std::vector<Result> results;
  results.reserve(nodes.size());
  std::vector<Result> operands;
  for (const Expression& node : nodes) {
    operands.clear();
    for (const Expression& operand : node.operands()) {
      operands.push_back(results[stored.place[operand.index()]]);
    }
    results.push_back(apply(node, std::span<const Result>(operands)));
  }
  return results.back();
}

double ApplyToNumbers(const Expression& node, std::span<const double> x) {
  switch (node.op()) {
    case Operator::kConstant:
      return node.constant();
    case Operator::kVariable:
      break;  // the caller handles variables
    case Operator::kSum:
      return std::accumulate(x.begin(), x.end(), 0.0);
    case Operator::kProduct:
      return std::accumulate(x.begin(), x.end(), 1.0, std::multiplies<>());
    case Operator::kPower:
      return x[0] == 0 && node.exponent() < 0 ? kNotReal : std::pow(x[0], node.exponent());
    case Operator::kQuotient:
      return x[1] == 0 ? kNotReal : x[0] / x[1];
    case Operator::kSin:
      return std::sin(x[0]);
    case Operator::kCos:
      return std::cos(x[0]);
    case Operator::kSqrt:
      return std::sqrt(x[0]);
    case Operator::kAbs:
      return std::abs(x[0]);
    // std::min and std::max return the first argument if the second is NaN, so NaN is tested for.
    case Operator::kMin:
      return std::isnan(x[1]) ? x[1] : std::min(x[0], x[1]);
    case Operator::kMax:
      return std::isnan(x[1]) ? x[1] : std::max(x[0], x[1]);
  }
  return kNotReal;
}

Interval ApplyToIntervals(const Expression& node, std::span<const Interval> x) {
  switch (node.op()) {
    case Operator::kConstant:
      return Single(node);
    case Operator::kVariable:
      break;  // the caller handles variables
    case Operator::kSum:
      return std::accumulate(x.begin() + 1, x.end(), x[0], kSumFolding.enclosed);
    case Operator::kProduct:
      return std::accumulate(x.begin() + 1, x.end(), x[0], kProductFolding.enclosed);
    case Operator::kPower:
      return Power(x[0], node.exponent());
    case Operator::kQuotient:
      return x[0] / x[1];
    case Operator::kSin:
      return Sin(x[0]);
    case Operator::kCos:
      return Cos(x[0]);
    case Operator::kSqrt:
      return Sqrt(x[0]);
    case Operator::kAbs:
      return Abs(x[0]);
    case Operator::kMin:
      return Min(x[0], x[1]);
    case Operator::kMax:
      return Max(x[0], x[1]);
  }
  return kWholeLine;
}

}  // namespace

Expression Apply(Operator op, std::span<const Expression> operands, int exponent) {
  switch (op) {
    case Operator::kConstant:
    case Operator::kVariable:
      break;
    case Operator::kSum:
      return Sum(operands);
    case Operator::kProduct:
      return Product(operands);
    case Operator::kPower:
      return Power(operands[0], exponent);
    case Operator::kQuotient:
      return operands[0] / operands[1];
    case Operator::kSin:
      return Sin(operands[0]);
    case Operator::kCos:
      return Cos(operands[0]);
    case Operator::kSqrt:
      return Sqrt(operands[0]);
    case Operator::kAbs:
      return Abs(operands[0]);
    case Operator::kMin:
      return Min(operands[0], operands[1]);
    case Operator::kMax:
      return Max(operands[0], operands[1]);
  }
  ASSAY_CHECK(false, "has no operands");
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

Expression Substitute(const Expression& e, const std::map<VariableId, Expression>& replacements) {
  const auto apply = [&](const Expression& node, std::span<const Expression> operands) {
    if (node.op() == Operator::kVariable) {
      const auto found = replacements.find(node.variable());
      return found == replacements.end() ? node : InPool(found->second, node.pool());
    }
    if (std::ranges::equal(operands, node.operands())) return node;
    return Apply(node.op(), operands, node.op() == Operator::kPower ? node.exponent() : 0);
  };
  if (e.pool() == nullptr) return e;
  return ForwardPass<Expression>(e, NodesOf(e), apply);
}

double Evaluate(const Expression& e, std::span<const double> point) {
  const auto apply = [&](const Expression& node, std::span<const double> operands) {
    if (node.op() == Operator::kVariable) return point[node.variable().index()];
    return ApplyToNumbers(node, operands);
  };
  if (e.pool() == nullptr) return e.constant();
  return ForwardPass<double>(e, NodesInPostorder(e), apply);
}

Interval Evaluate(const Expression& e, std::span<const Interval> box) {
  const auto apply = [&](const Expression& node, std::span<const Interval> operands) {
    if (node.op() == Operator::kVariable) return box[node.variable().index()];
    return ApplyToIntervals(node, operands);
  };
  if (e.pool() == nullptr) return Single(e);
  return ForwardPass<Interval>(e, NodesInPostorder(e), apply);
}

}  // namespace assay::algebra
