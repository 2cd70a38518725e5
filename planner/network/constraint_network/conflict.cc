#include "planner/network/constraint_network/conflict.h"

#include <algorithm>
#include <numeric>
#include <optional>

namespace assay::network {
namespace {

// Junker's algorithm QX with the network as the background. Constraints are posted to the network
// and undone.
class QuickXplain {
 public:
  QuickXplain(const Network& background, std::span<const Constraint> constraints, Budget& budget)
      : network_(background), constraints_(constraints), budget_(budget) {}

  // Decides whether the background with the added constraints is consistent.
  Outcome Decide(std::span<const int> added);

  enum class Background { kUnchanged, kExtended };
  // Returns a minimal subset of `candidates` that is inconsistent with the background. All
  // candidates together must be inconsistent with it. Returns nothing when the budget is spent.
  std::optional<std::vector<int>> Explain(std::span<const int> candidates, Background background);

 private:
  std::optional<std::vector<int>> ExplainGiven(std::span<const int> given,
                                               std::span<const int> candidates);
  void Push(std::span<const int> added);

  Network network_;
  std::span<const Constraint> constraints_;
  Budget& budget_;
};

void QuickXplain::Push(std::span<const int> added) {
  for (int index : added) Add(network_, constraints_[index]);
}

Outcome QuickXplain::Decide(std::span<const int> added) {
  const Network::Mark mark = network_.Save();
  Push(added);
  const Outcome outcome = network_.Decide(budget_);
  network_.Undo(mark);
  return outcome;
}

std::optional<std::vector<int>> QuickXplain::Explain(std::span<const int> candidates,
                                                     Background background) {
  if (background == Background::kExtended) {
    const Outcome outcome = Decide({});
    if (outcome == Outcome::kBudget) return std::nullopt;
    if (outcome == Outcome::kNone) return std::vector<int>();
  }
  if (candidates.size() == 1) return std::vector<int>(candidates.begin(), candidates.end());
  const std::size_t half = candidates.size() / 2;
  const auto later = ExplainGiven(candidates.first(half), candidates.subspan(half));
  if (!later.has_value()) return std::nullopt;
  auto both = ExplainGiven(*later, candidates.first(half));
  if (both.has_value()) both->insert(both->end(), later->begin(), later->end());
  return both;
}

std::optional<std::vector<int>> QuickXplain::ExplainGiven(std::span<const int> given,
                                                          std::span<const int> candidates) {
  const Network::Mark mark = network_.Save();
  Push(given);
  auto conflict =
      Explain(candidates, given.empty() ? Background::kUnchanged : Background::kExtended);
  network_.Undo(mark);
  return conflict;
}

struct Adder {
  Network& network;
  void operator()(const UnaryConstraint& unary) const { network.Narrow(unary.node, unary.allowed); }
  void operator()(const BinaryConstraint& binary) const {
    network.AddArc(binary.a, binary.b, binary.relation);
  }
};

}  // namespace

void Add(Network& network, const Constraint& constraint) { std::visit(Adder{network}, constraint); }

Conflict MinimalConflict(const Network& background, std::span<const Constraint> constraints,
                         Budget& budget) {
  QuickXplain quick_xplain(background, constraints, budget);
  std::vector<int> all(constraints.size());
  std::iota(all.begin(), all.end(), 0);
  const Outcome together = quick_xplain.Decide(all);
  if (together == Outcome::kBudget) return {.outcome = Outcome::kBudget, .constraints = {}};
  if (together == Outcome::kFound) return {.outcome = Outcome::kNone, .constraints = {}};
  if (all.empty()) return {.outcome = Outcome::kFound, .constraints = {}};
  auto conflict = quick_xplain.Explain(all, QuickXplain::Background::kExtended);
  if (!conflict.has_value()) return {.outcome = Outcome::kBudget, .constraints = {}};
  std::sort(conflict->begin(), conflict->end());
  return {.outcome = Outcome::kFound, .constraints = std::move(*conflict)};
}

}  // namespace assay::network
