#include "planner/constraint_posting/uncertainty_phase/combinations.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <set>
#include <tuple>

#include "planner/base/random.h"

namespace assay::constraint_posting::combinations_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

using Chosen = std::vector<int>;

constexpr std::int64_t kUnlimited = 1'000'000;

std::vector<Chosen> Visited(const std::vector<Combinable>& items, int most, std::int64_t budget) {
  std::vector<Chosen> visited;
  VisitCombinations(items, most, budget, [&](const Chosen& chosen) {
    visited.push_back(chosen);
    return false;
  });
  return visited;
}

bool HasDistinctSubjects(const std::vector<Combinable>& items, const Chosen& chosen) {
  std::set<int> subjects;
  for (const int item : chosen) subjects.insert(items[item].subject);
  return subjects.size() == chosen.size();
}

// Returns all subsets, filtered and then sorted as the declaration says.
std::vector<Chosen> Naive(const std::vector<Combinable>& items, int most) {
  std::vector<Chosen> all;
  for (unsigned bits = 1; bits < 1U << items.size(); ++bits) {
    Chosen chosen;
    for (std::size_t i = 0; i < items.size(); ++i) {
      if ((bits >> i & 1U) != 0) chosen.push_back(static_cast<int>(i));
    }
    if (std::ssize(chosen) <= most && HasDistinctSubjects(items, chosen)) all.push_back(chosen);
  }
  std::ranges::sort(all, {}, [&](const Chosen& chosen) {
    int highest = 0;
    for (const int item : chosen) highest = std::max(highest, items[item].group);
    return std::tuple(highest, chosen.size(), chosen);
  });
  return all;
}

std::vector<Combinable> RandomItems(RandomStream& random) {
  std::vector<Combinable> items(random.Index(9));
  for (Combinable& item : items) item = {.group = random.Index(3), .subject = random.Index(4)};
  std::ranges::stable_sort(items, {}, &Combinable::group);
  return items;
}

TEST(Combinations, OfNothingAreNone) { EXPECT_THAT(Visited({}, 3, kUnlimited), IsEmpty()); }

TEST(Combinations, LowerGroupsComeFirstThenTheSmaller) {
  const std::vector<Combinable> items = {{0, 0}, {0, 1}, {1, 0}, {1, 1}};
  EXPECT_THAT(Visited(items, 2, kUnlimited),
              ElementsAre(Chosen{0}, Chosen{1}, Chosen{0, 1},  // combinations of group 0 alone
                          Chosen{2}, Chosen{3}, Chosen{0, 3}, Chosen{1, 2}, Chosen{2, 3}));
}

TEST(Combinations, AreThoseOfANaiveEnumeration) {
  RandomStream random(20250711, "combinations");
  for (int trial = 0; trial < 300; ++trial) {
    const std::vector<Combinable> items = RandomItems(random);
    const int most = random.Index(4);
    EXPECT_EQ(Visited(items, most, kUnlimited), Naive(items, most)) << "trial " << trial;
  }
}

TEST(Combinations, ABudgetCutsTheSameOrderShort) {
  RandomStream random(20250711, "budgets");
  for (int trial = 0; trial < 100; ++trial) {
    const std::vector<Combinable> items = RandomItems(random);
    const int budget = random.Index(12);
    std::vector<Chosen> expected = Naive(items, 3);
    expected.resize(std::min<std::size_t>(expected.size(), budget));
    EXPECT_EQ(Visited(items, 3, budget), expected) << "trial " << trial;
  }
}

TEST(Combinations, StopWhereTheVisitorSays) {
  RandomStream random(20250711, "stops");
  for (int trial = 0; trial < 100; ++trial) {
    const std::vector<Combinable> items = RandomItems(random);
    const std::vector<Chosen> all = Naive(items, 3);
    const int wanted = random.Index(20);
    int visits = 0;
    const bool stopped =
        VisitCombinations(items, 3, kUnlimited, [&](const Chosen&) { return visits++ == wanted; });
    EXPECT_EQ(stopped, wanted < std::ssize(all));
    EXPECT_EQ(visits, std::min<int>(wanted + 1, static_cast<int>(all.size())));
  }
}

}  // namespace
}  // namespace assay::constraint_posting::combinations_test
