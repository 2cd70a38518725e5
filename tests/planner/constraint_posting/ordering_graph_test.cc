#include "planner/constraint_posting/ordering_graph.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "planner/base/random.h"

namespace assay::constraint_posting::ordering_graph_test {
namespace {

using Arcs = std::set<std::pair<int, int>>;

bool Respects(const std::vector<int>& order, const Arcs& arcs) {
  const auto place = [&](int step) { return std::ranges::find(order, step) - order.begin(); };
  return std::ranges::all_of(arcs,
                             [&](const auto& arc) { return place(arc.first) < place(arc.second); });
}

// Returns all orders that respect the arcs, by trying every permutation.
std::set<std::vector<int>> AllOrders(int steps, const Arcs& arcs) {
  std::set<std::vector<int>> orders;
  std::vector<int> order(steps);
  std::iota(order.begin(), order.end(), 0);
  do {
    if (Respects(order, arcs)) orders.insert(order);
  } while (std::ranges::next_permutation(order).found);
  return orders;
}

TEST(OrderingGraph, AgreesWithAllPermutationsOnRandomPosts) {
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream random(seed, "ordering");
    const int steps = 2 + random.Index(5);
    OrderingGraph graph;
    for (int s = 0; s < steps; ++s) graph.AddStep();
    Arcs arcs;
    for (int post = 0; post < 8; ++post) {
      const int a = random.Index(steps);
      const int b = random.Index(steps);
      Arcs more = arcs;
      more.insert({a, b});
      const bool consistent = a != b && !AllOrders(steps, more).empty();
      EXPECT_EQ(graph.Post(StepId(a), StepId(b)), consistent);
      if (consistent) arcs = more;
    }
    const auto orders = AllOrders(steps, arcs);
    for (int a = 0; a < steps; ++a) {
      for (int b = 0; b < steps; ++b) {
        if (a == b) continue;
        const bool always = std::ranges::all_of(orders, [&](const std::vector<int>& order) {
          return std::ranges::find(order, a) < std::ranges::find(order, b);
        });
        EXPECT_EQ(graph.Before(StepId(a), StepId(b)), always);
      }
    }
    std::set<std::vector<int>> found;
    for (const auto& linearization : graph.Linearizations(1000)) {
      std::vector<int> order;
      for (StepId step : linearization) order.push_back(step.index());
      EXPECT_TRUE(found.insert(order).second) << "an order came twice";
    }
    EXPECT_EQ(found, orders);
  }
}

TEST(OrderingGraph, ARefusedPostChangesNothing) {
  OrderingGraph graph;
  const StepId a = graph.AddStep(), b = graph.AddStep(), c = graph.AddStep();
  EXPECT_TRUE(graph.Post(a, b));
  EXPECT_TRUE(graph.Post(b, c));
  EXPECT_FALSE(graph.Post(c, a));
  EXPECT_FALSE(graph.Post(a, a));
  EXPECT_TRUE(graph.Before(a, c));
  EXPECT_FALSE(graph.Before(c, a));
  EXPECT_EQ(graph.arcs().size(), 2u);
}

TEST(OrderingGraph, StopsAtAsManyOrdersAsAsked) {
  OrderingGraph graph;
  for (int s = 0; s < 6; ++s) graph.AddStep();
  EXPECT_EQ(graph.Linearizations(10).size(), 10u);
}

}  // namespace
}  // namespace assay::constraint_posting::ordering_graph_test
