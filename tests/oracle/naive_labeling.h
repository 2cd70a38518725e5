#pragma once

#include <optional>
#include <vector>

#include "planner/network/constraint_network/label_set.h"
#include "planner/network/constraint_network/labeling.h"
#include "planner/network/constraint_network/network.h"

// Slow and plain answers about binary constraint networks. The only functions of the library that
// they use are LabelSet::contains and Relation::Allows.
namespace assay::oracle {

using network::Arc;
using network::Label;
using network::Labeling;
using network::LabelSet;

inline bool Holds(const std::vector<LabelSet>& nodes, const std::vector<Arc>& arcs,
                  const Labeling& labeling) {
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (!nodes[i].contains(labeling.labels[i])) return false;
  }
  for (const Arc& arc : arcs) {
    if (!arc.relation->Allows(labeling[arc.a], labeling[arc.b])) return false;
  }
  return true;
}

// Returns all labelings, found by trying every combination of labels. They are in lexicographic
// order of the node numbers.
inline std::vector<Labeling> LabelingsByEnumeration(const std::vector<LabelSet>& nodes,
                                                    const std::vector<Arc>& arcs) {
  std::vector<Labeling> found;
  Labeling labeling{std::vector<Label>(nodes.size(), 0)};
  for (const LabelSet& labels : nodes) {
    if (labels.empty()) return found;
  }
  while (true) {
    if (Holds(nodes, arcs, labeling)) found.push_back(labeling);
    std::size_t i = nodes.size();
    while (i > 0 && ++labeling.labels[i - 1] == nodes[i - 1].size()) labeling.labels[--i] = 0;
    if (i == 0) return found;
  }
}

// Chronological backtracking in the order of the node numbers, as in Spar.
class Backtracking {
 public:
  Backtracking(const std::vector<LabelSet>& nodes, const std::vector<Arc>& arcs)
      : nodes_(nodes), arcs_(arcs), labeling_{std::vector<Label>(nodes.size(), 0)} {}

  std::vector<Labeling> All() {
    Extend(0);
    return std::move(found_);
  }

 private:
  void Extend(int node) {
    if (node == static_cast<int>(nodes_.size())) {
      found_.push_back(labeling_);
      return;
    }
    for (Label label = 0; label < nodes_[node].size(); ++label) {
      labeling_.labels[node] = label;
      if (nodes_[node].contains(label) && AgreesWithEarlier(node)) Extend(node + 1);
    }
  }

  bool AgreesWithEarlier(int node) const {
    for (const Arc& arc : arcs_) {
      const int a = arc.a.index(), b = arc.b.index();
      const bool ends_here = (a == node && b <= node) || (b == node && a <= node);
      if (ends_here && !arc.relation->Allows(labeling_[arc.a], labeling_[arc.b])) return false;
    }
    return true;
  }

  const std::vector<LabelSet>& nodes_;
  const std::vector<Arc>& arcs_;
  Labeling labeling_;
  std::vector<Labeling> found_;
};

inline std::vector<Labeling> LabelingsByBacktracking(const std::vector<LabelSet>& nodes,
                                                     const std::vector<Arc>& arcs) {
  return Backtracking(nodes, arcs).All();
}

// Returns the arc-consistent label sets by AC-1 (Mackworth 1977), which revises all arcs until
// nothing changes. An arc from a node to itself pairs each label with itself. Returns nothing at a
// wipe-out.
inline std::optional<std::vector<LabelSet>> ArcConsistentByRepetition(
    std::vector<LabelSet> nodes, const std::vector<Arc>& arcs) {
  const auto supported = [&](const Arc& arc, network::NodeId end, Label label) {
    if (arc.a == arc.b) return arc.relation->Allows(label, label);
    const LabelSet& others = nodes[(end == arc.a ? arc.b : arc.a).index()];
    for (Label other = 0; other < others.size(); ++other) {
      const bool allowed =
          end == arc.a ? arc.relation->Allows(label, other) : arc.relation->Allows(other, label);
      if (others.contains(other) && allowed) return true;
    }
    return false;
  };
  bool changed = true;
  while (changed) {
    changed = false;
    for (const Arc& arc : arcs) {
      for (network::NodeId end : {arc.a, arc.b}) {
        LabelSet& labels = nodes[end.index()];
        for (Label label = 0; label < labels.size(); ++label) {
          if (!labels.contains(label) || supported(arc, end, label)) continue;
          labels.erase(label);
          changed = true;
        }
      }
    }
  }
  for (const LabelSet& labels : nodes) {
    if (labels.empty()) return std::nullopt;
  }
  return nodes;
}

}  // namespace assay::oracle
