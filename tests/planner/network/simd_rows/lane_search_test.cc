#include "planner/network/simd_rows/lane_search.h"

#include <gtest/gtest.h>

#include <limits>
#include <numeric>
#include <optional>

#include "planner/network/labeling/search.h"
#include "planner/network/labeling/tree_search.h"
#include "tests/planner/network/random_networks.h"

namespace assay::network::lane_search_test {
namespace {

constexpr std::int64_t kNoLimit = std::numeric_limits<std::int64_t>::max();

struct Answer {
  Outcome outcome;
  Labeling labeling;
  Counters counters;
};

// Searches over all nodes after propagation. Returns none if propagation decides, or if the network
// does not fit.
std::optional<Answer> Search(const NetworkWorkload& workload, Budget& budget) {
  const Network network = workload.Build();
  LabelStore labels = network.label_store();
  ArcConsistency arcs = network.arc_consistency();
  std::vector<int> scope(labels.node_count());
  std::iota(scope.begin(), scope.end(), 0);
  for (int node : scope) {
    if (labels.count(node) == 0) return std::nullopt;
  }
  Answer answer = {};
  if (!arcs.Propagate(labels, answer.counters) || !FitsLanes(scope, labels)) return std::nullopt;
  const std::vector<Label> preferred(labels.node_count(), TreeSearch::kNoLabel);
  answer.outcome = AnyInLanes(scope, labels, arcs, preferred, answer.counters, budget);
  if (answer.outcome != Outcome::kFound) return answer;
  for (int node : scope) {
    EXPECT_EQ(labels.count(node), 1);
    answer.labeling.labels.push_back(labels.First(node));
  }
  return answer;
}

std::optional<Answer> Search(const NetworkWorkload& workload) {
  Budget budget(kNoLimit);
  return Search(workload, budget);
}

TEST(LaneSearch, DecidesSmallNetworksAsTheOracleDoes) {
  int found = 0, none = 0;
  for (int seed = 0; seed < 3000; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream random(seed, "lane-search");
    // Arc consistency decides most small networks without a labeling. Complete networks are an
    // exception.
    const NetworkWorkload workload =
        seed % 2 == 0 ? RandomSmallNetwork(random)
                      : workloads::RandomNetwork(
                            {.nodes = 6, .labels = 4, .arcs = 15, .forbidden = 6}, random);
    const auto answer = Search(workload);
    if (!answer.has_value()) continue;
    if (oracle::LabelingsByBacktracking(workload.nodes, workload.arcs).empty()) {
      ASSERT_EQ(answer->outcome, Outcome::kNone);
      ++none;
    } else {
      ASSERT_EQ(answer->outcome, Outcome::kFound);
      ASSERT_TRUE(oracle::Holds(workload.nodes, workload.arcs, answer->labeling));
      ++found;
    }
  }
  EXPECT_GT(found, 500);
  EXPECT_GT(none, 100);
}

// The networks need SIMD rows of 16, 32 and 64 bits, several blocks, and restarts.
TEST(LaneSearch, DecidesNetworksNearTheThresholdAsAnotherSearchDoes) {
  struct Model {
    int labels, forbidden;
  };
  int found = 0, restarted = 0;
  for (const Model& model : {Model{10, 37}, {16, 108}, {17, 124}, {33, 545}}) {
    for (int seed = 0; seed < 12; ++seed) {
      SCOPED_TRACE(testing::Message() << model.labels << " labels, seed " << seed);
      RandomStream random(seed, "threshold");
      const int nodes = model.labels == 10 ? 30 : 14;
      const NetworkWorkload workload = workloads::RandomNetwork(
          {.nodes = nodes, .labels = model.labels, .arcs = nodes * 5, .forbidden = model.forbidden},
          random);
      const auto answer = Search(workload);
      ASSERT_TRUE(answer.has_value());
      ASSERT_EQ(answer->outcome, Labelings(workload.Build()).Next());
      if (answer->counters.wipe_outs > TreeSearch::kFirstWipeOutLimit) ++restarted;
      if (answer->outcome != Outcome::kFound) continue;
      ASSERT_TRUE(oracle::Holds(workload.nodes, workload.arcs, answer->labeling));
      ++found;
    }
  }
  EXPECT_GT(found, 5);
  EXPECT_LT(found, 43);
  EXPECT_GT(restarted, 3);
}

TEST(LaneSearch, SpentBudgetsAreReported) {
  RandomStream random(3, "spent");
  const NetworkWorkload workload =
      workloads::RandomNetwork({.nodes = 20, .labels = 10, .arcs = 95, .forbidden = 37}, random);
  Budget budget(3);
  EXPECT_EQ(Search(workload, budget)->outcome, Outcome::kBudget);
  EXPECT_EQ(budget.spent(), 3);
}

TEST(LaneSearch, DoesNotFitWideOrVeryManySets) {
  const auto fits = [](int nodes, int labels) {
    LabelStore store;
    for (int node = 0; node < nodes; ++node) store.AddNode(LabelSet::All(labels));
    std::vector<int> scope(nodes);
    std::iota(scope.begin(), scope.end(), 0);
    return FitsLanes(scope, store);
  };
  EXPECT_TRUE(fits(40, kWordBits));
  EXPECT_FALSE(fits(2, kWordBits + 1));
  EXPECT_FALSE(fits(2000, 5)) << "40 MB";
}

}  // namespace
}  // namespace assay::network::lane_search_test
