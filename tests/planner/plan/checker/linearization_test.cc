#include "planner/plan/checker/linearization.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "planner/base/random.h"

namespace assay::plan::linearization_test {
namespace {

using Order = std::vector<StepId>;

constexpr std::uint64_t kSeed = 5;

std::vector<Order> Visited(int steps, const Ordering& ordering) {
  std::vector<Order> orders;
  VisitLinearizations(steps, ordering, [&](const Order& order) {
    orders.push_back(order);
    return Visit::kContinue;
  });
  return orders;
}

// Returns the orders among all permutations that respect every pair of the ordering.
std::vector<Order> VisitedByBruteForce(int steps, const Ordering& ordering) {
  Order order;
  for (int i = 0; i < steps; ++i) order.emplace_back(i);
  std::vector<Order> orders;
  do {
    const bool keeps = std::ranges::all_of(ordering, [&](const auto& pair) {
      return std::ranges::find(order, pair.first) < std::ranges::find(order, pair.second);
    });
    if (keeps) orders.push_back(order);
  } while (std::ranges::next_permutation(order).found);
  return orders;
}

TEST(Linearizations, AgreeWithBruteForceOnRandomOrderings) {
  RandomStream random(kSeed, "orderings");
  int cyclic = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const int steps = 1 + random.Index(6);
    Ordering ordering;
    for (int i = random.Index(6); i > 0; --i) {
      ordering.emplace_back(random.Index(steps), random.Index(steps));
    }
    const std::vector<Order> expected = VisitedByBruteForce(steps, ordering);
    EXPECT_EQ(Visited(steps, ordering), expected) << "seed " << kSeed << " trial " << trial;
    EXPECT_EQ(IsAcyclic(steps, ordering), !expected.empty()) << "trial " << trial;
    cyclic += expected.empty() ? 1 : 0;
  }
  EXPECT_GT(cyclic, 30);
  EXPECT_LT(cyclic, 270);
}

TEST(Linearizations, StopWhenTold) {
  int visits = 0;
  const bool all = VisitLinearizations(
      4, {}, [&](const Order&) { return ++visits == 5 ? Visit::kStop : Visit::kContinue; });
  EXPECT_EQ(visits, 5);
  EXPECT_FALSE(all);
}

TEST(FirstBroken, NamesThePairThatStandsTheWrongWayRound) {
  const Ordering ordering = {{StepId(0), StepId(1)}, {StepId(2), StepId(1)}};
  EXPECT_TRUE(FirstBroken(ordering, {StepId(2), StepId(0), StepId(1)}).first.IsNone());
  EXPECT_EQ(FirstBroken(ordering, {StepId(0), StepId(1), StepId(2)}),
            std::make_pair(StepId(2), StepId(1)));
}

}  // namespace
}  // namespace assay::plan::linearization_test
