#pragma once

#include <memory>
#include <vector>

#include "planner/base/budget.h"
#include "planner/base/outcome.h"
#include "planner/network/constraint_network/counters.h"
#include "planner/network/constraint_network/labeling.h"
#include "planner/network/constraint_network/network.h"

namespace assay::network {

struct SearchOptions {
  // The nodes to branch on first, in this order; the others follow by number. Labelings then come
  // in lexicographic order of their labels in this order of nodes, so that labelings which differ
  // only in the last nodes follow each other. If empty, the order learns from failures.
  std::vector<NodeId> order;
};

// Enumerates the labelings of a network, each exactly once. The order depends only on the network
// and the options. The object keeps a copy of the network, so the original may change or be
// destroyed.
class Labelings {
 public:
  explicit Labelings(const Network& network, const SearchOptions& options = {});
  ~Labelings();
  Labelings(Labelings&&) noexcept;
  Labelings& operator=(Labelings&&) noexcept;

  // kFound: labeling() is the next one. kNone: there are no more. kBudget: not known yet; a call
  // with another budget continues. Takes one unit of the budget for each node of the search tree.
  Outcome Next(Budget& budget);
  Outcome Next();

  const Labeling& labeling() const;  // the last one found
  const Counters& counters() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

struct FirstLabeling {
  Outcome outcome = Outcome::kNone;
  Labeling labeling;  // only for kFound
  Counters counters;
};

// Returns any labeling of the network, or the lexicographically first one if the options give an
// order.
FirstLabeling First(const Network& network, const SearchOptions& options, Budget& budget);

struct AllLabelings {
  Outcome outcome = Outcome::kNone;  // kBudget: there may be more than are listed
  std::vector<Labeling> labelings;
  Counters counters;
};

AllLabelings All(const Network& network, const SearchOptions& options, Budget& budget);

}  // namespace assay::network
