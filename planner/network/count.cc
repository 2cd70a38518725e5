#include "planner/network/count.h"

#include <optional>
#include <vector>

#include "planner/network/component.h"
#include "planner/network/node_order.h"

namespace assay::network {
namespace {

// Counts stop at kManyLabelings.
std::uint64_t Sum(std::uint64_t a, std::uint64_t b) {
  return a > kManyLabelings - b ? kManyLabelings : a + b;
}

std::uint64_t Product(std::uint64_t a, std::uint64_t b) {
  return b != 0 && a > kManyLabelings / b ? kManyLabelings : a * b;
}

class LabelingCounter {
 public:
  LabelingCounter(const Network& network, Budget& budget)
      : labels_(network.label_store()), arcs_(network.arc_consistency()), budget_(budget) {
    arcs_.ForgetWeights();
  }

  // Empty when the budget is spent.
  std::optional<std::uint64_t> CountAll();
  const Counters& counters() const { return counters_; }

 private:
  std::optional<std::uint64_t> CountComponents(const std::vector<std::vector<int>>& components);
  std::optional<std::uint64_t> CountComponent(const std::vector<int>& component);
  std::optional<std::uint64_t> CountByBranching(const std::vector<int>& component);
  bool IsTree(const std::vector<int>& component) const;
  std::uint64_t CountTree(int root) const;
  // For each label of `node`, the labelings of the tree that hangs from it, away from `parent`.
  std::vector<std::uint64_t> CountBelow(int node, int parent) const;

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
  return CountComponents(OpenComponents(labels_, arcs_));
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

// Connected, with one arc less than nodes.
bool LabelingCounter::IsTree(const std::vector<int>& component) const {
  std::size_t ends = 0;
  for (int node : component) {
    for (const ArcConsistency::Direction& direction : arcs_.at(node)) {
      if (labels_.count(direction.revised) > 1) ++ends;
    }
  }
  return ends == 2 * (component.size() - 1);
}

std::uint64_t LabelingCounter::CountTree(int root) const {
  const std::vector<std::uint64_t> counts = CountBelow(root, -1);
  std::uint64_t sum = 0;
  for (Label label : labels_.Labels(root)) sum = Sum(sum, counts[label]);
  return sum;
}

std::vector<std::uint64_t> LabelingCounter::CountBelow(int node, int parent) const {
  std::vector<std::uint64_t> counts(labels_.size(node), 1);
  for (const ArcConsistency::Direction& direction : arcs_.at(node)) {
    const int child = direction.revised;
    if (child == parent || labels_.count(child) <= 1) continue;
    const std::vector<std::uint64_t> below = CountBelow(child, node);
    const LabelSet child_labels = labels_.Labels(child);
    const auto words = std::ssize(child_labels.words());
    for (Label label : labels_.Labels(node)) {
      LabelSet supported = LabelSet::OfWords(
          labels_.size(child), {direction.supported + label * words, child_labels.words().size()});
      supported.intersect(child_labels);
      std::uint64_t sum = 0;
      for (Label child_label : supported) sum = Sum(sum, below[child_label]);
      counts[label] = Product(counts[label], sum);
    }
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
