#include "planner/network/labeling/forward_checking.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/planner/network/random_networks.h"

namespace assay::network::forward_checking_test {
namespace {

constexpr std::int64_t kNoLimit = std::numeric_limits<std::int64_t>::max();

TEST(ForwardChecking, DecidesAsTheOracleDoes) {
  int found = 0, none = 0;
  for (int seed = 0; seed < 2000; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream random(seed, "forward-checking");
    const NetworkWorkload workload = RandomSmallNetwork(random);
    const Network network = workload.Build();
    if (!ForwardChecking::Fits(network.label_store())) continue;
    Counters counters;
    ForwardChecking search(network.label_store(), network.arc_consistency(), counters);
    Budget budget(kNoLimit);
    const auto outcome = search.Any(kNoLimit, budget);
    if (oracle::LabelingsByBacktracking(workload.nodes, workload.arcs).empty()) {
      ASSERT_EQ(outcome, Outcome::kNone);
      ++none;
    } else {
      ASSERT_EQ(outcome, Outcome::kFound);
      ASSERT_TRUE(oracle::Holds(workload.nodes, workload.arcs, search.labeling()));
      ++found;
    }
    ASSERT_EQ(budget.spent(), counters.visited);
  }
  EXPECT_GT(found, 500);
  EXPECT_GT(none, 100);
}

// If forward checking alone decides, no second label is tried: every node is visited once.
TEST(ForwardChecking, GoesStraightToALabelingWhereAllAgree) {
  RandomStream random(1, "straight");
  const NetworkWorkload workload =
      workloads::RandomTree({.nodes = 50, .labels = 6, .forbidden = 0}, random);
  const Network network = workload.Build();
  Counters counters;
  ForwardChecking search(network.label_store(), network.arc_consistency(), counters);
  Budget budget(kNoLimit);
  ASSERT_EQ(search.Any(0, budget), Outcome::kFound);
  EXPECT_EQ(counters.visited, 50);
  EXPECT_EQ(counters.revisions, 2 * 49) << "each arc from both ends";
}

// Three different nodes share two labels, so no label of the first node has a labeling.
class ThreeDifferentOfTwo : public testing::Test {
 protected:
  ThreeDifferentOfTwo() {
    for (int node = 0; node < 3; ++node) network.AddNode(LabelSet::All(2));
    for (int node = 0; node < 3; ++node) {
      network.AddArc(NodeId(node), NodeId((node + 1) % 3),
                     Relation::Where(2, 2, std::not_equal_to<Label>()));
    }
  }
  std::optional<Outcome> Any(std::int64_t wipe_out_limit, std::int64_t visits) {
    ForwardChecking search(network.label_store(), network.arc_consistency(), counters);
    Budget budget(visits);
    return search.Any(wipe_out_limit, budget);
  }
  Network network;
  Counters counters;
};

TEST_F(ThreeDifferentOfTwo, IsRefutedByTwoWipeOuts) {
  EXPECT_EQ(Any(2, 100), Outcome::kNone);
  EXPECT_EQ(counters.wipe_outs, 2);
}
TEST_F(ThreeDifferentOfTwo, IsNotDecidedWithFewer) { EXPECT_EQ(Any(0, 100), std::nullopt); }
TEST_F(ThreeDifferentOfTwo, IsNotDecidedByASpentBudget) { EXPECT_EQ(Any(2, 1), Outcome::kBudget); }

TEST(ForwardChecking, FitsSetsOfOneWordThatAreNotEmpty) {
  Network network;
  EXPECT_TRUE(ForwardChecking::Fits(network.label_store()));
  network.AddNode(LabelSet::All(kWordBits));
  EXPECT_TRUE(ForwardChecking::Fits(network.label_store()));
  Network wide = network, empty = network;
  wide.AddNode(LabelSet::All(kWordBits + 1));
  EXPECT_FALSE(ForwardChecking::Fits(wide.label_store()));
  empty.AddNode(LabelSet::None(3));
  EXPECT_FALSE(ForwardChecking::Fits(empty.label_store()));
}

}  // namespace
}  // namespace assay::network::forward_checking_test
