#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "planner/base/budget.h"
#include "planner/base/outcome.h"
#include "planner/network/constraint_network/arc_consistency.h"
#include "planner/network/constraint_network/counters.h"
#include "planner/network/constraint_network/label_store.h"
#include "planner/network/constraint_network/labeling.h"
#include "planner/network/labeling/nodes_by_count.h"

namespace assay::network {

// Depth-first search that removes from the neighbours of a node the labels that the chosen label
// does not support, and propagates no further (Haralick and Elliott 1980). It branches first on a
// node with the fewest labels. If there are several such nodes, it branches on the one that changed
// last. If there are many labelings, it leads straight to one and examines each arc about once.
class ForwardChecking {
 public:
  // Returns true if every label set fits in one word and is not empty.
  static bool Fits(const LabelStore& labels);

  // The label sets must satisfy Fits.
  ForwardChecking(const LabelStore& labels, const ArcConsistency& arcs, Counters& counters);

  // Searches for any labeling. Returns nothing when the limit of wipe-outs is exceeded. Call it
  // only once for an object.
  std::optional<Outcome> Any(std::int64_t wipe_out_limit, Budget& budget);

  Labeling labeling() const;  // available only after kFound

 private:
  struct Decision {
    int node;
    Word before;        // its labels before the decision
    Word untried;       // labels that have not been tried
    std::size_t trail;  // the length of trail_ before the decision
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
  std::vector<Word> labels_;  // indexed by node
  NodesByCount open_;
  std::vector<Decision> decisions_;
  std::vector<Change> trail_;
};

}  // namespace assay::network
