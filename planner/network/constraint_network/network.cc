#include "planner/network/constraint_network/network.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <utility>

#include "planner/base/check.h"
#include "planner/network/labeling/component.h"
#include "planner/network/labeling/tree_search.h"
#include "planner/network/simd_rows/lane_search.h"

namespace assay::network {
namespace {

// The number of wipe-outs after which a search counts as long. SIMD rows are built only for long
// searches.
constexpr std::int64_t kShortSearch = 10;

Budget Unlimited() { return Budget(std::numeric_limits<std::int64_t>::max()); }

}  // namespace

Outcome Network::Restrict(NodeId node, const LabelSet& allowed) {
  Budget budget = Unlimited();
  return Restrict(node, allowed, budget);
}

Outcome Network::Restrict(NodeId node, const LabelSet& allowed, Budget& budget) {
  return Try(
      {node}, [&] { Narrow(node, allowed); }, budget);
}

Outcome Network::Post(NodeId a, NodeId b, std::shared_ptr<const Relation> relation) {
  Budget budget = Unlimited();
  return Post(a, b, std::move(relation), budget);
}

Outcome Network::Post(NodeId a, NodeId b, std::shared_ptr<const Relation> relation,
                      Budget& budget) {
  return Try(
      {a, b}, [&] { AddArc(a, b, relation); }, budget);
}

NodeId Network::AddNode(const LabelSet& labels) {
  const NodeId node(node_count());
  labels_.AddNode(labels);
  consistency_.AddNode();
  if (labels.empty()) witness_holds_ = false;
  witness_.labels.push_back(labels.empty() ? TreeSearch::kNoLabel : labels.first());
  return node;
}

void Network::Narrow(NodeId node, const LabelSet& allowed) {
  CheckNode(node);
  const int index = node.index();
  ASSAY_CHECK(allowed.size() == labels_.size(index), "{} labels for a node of {}", allowed.size(),
              labels_.size(index));
  LabelSet narrowed = labels_.Labels(index);
  narrowed.intersect(allowed);
  labels_.Replace(index, narrowed);
  consistency_.Enqueue(index);
  propagated_ = owed_ = false;
  witness_holds_ = witness_holds_ && narrowed.contains(witness_[node]);
}

void Network::AddArc(NodeId a, NodeId b, std::shared_ptr<const Relation> relation) {
  CheckNode(a);
  CheckNode(b);
  ASSAY_CHECK(relation != nullptr);
  ASSAY_CHECK(
      relation->rows() == labels_.size(a.index()) && relation->columns() == labels_.size(b.index()),
      "a {} x {} relation between nodes of {} and {} labels", relation->rows(), relation->columns(),
      labels_.size(a.index()), labels_.size(b.index()));
  if (a == b) {
    NarrowToLoop(a, *relation);
  } else {
    consistency_.AddArc(static_cast<int>(arcs_.size()), a.index(), b.index(), *relation);
    consistency_.Enqueue(a.index());
    consistency_.Enqueue(b.index());
    propagated_ = owed_ = false;
    witness_holds_ = witness_holds_ && relation->Allows(witness_[a], witness_[b]);
  }
  arcs_.push_back({.a = a, .b = b, .relation = std::move(relation)});
}

// An arc from a node to itself allows the labels that the relation pairs with themselves.
void Network::NarrowToLoop(NodeId node, const Relation& relation) {
  LabelSet allowed = LabelSet::None(relation.rows());
  for (Label label = 0; label < relation.rows(); ++label) {
    if (relation.Allows(label, label)) allowed.insert(label);
  }
  Narrow(node, allowed);
}

Outcome Network::Decide() {
  Budget budget = Unlimited();
  return Decide(budget);
}

Outcome Network::Decide(Budget& budget) {
  if (!witness_holds_) return Search(budget);
  owed_ = true;
  return Outcome::kFound;
}

// Before a search, label sets are made arc consistent without the new constraint. If the constraint
// is then undone, this work need not be repeated.
template <class Constrain>
Outcome Network::Try(std::initializer_list<NodeId> ends, const Constrain& constrain,
                     Budget& budget) {
  Mark before = Save();
  const bool held = witness_holds_;
  constrain();
  const auto mend = [&](NodeId end) { return Mend(end); };
  if (witness_holds_ || (held && std::ranges::any_of(ends, mend))) return Decide(budget);
  if (held && !before.propagated) {
    Undo(before);
    Propagate();
    before = Save();
    constrain();
  }
  const Outcome outcome = Search(budget);
  if (outcome == Outcome::kFound) return outcome;
  Undo(before);
  // Only a labeling that was found replaces the witness, so the old witness is still stored.
  witness_holds_ = held;
  return outcome;
}

bool Network::HasEmptyNode() const {
  for (int node = 0; node < node_count(); ++node) {
    if (labels_.count(node) == 0) return true;
  }
  return false;
}

bool Network::Propagate() const {
  propagated_ = !HasEmptyNode() && consistency_.Propagate(labels_, counters_);
  return propagated_;
}

LabelSet Network::labels(NodeId node) const {
  if (owed_ && !propagated_) Propagate();
  return labels_.Labels(node.index());
}

Outcome Network::Search(Budget& budget) {
  const Mark before = Save();
  const Outcome outcome = Propagate() ? FindWitness(budget) : Outcome::kNone;
  if (outcome == Outcome::kNone) Undo(before);
  return outcome;
}

// Searches independent components one by one, and only those in which the last labeling does not
// hold.
Outcome Network::FindWitness(Budget& budget) {
  Labeling found = witness_;
  for (int node = 0; node < node_count(); ++node) {
    if (labels_.count(node) == 1) found.labels[node] = labels_.First(node);
  }
  for (const std::vector<int>& component : OpenComponents(labels_, consistency_)) {
    if (HoldsWithin(component)) continue;
    const LabelStore::Mark mark = labels_.Save();
    const Outcome outcome = LabelComponent(component, found, budget);
    labels_.Undo(mark);
    if (outcome != Outcome::kFound) return outcome;
  }
  witness_ = std::move(found);
  witness_holds_ = true;
  return Outcome::kFound;
}

Outcome Network::LabelComponent(std::span<const int> component, Labeling& found, Budget& budget) {
  const PendantTrees pendant_trees = PendantTreesOf(component, labels_, consistency_);
  const Outcome outcome =
      pendant_trees.core.empty() ? Outcome::kFound : SearchCore(pendant_trees.core, budget);
  if (outcome != Outcome::kFound) return outcome;
  for (int node : pendant_trees.core) found.labels[node] = labels_.First(node);
  LabelPendantTrees(pendant_trees, found);
  return outcome;
}

Outcome Network::SearchCore(const std::vector<int>& core, Budget& budget) {
  TreeSearch search(labels_, consistency_, counters_, core, NodeOrder::kConflictWeighted);
  search.Prefer(witness_.labels);
  if (!FitsLanes(core, labels_)) return search.Any(budget);
  if (const auto outcome = search.AnyWithin(kShortSearch, budget)) return *outcome;
  return AnyInLanes(core, labels_, consistency_, witness_.labels, counters_, budget);
}

void Network::LabelPendantTrees(const PendantTrees& pendant_trees, Labeling& found) const {
  for (auto hanging = pendant_trees.hanging.rbegin(); hanging != pendant_trees.hanging.rend();
       ++hanging) {
    const std::span<const Word> words = labels_.Words(hanging->node);
    const auto fits = [&](std::size_t word) {
      return hanging->parent == HangingNode::kNoParent
                 ? words[word]
                 : words[word] &
                       hanging->supported[found.labels[hanging->parent] * words.size() + word];
    };
    std::size_t word = 0;
    while (fits(word) == 0) ++word;
    found.labels[hanging->node] =
        static_cast<Label>(word) * kWordBits + std::countr_zero(fits(word));
  }
}

// Returns true if the witness holds with another label of this node, and changes that label. Only
// the last constraint may be violated.
bool Network::Mend(NodeId node) {
  const std::span<const Word> words = labels_.Words(node.index());
  for (std::size_t word = 0; word < words.size(); ++word) {
    Word fits = words[word];
    for (const ArcConsistency::Direction& direction : consistency_.at(node.index())) {
      fits &= direction.supports[witness_.labels[direction.revised] * words.size() + word];
    }
    if (fits == 0) continue;
    witness_.labels[node.index()] = static_cast<Label>(word) * kWordBits + std::countr_zero(fits);
    witness_holds_ = true;
    return true;
  }
  return false;
}

bool Network::HoldsWithin(std::span<const int> component) const {
  const bool labels_hold = std::all_of(component.begin(), component.end(), [&](int node) {
    const Label label = witness_.labels[node];
    return label != TreeSearch::kNoLabel && labels_.Contains(node, label);
  });
  // Arcs that leave the component lead to nodes with one label, and every label of the component is
  // consistent with it.
  const auto arc_holds = [&](const ArcConsistency::Direction& direction) {
    const Arc& arc = arcs_[direction.arc];
    return labels_.count(direction.revised) == 1 ||
           arc.relation->Allows(witness_[arc.a], witness_[arc.b]);
  };
  return labels_hold && std::all_of(component.begin(), component.end(), [&](int node) {
           for (const ArcConsistency::Direction& direction : consistency_.at(node)) {
             if (!arc_holds(direction)) return false;
           }
           return true;
         });
}

Network::Mark Network::Save() {
  return {.nodes = node_count(),
          .arcs = static_cast<int>(arcs_.size()),
          .labels = labels_.Save(),
          .propagated = propagated_,
          .owed = owed_};
}

void Network::Undo(const Mark& mark) {
  labels_.Undo(mark.labels);
  while (std::ssize(arcs_) > mark.arcs) {
    const Arc& arc = arcs_.back();
    if (arc.a != arc.b) consistency_.RemoveLastArc(arc.a.index(), arc.b.index());
    arcs_.pop_back();
  }
  while (node_count() > mark.nodes) {
    consistency_.RemoveLastNode();
    labels_.RemoveLastNode();
  }
  witness_.labels.resize(mark.nodes);
  propagated_ = mark.propagated;
  owed_ = mark.owed;
  consistency_.ClearQueue();
  if (!propagated_) {
    for (int node = 0; node < node_count(); ++node) consistency_.Enqueue(node);
  }
}

bool Network::Satisfies(const Labeling& labeling) const {
  if (std::ssize(labeling.labels) != node_count()) return false;
  for (int node = 0; node < node_count(); ++node) {
    if (!labels_.Labels(node).contains(labeling.labels[node])) return false;
  }
  return std::all_of(arcs_.begin(), arcs_.end(), [&](const Arc& arc) {
    return arc.relation->Allows(labeling[arc.a], labeling[arc.b]);
  });
}

void Network::CheckNode(NodeId node) const {
  ASSAY_CHECK(node.index() >= 0 && node.index() < node_count(), "node {} of {}", node.index(),
              node_count());
}

}  // namespace assay::network
