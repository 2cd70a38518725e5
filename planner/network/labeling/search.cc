#include "planner/network/labeling/search.h"

#include <limits>
#include <numeric>
#include <utility>

#include "planner/base/check.h"
#include "planner/network/labeling/forward_checking.h"
#include "planner/network/labeling/tree_search.h"

namespace assay::network {
namespace {

// Returns the nodes of `order`, followed by all others by number.
std::vector<int> Scope(int node_count, const std::vector<NodeId>& order) {
  std::vector<int> scope;
  std::vector<char> taken(node_count, 0);
  for (NodeId node : order) {
    ASSAY_CHECK(node.index() >= 0 && node.index() < node_count, "node {} of {}", node.index(),
                node_count);
    if (!std::exchange(taken[node.index()], 1)) scope.push_back(node.index());
  }
  for (int node = 0; node < node_count; ++node) {
    if (!taken[node]) scope.push_back(node);
  }
  return scope;
}

ArcConsistency WithoutWeights(ArcConsistency consistency) {
  consistency.ForgetWeights();
  return consistency;
}

// If a network has many labelings, forward checking finds one before arc consistency would be
// reached. Returns false if the question is still open after half as many wipe-outs as there are
// nodes.
bool DecideByForwardChecking(const Network& network, Budget& budget, FirstLabeling& first) {
  if (!ForwardChecking::Fits(network.label_store())) return false;
  ForwardChecking search(network.label_store(), network.arc_consistency(), first.counters);
  const auto outcome = search.Any(network.node_count() / 2, budget);
  if (!outcome.has_value()) return false;
  first.outcome = *outcome;
  if (outcome == Outcome::kFound) first.labeling = search.labeling();
  return true;
}

}  // namespace

struct Labelings::State {
  State(const Network& network, const SearchOptions& options)
      : arcs(network.arcs().begin(), network.arcs().end()),
        labels(network.label_store()),
        consistency(WithoutWeights(network.arc_consistency())),
        search(labels, consistency, counters, Scope(network.node_count(), options.order),
               options.order.empty() ? NodeOrder::kConflictWeighted : NodeOrder::kGiven) {
    for (int node = 0; node < labels.node_count(); ++node) {
      exhausted = exhausted || labels.count(node) == 0;
    }
    exhausted = exhausted || !consistency.Propagate(labels, counters);
  }

  std::vector<Arc> arcs;  // keep the relations alive
  LabelStore labels;
  ArcConsistency consistency;
  Counters counters;
  TreeSearch search;
  bool exhausted = false;
  Labeling labeling;
};

Labelings::Labelings(const Network& network, const SearchOptions& options)
    : state_(std::make_unique<State>(network, options)) {}
Labelings::~Labelings() = default;
Labelings::Labelings(Labelings&&) noexcept = default;
Labelings& Labelings::operator=(Labelings&&) noexcept = default;

Outcome Labelings::Next(Budget& budget) {
  if (state_->exhausted) return Outcome::kNone;
  const Outcome outcome = state_->search.Next(budget);
  if (outcome == Outcome::kFound) {
    state_->labeling.labels.resize(state_->labels.node_count());
    for (int node = 0; node < state_->labels.node_count(); ++node) {
      state_->labeling.labels[node] = state_->labels.First(node);
    }
  }
  return outcome;
}

Outcome Labelings::Next() {
  Budget budget(std::numeric_limits<std::int64_t>::max());
  return Next(budget);
}

const Labeling& Labelings::labeling() const { return state_->labeling; }
const Counters& Labelings::counters() const { return state_->counters; }

FirstLabeling First(const Network& network, const SearchOptions& options, Budget& budget) {
  if (!options.order.empty()) {
    Labelings labelings(network, options);
    const Outcome outcome = labelings.Next(budget);
    return {outcome, labelings.labeling(), labelings.counters()};
  }
  if (const Labeling* witness = network.witness()) return {Outcome::kFound, *witness, {}};
  FirstLabeling first;
  if (DecideByForwardChecking(network, budget, first)) return first;
  Network copy = network;
  copy.ForgetWeights();
  const Counters before = copy.counters();
  first.outcome = copy.Decide(budget);
  if (first.outcome == Outcome::kFound) first.labeling = *copy.witness();
  first.counters = first.counters + copy.counters() - before;
  return first;
}

// One labeling is searched for first, to see whether there is any. Otherwise an inconsistent
// component that is late in the order would be refuted again for each labeling of the components
// before it.
AllLabelings All(const Network& network, const SearchOptions& options, Budget& budget) {
  AllLabelings all;
  const FirstLabeling first = First(network, {}, budget);
  all.outcome = first.outcome;
  all.counters = first.counters;
  if (first.outcome != Outcome::kFound) return all;
  Labelings labelings(network, options);
  Outcome outcome;
  while ((outcome = labelings.Next(budget)) == Outcome::kFound) {
    all.labelings.push_back(labelings.labeling());
  }
  all.outcome = outcome == Outcome::kBudget ? Outcome::kBudget : Outcome::kFound;
  all.counters = all.counters + labelings.counters();
  return all;
}

}  // namespace assay::network
