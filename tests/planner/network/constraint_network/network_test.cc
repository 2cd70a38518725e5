#include "planner/network/constraint_network/network.h"

#include <gtest/gtest.h>

#include "planner/network/labeling/search.h"
#include "tests/planner/network/random_networks.h"

namespace assay::network::network_test {
namespace {

// Everything by which a caller can distinguish two networks.
struct Behaviour {
  std::vector<LabelSet> labels;
  std::vector<Arc> arcs;
  std::vector<Labeling> labelings;

  bool operator==(const Behaviour& other) const {
    const auto same = [](const Arc& x, const Arc& y) {
      return x.a == y.a && x.b == y.b && x.relation == y.relation;
    };
    return labels == other.labels && labelings == other.labelings &&
           std::equal(arcs.begin(), arcs.end(), other.arcs.begin(), other.arcs.end(), same);
  }
};

Behaviour BehaviourOf(const Network& network) {
  Behaviour behaviour;
  for (int node = 0; node < network.node_count(); ++node) {
    behaviour.labels.push_back(network.labels(NodeId(node)));
  }
  behaviour.arcs.assign(network.arcs().begin(), network.arcs().end());
  Labelings labelings(network);
  while (labelings.Next() == Outcome::kFound) behaviour.labelings.push_back(labelings.labeling());
  return behaviour;
}

// A sequence of constraints, kept beside the network to which they are posted, in the form that the
// oracle reads.
class Trace {
 public:
  explicit Trace(std::uint64_t seed) : random_(seed, "trace") {}

  void AddNode() {
    LabelSet labels = RandomLabels(1 + random_.Index(4), 0.8, random_);
    if (labels.empty()) labels.insert(0);
    nodes.push_back(labels);
    network.AddNode(labels);
  }

  // Posts a random constraint. Returns whether the network and the oracle give the same answer.
  bool Post() {
    std::vector<LabelSet> new_nodes = nodes;
    std::vector<Arc> new_arcs = arcs;
    Outcome outcome;
    const NodeId a(random_.Index(network.node_count())), b(random_.Index(network.node_count()));
    if (random_.Index(4) == 0) {
      const LabelSet allowed = RandomLabels(nodes[a.index()].size(), 0.7, random_);
      new_nodes[a.index()].intersect(allowed);
      outcome = network.Restrict(a, allowed);
    } else {
      const auto relation =
          RandomRelation(nodes[a.index()].size(), nodes[b.index()].size(), 0.6, random_);
      new_arcs.push_back({a, b, relation});
      outcome = network.Post(a, b, relation);
    }
    const bool consistent = !oracle::LabelingsByBacktracking(new_nodes, new_arcs).empty();
    if (consistent) {
      nodes = new_nodes;
      arcs = new_arcs;
    }
    return outcome == (consistent ? Outcome::kFound : Outcome::kNone);
  }

  RandomStream& random() { return random_; }

  Network network;
  std::vector<LabelSet> nodes;
  std::vector<Arc> arcs;

 private:
  RandomStream random_;
};

TEST(Network, DecidesEveryPostAndStaysAsBeforeWhenItRefuses) {
  int refused = 0;
  for (int seed = 0; seed < 400; ++seed) {
    SCOPED_TRACE(seed);
    Trace trace(seed);
    for (int i = 0; i < 4; ++i) trace.AddNode();
    for (int i = 0; i < 15; ++i) {
      const Behaviour before = BehaviourOf(trace.network);
      const Labeling witness = *trace.network.witness();
      const std::size_t constraints = trace.arcs.size();
      const std::vector<LabelSet> nodes = trace.nodes;
      ASSERT_TRUE(trace.Post());
      ASSERT_NE(trace.network.witness(), nullptr);
      ASSERT_TRUE(oracle::Holds(trace.nodes, trace.arcs, *trace.network.witness()));
      ASSERT_EQ(oracle::ArcConsistentByRepetition(trace.nodes, trace.arcs),
                BehaviourOf(trace.network).labels);
      if (trace.arcs.size() == constraints && trace.nodes == nodes) {
        ++refused;
        ASSERT_EQ(BehaviourOf(trace.network), before);
        ASSERT_EQ(*trace.network.witness(), witness);
      }
    }
  }
  EXPECT_GT(refused, 500);
}

// The last labeling (the witness) violates the posted constraint. Another label for one node
// satisfies the constraint, so nothing is propagated. The propagation happens when labels are asked
// for.
TEST(Network, PropagatesWhatItOwesWhenLabelsAreAskedFor) {
  Network network;
  const NodeId a = network.AddNode(LabelSet::All(3)), b = network.AddNode(LabelSet::All(3));
  ASSERT_EQ(network.Post(a, b, Relation::Where(3, 3, std::less<Label>())), Outcome::kFound);
  EXPECT_EQ(*network.witness(), (Labeling{{0, 1}}));
  EXPECT_EQ(network.counters(), Counters());
  EXPECT_EQ(network.labels(a), LabelSet::Of(3, {0, 1}));
  EXPECT_EQ(network.labels(b), LabelSet::Of(3, {1, 2}));
  EXPECT_GT(network.counters().revisions, 0);
}

TEST(Network, UndoGivesTheNetworkThatWasSaved) {
  struct Saved {
    Network::Mark mark;
    Behaviour behaviour;
    std::vector<LabelSet> nodes;
    std::vector<Arc> arcs;
  };
  for (int seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    Trace trace(seed);
    trace.AddNode();
    std::vector<Saved> saved;
    for (int i = 0; i < 40; ++i) {
      switch (trace.random().Index(5)) {
        case 0:
          if (trace.network.node_count() < 5) trace.AddNode();
          break;
        case 1:
          saved.push_back(
              {trace.network.Save(), BehaviourOf(trace.network), trace.nodes, trace.arcs});
          break;
        case 2:
          if (!saved.empty()) {
            trace.network.Undo(saved.back().mark);
            trace.nodes = saved.back().nodes;
            trace.arcs = saved.back().arcs;
            ASSERT_EQ(BehaviourOf(trace.network), saved.back().behaviour);
            if (trace.random().Index(2) == 0) saved.pop_back();  // a mark may be used several times
          }
          break;
        default:
          ASSERT_TRUE(trace.Post());
      }
    }
    Network fresh;
    for (const LabelSet& labels : trace.nodes) fresh.AddNode(labels);
    for (const Arc& arc : trace.arcs)
      ASSERT_EQ(fresh.Post(arc.a, arc.b, arc.relation), Outcome::kFound);
    ASSERT_EQ(BehaviourOf(trace.network), BehaviourOf(fresh));
  }
}

TEST(Network, UndoOfAnUnpropagatedNetworkIsPropagatedLater) {
  Network network;
  const NodeId a = network.AddNode(LabelSet::All(3)), b = network.AddNode(LabelSet::All(3));
  network.AddArc(a, b, Relation::Where(3, 3, [](Label x, Label y) { return x < y; }));
  const Network::Mark mark = network.Save();
  ASSERT_EQ(network.Decide(), Outcome::kFound);
  EXPECT_EQ(network.labels(a), LabelSet::Of(3, {0, 1}));
  network.Undo(mark);
  EXPECT_EQ(network.labels(a), LabelSet::All(3));
  ASSERT_EQ(network.Decide(), Outcome::kFound);
  EXPECT_EQ(network.labels(a), LabelSet::Of(3, {0, 1}));
}

TEST(Network, DecideLeavesAnInconsistentNetworkAsItWas) {
  for (int seed = 0; seed < 500; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream random(seed, "decide");
    const NetworkWorkload workload = RandomSmallNetwork(random);
    Network network = workload.Build();
    std::vector<LabelSet> before;
    for (int i = 0; i < network.node_count(); ++i) before.push_back(network.labels(NodeId(i)));
    const bool consistent = !oracle::LabelingsByBacktracking(workload.nodes, workload.arcs).empty();
    for (int repetition = 0; repetition < 2; ++repetition) {
      ASSERT_EQ(network.Decide(), consistent ? Outcome::kFound : Outcome::kNone);
    }
    if (consistent) {
      ASSERT_TRUE(network.Satisfies(*network.witness()));
    } else {
      ASSERT_EQ(BehaviourOf(network).labels, before);
      ASSERT_EQ(network.witness(), nullptr);
    }
  }
}

// A budget that is too small leaves the post undecided and the network unchanged.
TEST(Network, ASpentBudgetIsNotAnAnswer) {
  RandomStream random(3, "spent");
  const NetworkWorkload workload =
      workloads::RandomNetwork({.nodes = 20, .labels = 10, .arcs = 95, .forbidden = 37}, random);
  Network network;
  for (const LabelSet& labels : workload.nodes) network.AddNode(labels);
  int undecided = 0;
  for (const Arc& arc : workload.arcs) {
    const std::size_t arcs = network.arcs().size();
    Budget budget(2);
    const Outcome outcome = network.Post(arc.a, arc.b, arc.relation, budget);
    if (outcome == Outcome::kBudget) ++undecided;
    ASSERT_EQ(network.arcs().size(), arcs + (outcome == Outcome::kFound ? 1 : 0));
    ASSERT_TRUE(network.witness() != nullptr && network.Satisfies(*network.witness()));
  }
  EXPECT_GT(undecided, 0);
}

TEST(Network, ALoopAllowsLabelsPairedWithThemselves) {
  Network network;
  const NodeId node = network.AddNode(LabelSet::All(4));
  ASSERT_EQ(network.Post(node, node,
                         Relation::Where(4, 4, [](Label a, Label b) { return a * b % 2 == 0; })),
            Outcome::kFound);
  EXPECT_EQ(network.labels(node), LabelSet::Of(4, {0, 2}));
  EXPECT_EQ(network.Post(node, node, Relation::Where(4, 4, std::not_equal_to<Label>())),
            Outcome::kNone);
  EXPECT_EQ(network.arcs().size(), 1u);
}

TEST(Network, ParallelArcsHoldTogether) {
  Network network;
  const NodeId a = network.AddNode(LabelSet::All(3)), b = network.AddNode(LabelSet::All(3));
  ASSERT_EQ(network.Post(a, b, Relation::Where(3, 3, std::less_equal<Label>())), Outcome::kFound);
  ASSERT_EQ(network.Post(b, a, Relation::Where(3, 3, std::less_equal<Label>())), Outcome::kFound);
  EXPECT_EQ(network.Post(a, b, Relation::Where(3, 3, std::not_equal_to<Label>())), Outcome::kNone);
}

TEST(Network, ACopyIsIndependent) {
  Network network;
  const NodeId a = network.AddNode(LabelSet::All(3)), b = network.AddNode(LabelSet::All(3));
  Network copy = network;
  ASSERT_EQ(network.Post(a, b, Relation::Where(3, 3, std::less<Label>())), Outcome::kFound);
  EXPECT_EQ(copy.labels(a), LabelSet::All(3));
  ASSERT_EQ(copy.Post(a, b, Relation::Where(3, 3, std::greater<Label>())), Outcome::kFound);
  EXPECT_EQ(copy.labels(a), LabelSet::Of(3, {1, 2}));
  EXPECT_EQ(network.labels(a), LabelSet::Of(3, {0, 1}));
}

TEST(NetworkDeathTest, RefusesRelationsOfOtherSizes) {
  Network network;
  const NodeId a = network.AddNode(LabelSet::All(3)), b = network.AddNode(LabelSet::All(2));
  EXPECT_DEATH(network.AddArc(a, b, Relation::Where(2, 3, std::less<Label>())),
               "a 2 x 3 relation between nodes of 3 and 2 labels");
}

}  // namespace
}  // namespace assay::network::network_test
