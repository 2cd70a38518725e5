#include "sim/execution/walk/audit.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace assay::execution {

using contingent::AtomId;
using contingent::FunctionId;
using contingent::GroundQuery;
using contingent::KnowledgeBase;
using contingent::KnowledgeState;

namespace {

constexpr double kRounding = 1e-9;

bool Contains(const contingent::Range& range, double value) {
  return value >= range.low - kRounding && value <= range.high + kRounding;
}

std::string HowItIs(double value) { return fmt::format("it is {:.3f}", value); }

// Returns what is wrong with the reading; empty if `value` was read within `error`.
std::string WrongReading(const std::optional<Reading>& reading, double value, double error) {
  if (!reading) return "nothing has told it";
  if (std::abs(reading->value - value) <= error + kRounding) return {};
  return fmt::format("it was read as {:.3f} and is {:.3f}", reading->value, value);
}

}  // namespace

std::vector<FalseClaim> Audit::FalseClaims(KnowledgeBase& knowledge, const KnowledgeState& state,
                                           const Truth& truth, const Readings& readings,
                                           int step) const {
  std::vector<FalseClaim> found = FalseAtoms(knowledge, state, truth, step);
  std::ranges::move(FalseRelations(knowledge, state, truth, step), std::back_inserter(found));
  std::ranges::move(FalseNumbers(knowledge, state, truth, readings, step),
                    std::back_inserter(found));
  return found;
}

std::vector<FalseClaim> Audit::FalseRelations(KnowledgeBase& knowledge, const KnowledgeState& state,
                                              const Truth& truth, int step) const {
  const contingent::GroundTask& task = interpretation_.task;
  contingent::WorldSets& worlds = knowledge.worlds();
  std::vector<FalseClaim> found;
  for (const contingent::Diagram relation : state.relations) {
    std::vector<contingent::Assignment> truths;
    std::vector<std::string> atoms;
    std::vector<std::string> literals;
    for (const int variable : worlds.Support(relation)) {
      const AtomId atom = worlds.AtomOf(variable);
      if (!IsAudited(atom)) continue;
      truths.push_back({variable, IsTrue(atom, truth)});
      atoms.push_back(task.atoms[atom.index()]);
      literals.push_back(TextOf(task, contingent::GroundLiteral{atom, truths.back().value}));
    }
    if (worlds.Restrict(relation, truths) != contingent::kEmptySet) continue;
    found.push_back({step, fmt::format("Kx of {}", fmt::join(atoms, ", ")), true, false,
                     fmt::format("{}", fmt::join(literals, " & "))});
  }
  return found;
}

std::vector<FalseClaim> Audit::FalseNumbers(const KnowledgeBase& knowledge,
                                            const KnowledgeState& state, const Truth& truth,
                                            const Readings& readings, int step) const {
  const contingent::GroundTask& task = interpretation_.task;
  std::vector<FalseClaim> found;
  for (std::size_t slot = 0; slot < state.ranges.size(); ++slot) {
    const FunctionId id = task.function_of_slot[slot];
    const contingent::GroundFunction& function = task.functions[id.index()];
    const contingent::Range& range = state.ranges[slot];
    const Quantity* const quantity = interpretation_.QuantityOf(id);
    if (quantity == nullptr) continue;
    const double value = TrueValue(id, truth);
    if (!Contains(range, value))
      found.push_back({step, TextOf(function, range), true, false, HowItIs(value)});
    if (!knowledge.layout().IsSensed(state, id)) continue;
    const auto reading = quantity->Observed(readings, RolesOf(problem_, function.arguments));
    const std::string wrong = WrongReading(reading, value, range.error);
    const std::string text = fmt::format("Kv({} within {})", function.text, range.error);
    if (!wrong.empty()) found.push_back({step, text, true, false, wrong});
  }
  return found;
}

std::vector<FalseClaim> Audit::FalseAtoms(const KnowledgeBase& knowledge,
                                          const KnowledgeState& state, const Truth& truth,
                                          int step) const {
  std::vector<FalseClaim> found;
  for (std::size_t i = 0; i < interpretation_.task.atoms.size(); ++i) {
    const AtomId atom(i);
    if (knowledge.layout().IsUndetermined(state, atom)) continue;
    if (!IsAudited(atom)) continue;
    const bool claimed = knowledge.layout().IsKnown(state, {atom, true});
    const bool is_true = IsTrue(atom, truth);
    if (claimed != is_true)
      found.push_back({step, interpretation_.task.atoms[i], claimed, is_true});
  }
  return found;
}

bool Audit::IsGoalTrue(const Truth& truth) const { return Holds(interpretation_.task.goal, truth); }

bool Audit::IsAudited(AtomId atom) const {
  const Predicate* const predicate = interpretation_.PredicateOf(atom);
  return predicate != nullptr && predicate->IsAudited();
}

bool Audit::IsTrue(AtomId atom, const Truth& truth) const {
  const contingent::GroundAtom& ground = interpretation_.task.ground_atoms[atom.index()];
  return interpretation_.PredicateOf(atom)->IsTrue(truth, RolesOf(problem_, ground.arguments));
}

double Audit::TrueValue(FunctionId function, const Truth& truth) const {
  const auto& arguments = interpretation_.task.functions[function.index()].arguments;
  return interpretation_.QuantityOf(function)->TrueValue(truth, RolesOf(problem_, arguments));
}

bool Audit::Holds(const GroundQuery& query, const Truth& truth) const {
  const auto holds = [&](const GroundQuery& operand) { return Holds(operand, truth); };
  switch (query.kind) {
    case GroundQuery::Kind::kAnd:
      return std::ranges::all_of(query.operands, holds);
    case GroundQuery::Kind::kOr:
      return std::ranges::any_of(query.operands, holds);
    case GroundQuery::Kind::kKnown:
      return !IsAudited(query.literal.atom) ||
             IsTrue(query.literal.atom, truth) == query.literal.is_positive;
    case GroundQuery::Kind::kBoundKnown:
      return interpretation_.QuantityOf(query.bound.function) == nullptr ||
             execution::Holds(query.bound, TrueValue(query.bound.function, truth));
    case GroundQuery::Kind::kNot:
    case GroundQuery::Kind::kKnownWhether:
    case GroundQuery::Kind::kValueSensed:
      return true;
  }
  return false;
}

}  // namespace assay::execution
