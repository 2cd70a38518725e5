#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "planner/base/budget.h"
#include "planner/base/outcome.h"
#include "planner/network/constraint_network/arc_consistency.h"
#include "planner/network/constraint_network/counters.h"
#include "planner/network/constraint_network/label_store.h"
#include "planner/network/labeling/node_order.h"

namespace assay::network {

// Depth-first search that maintains arc consistency (Sabin and Freuder 1994). It has two branches
// at each node: a label is chosen, then excluded. The label sets must be arc consistent at the
// start. The search does not restore them; the caller undoes to a mark that was set before.
class TreeSearch {
 public:
  // Searches only the nodes of `scope`. A node that an arc joins to the scope must be in the scope
  // or have one label.
  TreeSearch(LabelStore& labels, ArcConsistency& arcs, Counters& counters, std::vector<int> scope,
             NodeOrder order);

  // Sets, for each node of the network, the label to try first, or kNoLabel. During the search it
  // is replaced by the last label that did not fail at once. NodeOrder::kGiven does not replace it
  // and tries labels in order.
  static constexpr Label kNoLabel = -1;
  void Prefer(const std::vector<Label>& preferred) { preferred_ = preferred; }

  // Continues to the next labeling of the scope. At kFound each node of the scope has one label. At
  // kNone there are no more labelings. At kBudget the search can continue with another budget. With
  // NodeOrder::kGiven labelings come in lexicographic order.
  Outcome Next(Budget& budget);

  // Searches for any labeling of the scope. It restarts with the learned weights when a limit of
  // wipe-outs is reached, and the limit grows (Walsh 1999).
  Outcome Any(Budget& budget);
  static constexpr std::int64_t kFirstWipeOutLimit = 200;
  static constexpr double kWipeOutLimitGrowth = 2;

  // Searches for any labeling of the scope. Returns nothing when the limit of wipe-outs is reached.
  // The label sets are then as at the start, except for labels that were refuted.
  std::optional<Outcome> AnyWithin(std::int64_t wipe_out_limit, Budget& budget);

 private:
  struct Decision {
    LabelStore::Mark mark;
    int node;
    Label label;
    int open;  // the length of open_ before the decision
  };

  static constexpr std::int64_t kUnlimited = -1;
  // Returns nothing when the limit of wipe-outs is reached.
  std::optional<Outcome> Advance(Budget& budget, std::int64_t wipe_out_limit);
  bool Descend(int node);
  bool Backtrack();
  bool Propagate();
  void Rewind();

  int ChooseNode();
  Label ChooseLabel(int node) const;

  LabelStore& labels_;
  ArcConsistency& arcs_;
  Counters& counters_;
  OpenNodes open_;
  NodeOrder order_;
  std::vector<Label> preferred_;

  std::vector<Decision> decisions_;
  enum class Place { kInside, kAtLabeling, kExhausted } place_ = Place::kInside;
};

}  // namespace assay::network
