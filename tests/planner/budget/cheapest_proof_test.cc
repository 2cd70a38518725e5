#include "planner/budget/cheapest_proof.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "planner/base/input_files/input_error.h"
#include "planner/base/random.h"

namespace assay::budget::cheapest_proof_test {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr std::uint64_t kSeed = 32;

// Returns lists with offers of falling errors and rising prices.
std::vector<PriceList> RandomPrices(RandomStream& random) {
  std::vector<PriceList> prices(static_cast<std::size_t>(1 + random.Index(4)));
  for (PriceList& list : prices) {
    double price = 0;
    double error = 1;
    for (int k = 0, count = 1 + random.Index(4); k < count; ++k) {
      list.offers.push_back({error, price});
      error *= random.Uniform(0.2, 0.9);
      price += random.Uniform(1, 100);
    }
  }
  return prices;
}

// Calls `visit` with every purchase.
void ForAll(const std::vector<PriceList>& prices, Purchase& purchase, std::size_t list,
            const std::function<void(const Purchase&)>& visit) {
  if (list == prices.size()) return visit(purchase);
  for (purchase[list] = 0; purchase[list] < prices[list].offers.size(); ++purchase[list])
    ForAll(prices, purchase, list + 1, visit);
}

TEST(CheapestProof, IsWhatExhaustiveSearchFinds) {
  RandomStream random(kSeed, "prices");
  int found = 0;
  for (int i = 0; i < 300; ++i) {
    const std::vector<PriceList> prices = RandomPrices(random);
    // Everything is proved if a weighted sum of errors is small: less error is no harder to prove.
    std::vector<double> weights;
    for (std::size_t k = 0; k < prices.size(); ++k) weights.push_back(random.Uniform(0, 1));
    const double most = random.Uniform(0.1, 1.5);
    const auto is_proved = [&](const Purchase& purchase) {
      double sum = 0;
      for (std::size_t k = 0; k < prices.size(); ++k)
        sum += weights[k] * prices[k].offers[purchase[k]].greatest;
      return sum < most;
    };
    double cheapest = std::numeric_limits<double>::infinity();
    Purchase purchase(prices.size());
    ForAll(prices, purchase, 0, [&](const Purchase& each) {
      if (is_proved(each)) cheapest = std::min(cheapest, PriceOf(prices, each));
    });
    const CheapestProof answer = FindCheapestProof(prices, is_proved, 10'000);
    EXPECT_TRUE(answer.is_exact);
    ASSERT_EQ(answer.purchase.has_value(), cheapest < std::numeric_limits<double>::infinity());
    if (!answer.purchase) continue;
    ++found;
    EXPECT_TRUE(is_proved(*answer.purchase));
    EXPECT_DOUBLE_EQ(PriceOf(prices, *answer.purchase), cheapest) << "seed " << kSeed << ", " << i;
  }
  EXPECT_GE(found, 150);
}

TEST(CheapestProof, SaysThatItsBudgetEnded) {
  const std::vector<PriceList> prices = {{{"a", {0}}, {{3, 0}, {2, 1}, {1, 2}}},
                                         {{"b", {1}}, {{3, 0}, {2, 1}, {1, 2}}}};
  const auto both_best = [](const Purchase& p) { return p[0] + p[1] >= 3; };
  const CheapestProof answer = FindCheapestProof(prices, both_best, 1);
  EXPECT_FALSE(answer.is_exact);
  EXPECT_FALSE(answer.purchase);
}

const std::vector<ErrorQuantity> kQuantities = {
    {"camera.x", domain::Dimension::kLength, {-0.001, 0.001}},
    {"camera.y", domain::Dimension::kLength, {-0.001, 0.001}},
    {"hand.theta", domain::Dimension::kAngle, {-0.1, 0.1}}};

std::vector<PriceList> Read(const std::string& text) {
  return ReadPrices(Document::Parse(text, "prices.yaml").root(),
                    {.length = domain::kMillimetres, .angle = domain::kDegrees}, kQuantities);
}

TEST(Prices, AreReadInTheUnitsOfTheFile) {
  const auto prices = Read("{camera.xy: {0.1: 900, 0.3: 0}, hand.theta: {1: 5}}");
  ASSERT_EQ(prices.size(), 2U);
  EXPECT_THAT(prices[0].group.quantities, ::testing::ElementsAre(0U, 1U));
  ASSERT_EQ(prices[0].offers.size(), 2U);
  EXPECT_DOUBLE_EQ(prices[0].offers[0].greatest, 0.0003);
  EXPECT_EQ(prices[0].offers[0].price, 0);
  EXPECT_DOUBLE_EQ(prices[0].offers[1].greatest, 0.0001);
  EXPECT_NEAR(prices[1].offers[0].greatest, 0.017453, 1e-6);
  EXPECT_THAT(
      MultiplesOf(prices, {1, 0}, kQuantities),
      ::testing::ElementsAre(::testing::DoubleNear(0.1, 1e-12), ::testing::DoubleNear(0.1, 1e-12),
                             ::testing::DoubleNear(0.17453, 1e-5)));
}

TEST(Prices, WrongOnesAreRefused) {
  const auto expect = [](const std::string& text, const std::string& message) {
    EXPECT_THAT([&] { Read(text); }, ThrowsMessage<InputError>(HasSubstr(message))) << text;
  };
  expect("{lens.x: {1: 0}}", "'lens.x' is no error of this scenario; allowed: camera.x, camera.y");
  expect("{camera.xz: {1: 0}}", "'camera.xz' is no error");
  expect("{camera.x: {0: 1}}", "not positive");
  expect("{camera.x: {1: -1}}", "negative");
  expect("{camera.x: {}}", "no offer");
  expect("{camera.x: {1: 5, 0.5: 5}}", "not dearer");
  expect("{camera.x: {1: 5}, camera.xy: {1: 5}}", "on sale twice");
}

}  // namespace
}  // namespace assay::budget::cheapest_proof_test
