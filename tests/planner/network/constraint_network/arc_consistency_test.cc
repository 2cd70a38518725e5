#include "planner/network/constraint_network/arc_consistency.h"

#include <gtest/gtest.h>

#include "tests/planner/network/random_networks.h"

namespace assay::network::arc_consistency_test {
namespace {

std::vector<LabelSet> LabelSetsOf(const Network& network) {
  std::vector<LabelSet> sets;
  for (int node = 0; node < network.node_count(); ++node) {
    sets.push_back(network.labels(NodeId(node)));
  }
  return sets;
}

// Returns the label sets after propagation over the arcs of the workload; none at a wipe-out.
std::optional<std::vector<LabelSet>> Propagated(const NetworkWorkload& workload) {
  const Network network = workload.Build();
  LabelStore labels = network.label_store();
  ArcConsistency consistency = network.arc_consistency();
  Counters counters;
  for (int node = 0; node < labels.node_count(); ++node) {
    if (labels.count(node) == 0) return std::nullopt;
  }
  if (!consistency.Propagate(labels, counters)) return std::nullopt;
  std::vector<LabelSet> sets;
  for (int node = 0; node < labels.node_count(); ++node) sets.push_back(labels.Labels(node));
  return sets;
}

template <class Generator>
void ExpectTheOneFixpoint(const Generator& generator, int trials) {
  for (int seed = 0; seed < trials; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream random(seed, "arc-consistency");
    NetworkWorkload workload = generator(random);
    const auto expected = oracle::ArcConsistentByRepetition(workload.nodes, workload.arcs);
    ASSERT_EQ(Propagated(workload), expected);
    for (std::size_t i = workload.arcs.size(); i > 1; --i) {
      std::swap(workload.arcs[i - 1], workload.arcs[random.Index(static_cast<int>(i))]);
    }
    ASSERT_EQ(Propagated(workload), expected) << "with the arcs in another order";
  }
}

TEST(ArcConsistency, ReachesTheOneFixpointInAnyOrder) {
  ExpectTheOneFixpoint(RandomSmallNetwork, 2000);
}

TEST(ArcConsistency, ReachesTheOneFixpointInSetsOfSeveralWords) {
  ExpectTheOneFixpoint(RandomWideNetwork, 300);
}

TEST(ArcConsistency, LeavesEveryLabelASupportAfterEachPost) {
  for (int seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream random(seed, "supports");
    const NetworkWorkload workload = RandomSmallNetwork(random);
    Network network;
    for (const LabelSet& labels : workload.nodes) {
      network.AddNode(labels.empty() ? LabelSet::All(labels.size()) : labels);
    }
    for (const Arc& arc : workload.arcs) {
      network.Post(arc.a, arc.b, arc.relation);
      const std::vector<LabelSet> sets = LabelSetsOf(network);
      const std::vector<Arc> arcs(network.arcs().begin(), network.arcs().end());
      ASSERT_EQ(oracle::ArcConsistentByRepetition(sets, arcs), sets);
    }
  }
}

TEST(ArcConsistency, GivesWeightToTheArcOfAWipeOut) {
  LabelStore labels;
  ArcConsistency consistency;
  for (int node = 0; node < 2; ++node) {
    labels.AddNode(LabelSet::All(2));
    consistency.AddNode();
  }
  const auto all = Relation::Forbidding(2, 2, {});
  const auto none = Relation::Allowing(2, 2, {});
  consistency.AddArc(0, 0, 1, *all);
  consistency.AddArc(1, 0, 1, *none);
  consistency.Enqueue(0);
  Counters counters;
  EXPECT_FALSE(consistency.Propagate(labels, counters));
  EXPECT_EQ(counters.wipe_outs, 1);
  EXPECT_EQ(consistency.weight(0), 1);
  EXPECT_EQ(consistency.weight(1), 2);
}

}  // namespace
}  // namespace assay::network::arc_consistency_test
