#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>

#include "tests/sim/cli/program.h"

namespace assay::cli::budget_test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using Json = nlohmann::json;

constexpr char kSchema[] = "sim/cli/verbs/budget.schema.json";

// Parts in jigs, and a planner that may only squeeze, which makes the budget quick.
std::string Scenario(const std::string& prices) {
  return std::regex_replace(TextOf(kTwoActions), std::regex("sensing: .*"),
                            "resolvers: [squeezing]") +
         prices;
}

const std::string kDistributions =
    "distributions: {peg.xy: {normal: 0.005}, hand.theta: {normal: 0.001, within: 0.004}}\n"
    "correlations: [[peg.x, peg.y, 0.5]]\n";
const std::string kPrices =
    "prices:\n  hand.x: {0.001: 0}\n  peg.theta: {20: 0, 0.001: 50, 0.0005: 400}\n";

class BudgetVerb : public ::testing::Test {
 protected:
  // Returns the budget of the scenario with prices. It is computed once.
  const Json& Budget() const {
    static const Json budget = [this] {
      const Ended ended =
          Assay({"budget", scenario_, "--json", "--front", "peg.xy,hand.theta", "-o", drawing_});
      EXPECT_EQ(ended.code, 0) << ended.err;
      EXPECT_THAT(TextOf(drawing_), HasSubstr("peg.xy, mm"));
      return ended.Json();
    }();
    return budget;
  }

  bool IsProved(double multiple) const {
    const Ended ended =
        Assay({"plan", scenario_, "--errors-times", fmt::format("{:.17g}", multiple)});
    EXPECT_EQ(ended.code, 0) << ended.err;
    return ended.out.find("Every precondition is proved.") != std::string::npos;
  }

  const Folder folder_;
  const std::string scenario_ = folder_.Write("priced.yaml", Scenario(kPrices + kDistributions));
  const std::string drawing_ = folder_ / "front.svg";
};

TEST_F(BudgetVerb, HasItsSchema) { EXPECT_THAT(SchemaErrors(kSchema, Budget()), IsEmpty()); }

// The verb that plans is another way to the same certificates.
TEST_F(BudgetVerb, TheBestPlanIsProvedAtTheMultipleAndNotAbove) {
  const double proved = Budget()["best_plan"]["proved"];
  const double unproved = Budget()["best_plan"]["unproved"];
  EXPECT_GE(proved, Budget()["plan"]["proved"].get<double>())
      << "the plan as it is, is one of them";
  EXPECT_NEAR(unproved, 1.01 * proved, 1e-9);
  EXPECT_TRUE(IsProved(proved));
  EXPECT_FALSE(IsProved(unproved));
}

// One error alone may be as great as all errors together, since the others are smaller.
TEST_F(BudgetVerb, OneErrorAloneMayBeAsGreatAsAllTogether) {
  const double together = Budget()["plan"]["proved"];
  ASSERT_GT(together, 1);
  EXPECT_THAT(Budget()["quantities"], Not(IsEmpty()));
  for (const Json& quantity : Budget()["quantities"]) {
    EXPECT_GE(1.01 * quantity["proved"].get<double>(), together) << quantity["name"];
  }
}

// With its free offer, the angle of the peg would be uncertain by 20 degrees.
TEST_F(BudgetVerb, BuysWhatIsNeeded) {
  const Json& cheapest = Budget()["cheapest"];
  EXPECT_EQ(cheapest["price"], 50);
  EXPECT_EQ(cheapest["bought"]["peg.theta"]["price"], 50);
  EXPECT_EQ(cheapest["bought"]["hand.x"]["price"], 0);
  EXPECT_EQ(cheapest["exact"], true);
}

// The fronts end where one error alone ends, while the other is 0.
TEST_F(BudgetVerb, HasAFrontThatIsProvedOnOneSide) {
  const Json& pareto = Budget()["pareto"];
  EXPECT_EQ(pareto["groups"], (Json{"peg.xy", "hand.theta"}));
  ASSERT_EQ(pareto["fronts"].size(), 1U);
  const Json& points = pareto["fronts"][0]["points"];
  ASSERT_GE(points.size(), 20U);
  for (const Json& quantity : Budget()["quantities"]) {
    if (quantity["name"] != "hand.theta") continue;
    EXPECT_GE(1.01 * points.front()["proved"][1].get<double>(), quantity["proved"].get<double>());
  }
  for (const Json& point : points) {
    if (point.contains("unproved")) {
      EXPECT_TRUE(point.contains("obstacle"));
    }
  }
}

TEST_F(BudgetVerb, BoundsProbabilities) {
  const Json& failures = Budget()["failures"];
  EXPECT_EQ(failures["steps"].size(), 2U);
  EXPECT_LE(failures["plan"]["least"], failures["plan"]["most"]);
  for (const Json& step : failures["steps"]) EXPECT_LE(step["most"], failures["plan"]["most"]);
}

TEST_F(BudgetVerb, ChecksDistributions) {
  const auto refused = [&](const std::string& keys) {
    const Ended ended = Assay({"budget", folder_.Write("wrong.yaml", Scenario(keys))});
    EXPECT_EQ(ended.code, 3) << keys;
    return ended.err;
  };
  EXPECT_THAT(refused("distributions: {clearance: uniform}\n"),
              HasSubstr("'clearance' is no error of a pose"));
  EXPECT_THAT(refused("distributions: {peg.x: {normal: -1}}\n"), HasSubstr("not positive"));
  EXPECT_THAT(refused("distributions: {peg.xy: uniform, peg.y: uniform}\n"),
              HasSubstr("two distributions"));
  EXPECT_THAT(refused("distributions: {peg.x: uniform}\ncorrelations: [[peg.x, peg.y, 0.5]]\n"),
              HasSubstr("no normal distribution"));
  const std::string normal = "distributions: {peg.xy: {normal: 1}, block.x: {normal: 1}}\n";
  EXPECT_THAT(refused(normal + "correlations: [[peg.x, peg.x, 0.5]]\n"),
              HasSubstr("no correlation"));
  EXPECT_THAT(refused(normal + "correlations: [[peg.x, peg.y, 2]]\n"), HasSubstr("-1 to 1"));
  EXPECT_THAT(refused(normal + "correlations: [[peg.x, peg.y, 0.9], [peg.y, block.x, 0.9], "
                               "[peg.x, block.x, -0.9]]\n"),
              HasSubstr("at once"));
}

TEST_F(BudgetVerb, ChecksTheErrorsOfItsFront) {
  const auto refused = [&](const std::string& front) {
    const Ended ended = Assay({"budget", scenario_, "--front", front});
    EXPECT_EQ(ended.code, 2) << front;
    return ended.err;
  };
  EXPECT_THAT(refused("peg.x"), HasSubstr("two or three"));
  EXPECT_THAT(refused("peg.x,nut.x"), HasSubstr("'nut.x' is no error of this scenario"));
  EXPECT_THAT(refused("peg.x,peg.xy"), HasSubstr("names 'peg.x' twice"));
  const Ended ended = Assay({"budget", scenario_, "-o", folder_ / "nothing.svg"});
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.err, HasSubstr("--front"));
}

TEST_F(BudgetVerb, AScenarioWithoutAPlanHasNoBudget) {
  const Ended ended = Assay({"budget", kImpossible});
  EXPECT_EQ(ended.code, 10);
  EXPECT_THAT(ended.err, HasSubstr("impossible.yaml: there is no plan"));
}

TEST_F(BudgetVerb, WhatIsForSaleIsNamed) {
  const std::string file = folder_.Write("nut.yaml", Scenario("prices: {nut.x: {0.1: 3}}\n"));
  const Ended ended = Assay({"budget", file});
  EXPECT_EQ(ended.code, 3);
  EXPECT_THAT(ended.err, HasSubstr("'nut.x'"));
  EXPECT_THAT(ended.err, HasSubstr("peg.theta"));
}

}  // namespace
}  // namespace assay::cli::budget_test
