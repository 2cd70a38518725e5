#include "planner/network/labeling/node_order.h"

#include <gtest/gtest.h>

#include <numeric>

#include "tests/planner/network/random_networks.h"

namespace assay::network::node_order_test {
namespace {

// Computes the ratio of dom/wdeg from its definition: the weight of the arcs to open nodes over the
// number of labels.
double Ratio(int node, const LabelStore& labels, const ArcConsistency& arcs) {
  double weight = 0;
  for (const ArcConsistency::Direction& direction : arcs.at(node)) {
    if (labels.count(direction.revised) > 1)
      weight += static_cast<double>(arcs.weight(direction.arc));
  }
  return weight / labels.count(node);
}

void ExpectTheHeaviest(OpenNodes& open, const LabelStore& labels, const ArcConsistency& arcs) {
  open.Update();
  double best = -1;
  for (int node = 0; node < labels.node_count(); ++node) {
    if (labels.count(node) > 1) best = std::max(best, Ratio(node, labels, arcs));
  }
  const int heaviest = open.Heaviest();
  ASSERT_EQ(heaviest < 0, best < 0);
  if (heaviest < 0) return;
  ASSERT_DOUBLE_EQ(Ratio(heaviest, labels, arcs), best);
}

// The weights stay right through random assignments, wipe-outs and undoing.
TEST(OpenNodes, KeepsTheWeightsThatAreSummedAnew) {
  for (int seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream random(seed, "open-nodes");
    const Network network =
        workloads::RandomNetwork({.nodes = 8, .labels = 4, .arcs = 16, .forbidden = 5}, random)
            .Build();
    LabelStore labels = network.label_store();
    ArcConsistency arcs = network.arc_consistency();
    Counters counters;
    if (!arcs.Propagate(labels, counters)) continue;
    std::vector<int> scope(8);
    std::iota(scope.begin(), scope.end(), 0);
    OpenNodes open(scope, labels, arcs);
    std::vector<std::pair<LabelStore::Mark, int>> marks;
    for (int step = 0; step < 60; ++step) {
      ASSERT_NO_FATAL_FAILURE(ExpectTheHeaviest(open, labels, arcs));
      const int node = open.Heaviest();
      bool consistent = false;
      if (node >= 0 && random.Index(3) > 0) {
        marks.emplace_back(labels.Save(), open.count());
        labels.Assign(node, labels.First(node));
        arcs.Enqueue(node);
        consistent = arcs.Propagate(labels, counters);
        if (!consistent) open.Blame(arcs.last_wipe_out());
      }
      if (consistent || marks.empty()) continue;
      labels.Undo(marks.back().first);
      open.Reopen(marks.back().second);
      marks.pop_back();
    }
  }
}

}  // namespace
}  // namespace assay::network::node_order_test
