#include "planner/contingent/language/decimal.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "planner/base/random.h"
#include "planner/contingent/tree_check/tree_check.h"
#include "tests/planner/contingent/tasks.h"

namespace assay::contingent::decimal_test {
namespace {

constexpr std::int64_t kBillion = 1'000'000'000;
constexpr double kInfinite = std::numeric_limits<double>::infinity();

// Returns a number of billionths as text, like "-12.030000000".
std::string Decimal(std::int64_t units) {
  const std::int64_t size = std::abs(units);
  return fmt::format("{}{}.{:09}", units < 0 ? "-" : "", size / kBillion, size % kBillion);
}

double Read(std::int64_t units) { return std::stod(Decimal(units)); }

// Returns a random number of any length, like 0.001, 7 or 123456.789012345.
std::int64_t RandomUnits(RandomStream& random) {
  std::int64_t units = 0;
  for (int digits = random.Index(15); digits >= 0; --digits) units = 10 * units + random.Index(10);
  for (int zeros = random.Index(10); zeros > 0 && units < kBillion; --zeros) units *= 10;
  return random.Index(2) == 0 ? units : -units;
}

// Oracle: sums of integer numbers of billionths, read as text.
TEST(Decimals, SumsAreWhatTheirDecimalsSumTo) {
  RandomStream random(1, "decimals");
  for (int i = 0; i < 200'000; ++i) {
    const std::int64_t a = RandomUnits(random);
    const std::int64_t b = RandomUnits(random);
    if (std::abs(a) > 1'000'000 * kBillion || std::abs(b) > 1'000'000 * kBillion ||
        std::abs(a + b) > 1'000'000 * kBillion) {
      continue;
    }
    ASSERT_EQ(ExactSum(Read(a), Read(b)), Read(a + b)) << Decimal(a) << " + " << Decimal(b);
  }
}

TEST(Decimals, KnownSums) {
  EXPECT_EQ(ExactSum(0.1, 0.2), 0.3);
  EXPECT_EQ(ExactSum(0.3, -0.1), 0.2);
  EXPECT_EQ(ExactSum(0.3, -0.3), 0.0);
  EXPECT_EQ(WidthOf(0.7, 0.9), 0.2);
  // Integers are doubles. The sum of a long and a short decimal is neither a double nor a decimal.
  EXPECT_EQ(ExactSum(1e12, 1), 1e12 + 1);
  EXPECT_EQ(ExactSum(1e16, 1), std::nullopt);
  EXPECT_EQ(ExactSum(0.1, 1e-12), std::nullopt);
  EXPECT_EQ(ExactSum(0.5, std::ldexp(1, -40)), 0.5 + std::ldexp(1, -40));
  EXPECT_EQ(EnclosingSum({-kInfinite, 0.1}, {0.2, 0.2}), Interval(-kInfinite, 0.3));
  EXPECT_EQ(WidthOf(-kInfinite, kInfinite), kInfinite);
}

// The oracle computes sums in long double. The decimal for which a double stands may differ from
// the double by up to 2^-53 of its size. The sums of the decimals therefore lie within `off` of the
// sum of the doubles.
TEST(Decimals, OtherSumsAreEnclosed) {
  RandomStream random(2, "decimals");
  for (int i = 0; i < 100'000; ++i) {
    const double a = random.Uniform(-1, 1) * std::pow(10, random.Index(20) - 5);
    const double b = random.Index(2) == 0 ? random.Uniform(-1, 1) * a : Read(RandomUnits(random));
    const long double sum = static_cast<long double>(a) + b;
    const long double off = (std::fabs(static_cast<long double>(a)) + std::fabs(b)) * 0x1p-53L;
    const Interval enclosing = EnclosingSum({a, a}, {b, b});
    if (enclosing.low == enclosing.high) continue;  // exact sums are tested above
    ASSERT_LE(enclosing.low, sum - off) << a << " " << b;
    ASSERT_GE(enclosing.high, sum + off) << a << " " << b;
  }
}

// Three pours of a tenth are exactly three tenths, for the planner and for the check.
TEST(Decimals, InPlansAreExact) {
  const auto plan_for = [](const std::string& goal) {
    const GroundTask task = GroundText(
        "domain tank predicates: done functions: level: number\n"
        "action pour preconds: K(level < 0.3) effects: add(Kf, level = level + 0.1)\n"
        "action finish preconds: K(level >= 0.3) & K(level <= 0.3) effects: add(Kf, done)\n",
        "problem tank domain tank init: add(Kf, level = 0), add(Kf, !done) goal: " + goal);
    const ContingentPlan plan = PlanFor(task, Wanted::kLeastDepth);
    if (plan.outcome == Outcome::kFound) {
      const TreeCheck check = CheckTree(task, plan.tree);
      EXPECT_EQ(check.failure, "");
      EXPECT_TRUE(check.AreAllWorlds());
    }
    return plan;
  };
  EXPECT_EQ(SizeOf(plan_for("K(done)").tree).depth, 4);
  EXPECT_EQ(plan_for("K(level > 0.3)").outcome, Outcome::kNone);
}

}  // namespace
}  // namespace assay::contingent::decimal_test
