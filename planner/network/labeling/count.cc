#include "planner/network/labeling/count.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "planner/network/labeling/component.h"
#include "planner/network/labeling/node_order.h"
#include "planner/network/labeling/search.h"

namespace assay::network {
namespace {

// Sum and Product saturate at kManyLabelings.
std::uint64_t Sum(std::uint64_t a, std::uint64_t b) {
  return a > kManyLabelings - b ? kManyLabelings : a + b;
}

std::uint64_t Product(std::uint64_t a, std::uint64_t b) {
  return b != 0 && a > kManyLabelings / b ? kManyLabelings : a * b;
}

// A node of a tree.
struct Hung {
  int node = 0;
  int above = -1;                                     // place of the parent in a list
  const ArcConsistency::Direction* by_arc = nullptr;  // direction from the parent to this node
};

class LabelingCounter {
 public:
  LabelingCounter(const Network& network, Budget& budget)
      : network_(network),
        labels_(network.label_store()),
        arcs_(network.arc_consistency()),
        budget_(budget) {
    arcs_.ForgetWeights();
  }

  // Returns nothing when the budget is spent.
  std::optional<std::uint64_t> CountAll();
  const Counters& counters() const { return counters_; }

 private:
  Outcome FindOne();
  std::optional<std::uint64_t> CountComponents(const std::vector<std::vector<int>>& components);
  std::optional<std::uint64_t> CountComponent(const std::vector<int>& component);
  std::optional<std::uint64_t> CountByBranching(const std::vector<int>& component);
  bool IsTree(const std::vector<int>& component) const;
  std::uint64_t CountTree(int root) const;
  std::vector<Hung> HungFrom(int root) const;
  // Returns, for each label of the parent node `above`, the number of labelings of the subtree at
  // `hung`. `below` has these numbers for each label of the subtree's root.
  std::vector<std::uint64_t> CountsAbove(const Hung& hung, int above,
                                         const std::vector<std::uint64_t>& below) const;

  const Network& network_;
  LabelStore labels_;
  ArcConsistency arcs_;
  Budget& budget_;
  Counters counters_;
};

std::optional<std::uint64_t> LabelingCounter::CountAll() {
  for (int node = 0; node < labels_.node_count(); ++node) {
    if (labels_.count(node) == 0) return 0;
  }
  if (!arcs_.Propagate(labels_, counters_)) return 0;
  const std::vector<std::vector<int>> components = OpenComponents(labels_, arcs_);
  if (!std::ranges::all_of(components, [&](const auto& nodes) { return IsTree(nodes); })) {
    const Outcome outcome = FindOne();
    if (outcome == Outcome::kNone) return 0;
    if (outcome == Outcome::kBudget) return std::nullopt;
  }
  return CountComponents(components);
}

// If there is no labeling, a search for one shows it several times sooner than counting does,
// because counting looks for components at every node.
Outcome LabelingCounter::FindOne() {
  if (network_.witness() != nullptr) return Outcome::kFound;
  const FirstLabeling first = First(network_, {}, budget_);
  counters_ = counters_ + first.counters;
  return first.outcome;
}

std::optional<std::uint64_t> LabelingCounter::CountComponents(
    const std::vector<std::vector<int>>& components) {
  std::uint64_t product = 1;
  for (const std::vector<int>& component : components) {
    const std::optional<std::uint64_t> count = CountComponent(component);
    if (!count.has_value() || *count == 0) return count;
    product = Product(product, *count);
  }
  return product;
}

std::optional<std::uint64_t> LabelingCounter::CountComponent(const std::vector<int>& component) {
  return IsTree(component) ? CountTree(component.front()) : CountByBranching(component);
}

std::optional<std::uint64_t> LabelingCounter::CountByBranching(const std::vector<int>& component) {
  const int node = OpenNodes(component, labels_, arcs_).Heaviest();
  std::uint64_t sum = 0;
  for (Label label : labels_.Labels(node)) {
    if (!budget_.Spend()) return std::nullopt;
    ++counters_.visited;
    const LabelStore::Mark mark = labels_.Save();
    labels_.Assign(node, label);
    arcs_.Enqueue(node);
    if (arcs_.Propagate(labels_, counters_)) {
      const auto count = CountComponents(OpenComponents(component, labels_, arcs_));
      if (!count.has_value()) return std::nullopt;
      sum = Sum(sum, *count);
    }
    labels_.Undo(mark);
  }
  return sum;
}

// A connected component is a tree if it has one arc less than nodes.
bool LabelingCounter::IsTree(const std::vector<int>& component) const {
  std::size_t ends = 0;
  for (int node : component) {
    for (const ArcConsistency::Direction& direction : arcs_.at(node)) {
      if (labels_.count(direction.revised) > 1) ++ends;
    }
  }
  return ends == 2 * (component.size() - 1);
}

// Counts from the leaves up. It uses no recursion, because paths may be long.
std::uint64_t LabelingCounter::CountTree(int root) const {
  const std::vector<Hung> tree = HungFrom(root);
  std::vector<std::vector<std::uint64_t>> counts;
  for (const Hung& hung : tree) counts.emplace_back(labels_.size(hung.node), 1);
  for (std::size_t i = tree.size() - 1; i > 0; --i) {
    std::vector<std::uint64_t>& above = counts[tree[i].above];
    const auto factors = CountsAbove(tree[i], tree[tree[i].above].node, counts[i]);
    for (std::size_t label = 0; label < above.size(); ++label) {
      above[label] = Product(above[label], factors[label]);
    }
    counts[i] = {};
  }
  std::uint64_t sum = 0;
  for (Label label : labels_.Labels(root)) sum = Sum(sum, counts[0][label]);
  return sum;
}

// Returns the nodes of the tree, parents before children.
std::vector<Hung> LabelingCounter::HungFrom(int root) const {
  std::vector<Hung> tree = {{.node = root}};
  for (std::size_t i = 0; i < tree.size(); ++i) {
    const int parent = tree[i].above < 0 ? -1 : tree[tree[i].above].node;
    for (const ArcConsistency::Direction& direction : arcs_.at(tree[i].node)) {
      const int child = direction.revised;
      if (child == parent || labels_.count(child) <= 1) continue;
      tree.push_back({child, static_cast<int>(i), &direction});
    }
  }
  return tree;
}

std::vector<std::uint64_t> LabelingCounter::CountsAbove(
    const Hung& hung, int above, const std::vector<std::uint64_t>& below) const {
  std::vector<std::uint64_t> counts(labels_.size(above), 0);
  const LabelSet hung_labels = labels_.Labels(hung.node);
  const auto words = std::ssize(hung_labels.words());
  for (Label label : labels_.Labels(above)) {
    LabelSet supported =
        LabelSet::OfWords(labels_.size(hung.node),
                          {hung.by_arc->supported + label * words, hung_labels.words().size()});
    supported.intersect(hung_labels);
    for (Label hung_label : supported) counts[label] = Sum(counts[label], below[hung_label]);
  }
  return counts;
}

}  // namespace

LabelingCount Count(const Network& network, Budget& budget) {
  LabelingCounter counter(network, budget);
  const std::optional<std::uint64_t> count = counter.CountAll();
  const Outcome outcome = !count.has_value() ? Outcome::kBudget
                          : *count == 0      ? Outcome::kNone
                                             : Outcome::kFound;
  return {outcome, count.value_or(0), counter.counters()};
}

}  // namespace assay::network
