#include "planner/network/labeling/search.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "planner/network/labeling/count.h"
#include "tests/planner/network/random_networks.h"

namespace assay::network::search_test {
namespace {

Budget Enough() { return Budget(std::numeric_limits<std::int64_t>::max()); }

std::vector<Labeling> AllOf(const Network& network, const SearchOptions& options = {}) {
  Budget budget = Enough();
  return All(network, options, budget).labelings;
}

std::uint64_t CountOf(const Network& network) {
  Budget budget = Enough();
  return Count(network, budget).count;
}

std::vector<NodeId> RandomOrder(int nodes, int length, RandomStream& random) {
  std::vector<NodeId> order;
  for (int node = 0; node < nodes; ++node) order.emplace_back(node);
  for (int i = nodes; i > 1; --i) std::swap(order[i - 1], order[random.Index(i)]);
  order.resize(length);
  return order;
}

template <class Generator>
void ExpectTheOraclesLabelings(const Generator& generator, int trials) {
  int consistent = 0;
  for (int seed = 0; seed < trials; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream random(seed, "labelings");
    const NetworkWorkload workload = generator(random);
    const Network network = workload.Build();
    const auto expected = oracle::LabelingsByBacktracking(workload.nodes, workload.arcs);
    if (!expected.empty()) ++consistent;
    std::vector<Labeling> all = AllOf(network);
    std::sort(all.begin(), all.end());
    ASSERT_EQ(all, expected);
    ASSERT_EQ(CountOf(network), expected.size());
    Budget budget = Enough();
    const FirstLabeling first = First(network, {}, budget);
    ASSERT_EQ(first.outcome, expected.empty() ? Outcome::kNone : Outcome::kFound);
    if (!expected.empty()) {
      ASSERT_TRUE(oracle::Holds(workload.nodes, workload.arcs, first.labeling));
    }
  }
  EXPECT_GT(consistent, trials / 10);
  EXPECT_LT(consistent, trials);
}

TEST(Search, FindsTheLabelingsOfSmallNetworks) {
  ExpectTheOraclesLabelings(RandomSmallNetwork, 3000);
}

TEST(Search, FindsTheLabelingsOfNetworksOfSeveralWords) {
  ExpectTheOraclesLabelings(RandomWideNetwork, 150);
}

TEST(Search, OraclesAgree) {
  for (int seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream random(seed, "oracles");
    const NetworkWorkload workload = RandomSmallNetwork(random);
    ASSERT_EQ(oracle::LabelingsByBacktracking(workload.nodes, workload.arcs),
              oracle::LabelingsByEnumeration(workload.nodes, workload.arcs));
  }
}

TEST(Search, LabelingsOfAGivenOrderComeInLexicographicOrder) {
  for (int seed = 0; seed < 500; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream random(seed, "given-order");
    const NetworkWorkload workload = RandomSmallNetwork(random);
    const int nodes = static_cast<int>(workload.nodes.size());
    const std::vector<NodeId> order = RandomOrder(nodes, 1 + random.Index(nodes), random);
    auto expected = oracle::LabelingsByBacktracking(workload.nodes, workload.arcs);
    std::stable_sort(expected.begin(), expected.end(), [&](const Labeling& a, const Labeling& b) {
      for (NodeId node : order) {
        if (a[node] != b[node]) return a[node] < b[node];
      }
      return false;
    });
    ASSERT_EQ(AllOf(workload.Build(), {.order = order}), expected);
    Budget budget = Enough();
    const FirstLabeling first = First(workload.Build(), {.order = order}, budget);
    ASSERT_EQ(first.outcome, expected.empty() ? Outcome::kNone : Outcome::kFound);
    if (!expected.empty()) {
      ASSERT_EQ(first.labeling, expected.front());
    }
  }
}

// A search that stops after each node gives the same labelings as an uninterrupted one.
TEST(Search, GoesOnAfterABudgetIsSpent) {
  for (int seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream random(seed, "budget");
    const Network network = RandomSmallNetwork(random).Build();
    Labelings in_one_go(network), in_steps(network);
    Outcome outcome;
    do {
      outcome = in_one_go.Next();
      Outcome step;
      do {
        Budget budget(1);
        step = in_steps.Next(budget);
      } while (step == Outcome::kBudget);
      ASSERT_EQ(step, outcome);
      if (outcome == Outcome::kFound) {
        ASSERT_EQ(in_one_go.labeling(), in_steps.labeling());
      }
    } while (outcome == Outcome::kFound);
    ASSERT_EQ(in_one_go.Next(), Outcome::kNone) << "none stays none";
    ASSERT_EQ(in_one_go.counters(), in_steps.counters());
  }
}

TEST(Search, LabelingsOutliveTheNetwork) {
  auto network = std::make_unique<Network>();
  network->AddNode(LabelSet::All(2));
  network->AddNode(LabelSet::All(2));
  network->AddArc(NodeId(0), NodeId(1),
                  Relation::Where(2, 2, [](Label a, Label b) { return a != b; }));
  Labelings labelings(*network, {.order = {NodeId(0)}});
  ASSERT_EQ(network->Restrict(NodeId(0), LabelSet::Of(2, {1})), Outcome::kFound);
  network.reset();
  ASSERT_EQ(labelings.Next(), Outcome::kFound);
  EXPECT_THAT(labelings.labeling().labels, testing::ElementsAre(0, 1));
  ASSERT_EQ(labelings.Next(), Outcome::kFound);
  EXPECT_THAT(labelings.labeling().labels, testing::ElementsAre(1, 0));
  EXPECT_EQ(labelings.Next(), Outcome::kNone);
}

TEST(Search, SpentBudgetsAreReported) {
  RandomStream random(3, "spent");
  const Network network =
      workloads::RandomNetwork({.nodes = 20, .labels = 10, .arcs = 95, .forbidden = 37}, random)
          .Build();
  Budget first_budget(3), all_budget(3), count_budget(3);
  EXPECT_EQ(First(network, {}, first_budget).outcome, Outcome::kBudget);
  EXPECT_EQ(All(network, {}, all_budget).outcome, Outcome::kBudget);
  EXPECT_EQ(Count(network, count_budget).outcome, Outcome::kBudget);
  EXPECT_EQ(first_budget.spent(), 3);
}

TEST(Search, AnEmptyNetworkHasTheEmptyLabeling) {
  EXPECT_THAT(AllOf(Network()), testing::ElementsAre(Labeling{}));
  EXPECT_EQ(CountOf(Network()), 1u);
}

TEST(Search, CountsDoNotDependOnNamesOfNodesAndLabels) {
  for (int seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream random(seed, "symmetry");
    const NetworkWorkload workload = RandomSmallNetwork(random);
    const int nodes = static_cast<int>(workload.nodes.size());
    const std::vector<NodeId> place = RandomOrder(nodes, nodes, random);
    NetworkWorkload renamed;
    renamed.nodes.resize(nodes);
    const auto mirrored = [](const LabelSet& labels, Label label) {
      return labels.size() - 1 - label;
    };
    for (int node = 0; node < nodes; ++node) {
      LabelSet& labels = renamed.nodes[place[node].index()];
      labels = LabelSet::None(workload.nodes[node].size());
      for (Label label : workload.nodes[node]) labels.insert(mirrored(labels, label));
    }
    for (const Arc& arc : workload.arcs) {  // the ends of the arcs are swapped, too
      const LabelSet &a = workload.nodes[arc.a.index()], &b = workload.nodes[arc.b.index()];
      const auto relation = Relation::Where(b.size(), a.size(), [&](Label row, Label column) {
        return arc.relation->Allows(mirrored(a, column), mirrored(b, row));
      });
      renamed.arcs.push_back({place[arc.b.index()], place[arc.a.index()], relation});
    }
    ASSERT_EQ(CountOf(renamed.Build()), CountOf(workload.Build()));
    ASSERT_EQ(AllOf(renamed.Build()).size(), CountOf(workload.Build()));
  }
}

// A cycle of n nodes has (c - 1)^n + (-1)^n (c - 1) colourings with c colours.
TEST(Count, KnowsTheColouringsOfCycles) {
  const auto different = Relation::Where(4, 4, [](Label a, Label b) { return a != b; });
  for (int n : {3, 4, 7, 20}) {
    Network network;
    for (int node = 0; node < n; ++node) network.AddNode(LabelSet::All(4));
    for (int node = 0; node < n; ++node) {
      network.AddArc(NodeId(node), NodeId((node + 1) % n), different);
    }
    std::uint64_t power = 1;
    for (int i = 0; i < n; ++i) power *= 3;
    EXPECT_EQ(CountOf(network), n % 2 == 0 ? power + 3 : power - 3) << n;
  }
}

// All nodes have the same label, so there are two labelings. The count must not recurse deeply.
TEST(Count, ReachesTheEndOfLongPaths) {
  const auto same = Relation::Where(2, 2, [](Label a, Label b) { return a == b; });
  Network network;
  for (int node = 0; node < 100'000; ++node) network.AddNode(LabelSet::All(2));
  for (int node = 1; node < 100'000; ++node) {
    network.AddArc(NodeId(node - 1), NodeId(node), same);
  }
  EXPECT_EQ(CountOf(network), 2);
}

TEST(Count, StopsAtManyLabelings) {
  Network network;
  for (int node = 0; node < 16; ++node) network.AddNode(LabelSet::All(16));
  EXPECT_EQ(CountOf(network), kManyLabelings);  // 2^64
  ASSERT_EQ(network.Restrict(NodeId(0), LabelSet::Of(16, {0})), Outcome::kFound);
  EXPECT_EQ(CountOf(network), std::uint64_t{1} << 60);
}

TEST(Count, KnowsTheQueens) {
  const int expected[] = {1, 1, 0, 0, 2, 10, 4, 40, 92};
  for (int n = 1; n <= 8; ++n) {
    Network network;
    for (int row = 0; row < n; ++row) network.AddNode(LabelSet::All(n));
    for (int b = 0; b < n; ++b) {
      for (int a = 0; a < b; ++a) {
        network.AddArc(NodeId(a), NodeId(b), Relation::Where(n, n, [&](Label x, Label y) {
                         return x != y && std::abs(x - y) != b - a;
                       }));
      }
    }
    EXPECT_EQ(CountOf(network), expected[n]) << n;
    EXPECT_EQ(AllOf(network).size(), expected[n]) << n;
  }
}

// The network of Spar's example (Hutchinson and Kak 1990, figure 9). The block is taken with
// grasp_2 at init_pos_1 and put down at pos_1. The peg is taken with grasp_1 at init_pos_2 and
// assembled to the block at pos_1. Label sets and pairs take the place of figure 10 of the paper.
// pos_1 is constrained to be the stable pose BP5 of the block.
class SparExample : public testing::Test {
 protected:
  SparExample() {
    init_pos_1 = network.AddNode(LabelSet::Of(6, {0}));
    pos_1 = network.AddNode(LabelSet::All(6));
    grasp_2 = network.AddNode(LabelSet::All(4));
    init_pos_2 = network.AddNode(LabelSet::Of(4, {2}));
    grasp_1 = network.AddNode(LabelSet::All(3));
  }

  static std::shared_ptr<const Relation> Pairs(int rows, int columns,
                                               const std::vector<LabelPair>& pairs) {
    return Relation::Allowing(rows, columns, pairs);
  }

  Network network;
  NodeId init_pos_1, pos_1, grasp_2, init_pos_2, grasp_1;
};

TEST_F(SparExample, IsATreeThatPropagationDecides) {
  const Label bp5 = 4;
  EXPECT_EQ(network.Restrict(pos_1, LabelSet::Of(6, {bp5})), Outcome::kFound);
  // A grasp is excluded if it reaches the block at the start but not at its destination.
  EXPECT_EQ(network.Post(grasp_2, init_pos_1, Pairs(4, 6, {{0, 0}, {1, 0}, {3, 0}, {2, 4}})),
            Outcome::kFound);
  EXPECT_EQ(network.Post(grasp_2, pos_1, Pairs(4, 6, {{0, 1}, {1, bp5}, {2, bp5}, {3, bp5}})),
            Outcome::kFound);
  EXPECT_EQ(network.Post(grasp_1, init_pos_2, Pairs(3, 4, {{0, 2}, {2, 2}, {1, 3}})),
            Outcome::kFound);
  EXPECT_EQ(network.Post(grasp_1, pos_1, Pairs(3, 6, {{1, bp5}, {2, bp5}, {0, 3}})),
            Outcome::kFound);
  EXPECT_EQ(network.labels(grasp_2), LabelSet::Of(4, {1, 3}));
  EXPECT_EQ(network.labels(grasp_1), LabelSet::Of(3, {2}));
  Budget nothing(0);  // a tree of arc-consistent nodes is counted without branching
  EXPECT_EQ(Count(network, nothing).count, 2u);
}

TEST_F(SparExample, RefusesAPoseThatNoGraspReaches) {
  ASSERT_EQ(network.Post(grasp_2, init_pos_1, Pairs(4, 6, {{0, 0}, {1, 0}})), Outcome::kFound);
  ASSERT_EQ(network.Post(grasp_2, pos_1, Pairs(4, 6, {{0, 1}, {1, 2}, {2, 4}})), Outcome::kFound);
  EXPECT_EQ(network.Restrict(pos_1, LabelSet::Of(6, {4})), Outcome::kNone);
  EXPECT_EQ(network.labels(pos_1), LabelSet::Of(6, {1, 2}));
}

// A network of model RB has a labeling if one is forced into it. Otherwise, at the threshold, some
// networks have a labeling and some have none.
TEST(RandomRbNetwork, HasALabelingWhereOneIsForced) {
  int drawn = 0;
  for (int seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream random(seed, "rb");
    using workloads::ModelRb;
    const auto decide = [&](ModelRb::Labeling labeling) {
      Network network =
          workloads::RandomRbNetwork({.nodes = 12, .labeling = labeling}, random).Build();
      return network.Decide();
    };
    ASSERT_EQ(decide(ModelRb::Labeling::kForced), Outcome::kFound);
    if (decide(ModelRb::Labeling::kAsDrawn) == Outcome::kFound) ++drawn;
  }
  EXPECT_GT(drawn, 0);
  EXPECT_LT(drawn, 20);
}

// The networks are the networks of the benchmarks. An independent counter confirms refutations and
// the counts of the smaller networks.
TEST(NetworkFamily, IsDecidedAndCountedAsByBacktracking) {
  int none = 0;
  for (const auto family :
       {workloads::NetworkFamily::kModelB, workloads::NetworkFamily::kModelRb}) {
    for (int index = 0; index < 4; ++index) {
      SCOPED_TRACE(std::string(workloads::Name(family)) + std::to_string(index));
      const NetworkWorkload workload = workloads::NetworkOfFamily(family, index, 1);
      const auto expected = oracle::LabelingsByBacktracking(workload.nodes, workload.arcs);
      ASSERT_EQ(CountOf(workload.Build()), expected.size());
      ASSERT_EQ(workload.Build().Decide(), expected.empty() ? Outcome::kNone : Outcome::kFound);
      if (expected.empty()) ++none;
    }
  }
  EXPECT_GT(none, 0);
}

}  // namespace
}  // namespace assay::network::search_test
