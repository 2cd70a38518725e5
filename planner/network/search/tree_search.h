#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "planner/base/budget.h"
#include "planner/base/outcome.h"
#include "planner/network/network/arc_consistency.h"
#include "planner/network/network/counters.h"
#include "planner/network/network/label_store.h"
#include "planner/network/search/node_order.h"

namespace assay::network {

// Depth-first search with arc consistency maintained (Sabin and Freuder 1994) and two branches at
// each node: a label is chosen, then excluded. It works on label sets that are arc consistent and
// leaves them to the caller, who undoes to a mark set before.
class TreeSearch {
 public:
  // Searches the nodes of `scope` only; all that an arc joins to one of them is in the scope, too,
  // or has one label.
  TreeSearch(LabelStore& labels, ArcConsistency& arcs, Counters& counters, std::vector<int> scope,
             NodeOrder order);

  // For each node of the network the label to try first, or kNoLabel. As the search goes on, the
  // last label that did not fail at once takes its place (not with NodeOrder::kGiven, which takes
  // labels in order).
  static constexpr Label kNoLabel = -1;
  void Prefer(const std::vector<Label>& preferred) { preferred_ = preferred; }

  // Goes on to the next labeling of the scope. At kFound each node of the scope has one label, at
  // kNone there are no more labelings, at kBudget the search can go on with another budget. With
  // NodeOrder::kGiven labelings come in lexicographic order.
  Outcome Next(Budget& budget);

  // Any labeling of the scope. Starts anew, with the weights learned, when a growing limit of
  // wipe-outs is reached (Walsh 1999).
  Outcome Any(Budget& budget);
  static constexpr std::int64_t kFirstWipeOutLimit = 200;
  static constexpr double kWipeOutLimitGrowth = 2;

  // Any labeling of the scope. Empty when the limit of wipe-outs is reached: label sets are then as
  // at first, but for labels that were refuted.
  std::optional<Outcome> AnyWithin(std::int64_t wipe_out_limit, Budget& budget);

 private:
  struct Decision {
    LabelStore::Mark mark;
    int node;
    Label label;
    int open;  // the length of open_ before
  };

  static constexpr std::int64_t kUnlimited = -1;
  // Empty when the limit of wipe-outs is reached.
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
