#include "planner/algebra/expression/expression.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <map>
#include <utility>

#include "planner/algebra/expression/name.h"
#include "planner/algebra/expression/node_marks.h"
#include "planner/base/intern_table.h"

namespace assay::algebra {

namespace {

std::span<const Expression> OperandsOf(const StoredNode& node) {
  return {node.operands, node.operand_count};
}

std::uint64_t HashOf(const StoredNode& node) {
  std::uint64_t hash =
      MixedHash(reinterpret_cast<std::uintptr_t>(&node.op.rule()),
                static_cast<std::uint64_t>(static_cast<std::uint32_t>(node.number)));
  hash = MixedHash(hash, std::bit_cast<std::uint64_t>(node.constant));
  for (const Expression& operand : OperandsOf(node)) {
    hash = MixedHash(hash, static_cast<std::uint64_t>(operand.index()));
  }
  return hash;
}

bool AreSame(const StoredNode& a, const StoredNode& b) {
  const auto have_one_index = [](const Expression& x, const Expression& y) {
    return x.index() == y.index();
  };
  return a.op == b.op && a.number == b.number && a.constant == b.constant &&
         std::ranges::equal(OperandsOf(a), OperandsOf(b), have_one_index);
}

// Stores lists of operands. A stored list never moves in memory.
class OperandArena {
 public:
  const Expression* Keep(std::span<const Expression> operands) {
    if (blocks_.empty() || blocks_.back().capacity() - blocks_.back().size() < operands.size()) {
      blocks_.emplace_back().reserve(std::max(kBlock, operands.size()));
    }
    std::vector<Expression>& block = blocks_.back();
    const std::size_t begin = block.size();
    block.insert(block.end(), operands.begin(), operands.end());
    return block.data() + begin;
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

}  // namespace

struct ExpressionPool::Storage {
  InternTable table;
  OperandArena arena;
  std::vector<DeclaredVariable> variables;
  std::map<std::string, VariableId, std::less<>> by_name;
  std::vector<Expression> scratch_operands;
  NodeMarks marks;
};

ExpressionPool::ExpressionPool(std::vector<Operator> further_operators)
    : storage_(std::make_unique<Storage>()), further_operators_(std::move(further_operators)) {}
ExpressionPool::~ExpressionPool() = default;

Expression ExpressionPool::Store(const StoredNode& node) {
  const std::uint64_t hash = HashOf(node);
  const auto is_same = [&](int index) { return AreSame(nodes_[index], node); };
  const int known = storage_->table.Find(hash, is_same);
  if (known >= 0) return At(known);
  const int index = node_count();
  nodes_.push_back(node);
  nodes_.back().operands = storage_->arena.Keep(OperandsOf(node));
  nodes_.back().may_be_undefined =
      node.may_be_undefined || std::ranges::any_of(OperandsOf(node), &Expression::MayBeUndefined);
  storage_->table.Insert(hash, index);
  return At(index);
}

Expression ExpressionPool::Declare(std::string name, const Interval& bounds) {
  ASSAY_CHECK(IsName(name), "'{}' is not a variable's name", name);
  ASSAY_CHECK(bounds.low <= bounds.high, "bounds of '{}': [{}, {}]", name, bounds.low, bounds.high);
  const VariableId id(variable_count());
  ASSAY_CHECK(storage_->by_name.emplace(name, id).second, "'{}' is declared twice", name);
  const Expression variable = Store({.op = Operator::kVariable, .number = id.index()});
  storage_->variables.push_back(
      {.name = std::move(name), .bounds = bounds, .node = variable.index()});
  return variable;
}

Expression ExpressionPool::Variable(VariableId id) {
  return At(storage_->variables.at(id.index()).node);
}

Expression ExpressionPool::Constant(double value) {
  ASSAY_CHECK(!std::isnan(value), "a number is NaN");
  return Store({.constant = value + 0.0});  // avoids -0
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

std::vector<Expression>& ExpressionPool::scratch_operands() { return storage_->scratch_operands; }

NodeMarks& ExpressionPool::marks() { return storage_->marks; }

}  // namespace assay::algebra
