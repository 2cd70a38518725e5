#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "planner/base/budget.h"
#include "planner/base/outcome.h"
#include "planner/network/network/arc_consistency.h"
#include "planner/network/network/counters.h"
#include "planner/network/network/label_store.h"
#include "planner/network/network/labeling.h"
#include "planner/network/search/nodes_by_count.h"

namespace assay::network {

// Depth-first search that takes from a node's neighbours what the label chosen for it does not
// support, and propagates nothing further (Haralick and Elliott 1980). Nodes with the fewest labels
// come first, of those the last one changed. Where labelings are many it goes straight to one, and
// needs no more than a look at each arc.
class ForwardChecking {
 public:
  // Whether every label set has one word, and a label in it.
  static bool Fits(const LabelStore& labels);

  // Of a network that fits.
  ForwardChecking(const LabelStore& labels, const ArcConsistency& arcs, Counters& counters);

  // Any labeling. Empty when the limit of wipe-outs is exceeded. Once for an object.
  std::optional<Outcome> Any(std::int64_t wipe_out_limit, Budget& budget);

  Labeling labeling() const;  // at kFound

 private:
  struct Decision {
    int node;
    Word before;        // its labels
    Word untried;       // of them
    std::size_t trail;  // the length of trail_ before
  };
  struct Change {
    int node;
    Word before;
  };

  void OpenDecision();
  bool CloseDecision();
  bool TryNextLabel();
  bool TakeUnsupported(int node, Label label);
  void Undo(std::size_t trail);
  void Replace(int node, Word labels);

  const ArcConsistency& arcs_;
  Counters& counters_;
  std::vector<Word> labels_;  // by node
  NodesByCount open_;
  std::vector<Decision> decisions_;
  std::vector<Change> trail_;
};

}  // namespace assay::network
