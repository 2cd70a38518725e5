#include "planner/network/constraint_network/conflict.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "tests/planner/network/random_networks.h"

namespace assay::network::conflict_test {
namespace {

Budget Enough() { return Budget(std::numeric_limits<std::int64_t>::max()); }

bool Consistent(const std::vector<LabelSet>& nodes, const std::vector<Constraint>& constraints,
                const std::vector<int>& chosen) {
  std::vector<LabelSet> labels = nodes;
  std::vector<Arc> arcs;
  for (int index : chosen) {
    if (const auto* unary = std::get_if<UnaryConstraint>(&constraints[index])) {
      labels[unary->node.index()].intersect(unary->allowed);
    } else {
      const auto& binary = std::get<BinaryConstraint>(constraints[index]);
      arcs.push_back({binary.a, binary.b, binary.relation});
    }
  }
  return !oracle::LabelingsByBacktracking(labels, arcs).empty();
}

std::vector<int> Without(std::vector<int> indices, int index) {
  std::erase(indices, index);
  return indices;
}

TEST(MinimalConflict, IsInconsistentAndLosesThatWithAnyOfItsConstraints) {
  int conflicts = 0;
  for (int seed = 0; seed < 800; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream random(seed, "conflict");
    NetworkWorkload workload = RandomSmallNetwork(random);
    Network background;
    for (LabelSet& labels : workload.nodes) {
      labels = LabelSet::All(labels.size());
      background.AddNode(labels);
    }
    std::vector<Constraint> constraints;
    for (const Arc& arc : workload.arcs) {
      constraints.push_back(BinaryConstraint{arc.a, arc.b, arc.relation});
      const int node = random.Index(background.node_count());
      constraints.push_back(
          UnaryConstraint{NodeId(node), RandomLabels(workload.nodes[node].size(), 0.8, random)});
    }
    std::vector<int> all(constraints.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int>(i);

    Budget budget = Enough();
    const Conflict conflict = MinimalConflict(background, constraints, budget);
    const bool consistent = Consistent(workload.nodes, constraints, all);
    ASSERT_EQ(conflict.outcome, consistent ? Outcome::kNone : Outcome::kFound);
    if (consistent) continue;
    ++conflicts;
    ASSERT_TRUE(std::is_sorted(conflict.constraints.begin(), conflict.constraints.end()));
    ASSERT_FALSE(Consistent(workload.nodes, constraints, conflict.constraints));
    for (int index : conflict.constraints) {
      ASSERT_TRUE(Consistent(workload.nodes, constraints, Without(conflict.constraints, index)));
    }
  }
  EXPECT_GT(conflicts, 200);
}

TEST(MinimalConflict, CountsWhatIsPostedAsBackground) {
  Network network;
  const NodeId a = network.AddNode(LabelSet::All(2)), b = network.AddNode(LabelSet::All(2));
  ASSERT_EQ(network.Post(a, b, Relation::Where(2, 2, std::equal_to<Label>())), Outcome::kFound);
  const std::vector<Constraint> constraints = {
      BinaryConstraint{a, b, Relation::Where(2, 2, std::less_equal<Label>())},
      UnaryConstraint{a, LabelSet::Of(2, {0})},
      UnaryConstraint{b, LabelSet::Of(2, {1})},
  };
  Budget budget = Enough();
  EXPECT_THAT(MinimalConflict(network, constraints, budget).constraints,
              testing::ElementsAre(1, 2));
}

TEST(MinimalConflict, PrefersEarlyConstraints) {
  Network network;
  const NodeId a = network.AddNode(LabelSet::All(2));
  const Constraint zero = UnaryConstraint{a, LabelSet::Of(2, {0})};
  const Constraint one = UnaryConstraint{a, LabelSet::Of(2, {1})};
  const std::vector<Constraint> constraints = {zero, one, zero, one};
  Budget budget = Enough();
  EXPECT_THAT(MinimalConflict(network, constraints, budget).constraints,
              testing::ElementsAre(0, 1));
}

TEST(MinimalConflict, IsEmptyIfTheBackgroundIsInconsistent) {
  Network network;
  network.AddNode(LabelSet::None(2));
  const std::vector<Constraint> constraints = {
      UnaryConstraint{NodeId(0), LabelSet::Of(2, {0})},
      UnaryConstraint{NodeId(0), LabelSet::Of(2, {1})},
  };
  Budget budget = Enough();
  const Conflict conflict = MinimalConflict(network, constraints, budget);
  EXPECT_EQ(conflict.outcome, Outcome::kFound);
  EXPECT_TRUE(conflict.constraints.empty());
}

TEST(MinimalConflict, ReportsASpentBudget) {
  RandomStream random(3, "spent");
  const NetworkWorkload workload =
      workloads::RandomNetwork({.nodes = 20, .labels = 10, .arcs = 95, .forbidden = 37}, random);
  Network network;
  for (const LabelSet& labels : workload.nodes) network.AddNode(labels);
  std::vector<Constraint> constraints;
  for (const Arc& arc : workload.arcs) {
    constraints.push_back(BinaryConstraint{arc.a, arc.b, arc.relation});
  }
  Budget budget(5);
  EXPECT_EQ(MinimalConflict(network, constraints, budget).outcome, Outcome::kBudget);
}

}  // namespace
}  // namespace assay::network::conflict_test
