#include "planner/network/labeling/pendant_trees.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

#include "planner/network/labeling/component.h"
#include "tests/planner/network/random_networks.h"

namespace assay::network::fringe_test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

PendantTrees PendantTreesOfWorkload(const NetworkWorkload& workload) {
  const Network network = workload.Build();
  std::vector<int> nodes(workload.nodes.size());
  std::iota(nodes.begin(), nodes.end(), 0);
  return PendantTreesOf(nodes, network.label_store(), network.arc_consistency());
}

NetworkWorkload Joined(int nodes, std::initializer_list<std::pair<int, int>> ends) {
  NetworkWorkload workload;
  workload.nodes.assign(nodes, LabelSet::All(2));
  for (const auto& [a, b] : ends) {
    workload.arcs.push_back(
        {NodeId(a), NodeId(b), Relation::Where(2, 2, std::not_equal_to<Label>())});
  }
  return workload;
}

TEST(PendantTrees, IsTheWholeOfATree) {
  RandomStream random(1, "fringe");
  const PendantTrees pendant_trees = PendantTreesOfWorkload(
      workloads::RandomTree({.nodes = 40, .labels = 3, .forbidden = 2}, random));
  EXPECT_THAT(pendant_trees.core, IsEmpty());
  EXPECT_THAT(pendant_trees.hanging, SizeIs(40));
  EXPECT_EQ(pendant_trees.hanging.back().parent, HangingNode::kNoParent);
}

TEST(PendantTrees, LeavesACycleAndWhatLiesBetweenCycles) {
  const PendantTrees pendant_trees = PendantTreesOfWorkload(
      Joined(9, {{0, 1}, {1, 2}, {2, 0}, {2, 3}, {3, 4}, {4, 5}, {5, 6}, {6, 4}, {3, 7}, {7, 8}}));
  EXPECT_THAT(pendant_trees.core, ElementsAre(0, 1, 2, 3, 4, 5, 6));
  ASSERT_THAT(pendant_trees.hanging, SizeIs(2));
  EXPECT_EQ(pendant_trees.hanging[0].node, 8);
  EXPECT_EQ(pendant_trees.hanging[0].parent, 7);
  EXPECT_EQ(pendant_trees.hanging[1].parent, 3);
}

TEST(PendantTrees, TakesParallelArcsForACycle) {
  EXPECT_THAT(PendantTreesOfWorkload(Joined(3, {{0, 1}, {1, 0}, {1, 2}})).core, ElementsAre(0, 1));
}

// For trees, and for trees that hang from a cycle, the search gives the answers of the oracle.
TEST(PendantTrees, IsLabeledWithoutSearchWhereverTheRestIs) {
  int found = 0, hanging = 0;
  for (int seed = 0; seed < 500; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream random(seed, "fringe");
    NetworkWorkload workload =
        workloads::RandomTree({.nodes = 7, .labels = 3, .forbidden = 2 + random.Index(4)}, random);
    if (random.Index(2) == 0) {
      workload.arcs.push_back({NodeId(0), NodeId(3), RandomRelation(3, 3, 0.5, random)});
    }
    Network network = workload.Build();
    hanging += static_cast<int>(PendantTreesOfWorkload(workload).hanging.size());
    const bool consistent = !oracle::LabelingsByBacktracking(workload.nodes, workload.arcs).empty();
    ASSERT_EQ(network.Decide(), consistent ? Outcome::kFound : Outcome::kNone);
    if (!consistent) continue;
    ++found;
    ASSERT_TRUE(oracle::Holds(workload.nodes, workload.arcs, *network.witness()));
  }
  EXPECT_GT(found, 100);
  EXPECT_GT(hanging, 1000);
}

}  // namespace
}  // namespace assay::network::fringe_test
