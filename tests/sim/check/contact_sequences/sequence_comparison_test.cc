#include "sim/check/contact_sequences/sequence_comparison.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "planner/base/random.h"

namespace assay::check::sequence_comparison_test {
namespace {

using finemotion::ContactKind;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

ContactKey K(int moving) { return {ContactKind::kVertexFace, moving, 0}; }

ContactSet Set(const std::vector<int>& moving) {
  ContactSet set;
  for (const int m : moving) set.push_back(K(m));
  std::ranges::sort(set);
  return set;
}

using Sets = std::vector<ContactSet>;

std::vector<ObservedState> Observed(const Sets& sets) {
  std::vector<ObservedState> states;
  for (std::size_t i = 0; i < sets.size(); ++i)
    states.push_back({sets[i], static_cast<double>(i), 1, static_cast<int>(i)});
  return states;
}

bool IsPart(const ContactSet& part, const ContactSet& of) {
  return part != of && std::ranges::includes(of, part);
}

// Returns the edit distance by plain recursion over its definition.
int SlowDistance(const Sets& planned, const Sets& observed, std::size_t i, std::size_t j) {
  if (i == planned.size()) return static_cast<int>(observed.size() - j);
  int least = SlowDistance(planned, observed, i + 1, j) + 1;
  if (j == observed.size()) return least;
  const bool lets_go = i > 0 && j > 0 && IsPart(observed[j], planned[i - 1]) &&
                       IsPart(observed[j], observed[j - 1]) && IsPart(planned[i], observed[j]);
  least = std::min(least, SlowDistance(planned, observed, i, j + 1) + (lets_go ? 0 : 1));
  const int exchange = planned[i] == observed[j] ? 0 : 1;
  return std::min(least, SlowDistance(planned, observed, i + 1, j + 1) + exchange);
}

// Returns a random sequence of subsets of three contacts. Neighbouring subsets differ.
Sets RandomSequence(RandomStream& random, int most) {
  Sets sets;
  const int length = 1 + random.Index(most);
  while (std::ssize(sets) < length) {
    const int bits = random.Index(8);
    std::vector<int> members;
    for (int k = 0; k < 3; ++k) {
      if ((bits >> k & 1) != 0) members.push_back(k);
    }
    if (sets.empty() || sets.back() != Set(members)) sets.push_back(Set(members));
  }
  return sets;
}

TEST(EditDistance, IsThatOfTheRecursion) {
  RandomStream random(1, "edit distance");
  for (int round = 0; round < 500; ++round) {
    const Sets planned = RandomSequence(random, 5);
    const Sets observed = RandomSequence(random, 6);
    EXPECT_EQ(EditDistance(planned, Observed(observed)), SlowDistance(planned, observed, 0, 0));
  }
}

TEST(EditDistance, IsZeroJustWhereNothingDiverges) {
  RandomStream random(1, "divergence");
  int matches = 0;
  for (int round = 0; round < 20000; ++round) {
    const Sets planned = RandomSequence(random, 3);
    const auto observed = Observed(RandomSequence(random, 4));
    const bool same = !FirstDivergence(planned, observed);
    EXPECT_EQ(same, EditDistance(planned, observed) == 0);
    matches += same ? 1 : 0;
  }
  EXPECT_GT(matches, 50) << "too few to tell anything";
}

TEST(EditDistance, IsOneOfOneChange) {
  const Sets planned = {Set({}), Set({1}), Set({1, 2}), Set({2})};
  EXPECT_EQ(EditDistance(planned, Observed(planned)), 0);
  EXPECT_EQ(EditDistance(planned, Observed({Set({}), Set({1}), Set({2})})), 1);
  EXPECT_EQ(EditDistance(planned, Observed({Set({}), Set({1}), Set({1, 3}), Set({2})})), 1);
  EXPECT_EQ(EditDistance(planned, Observed({Set({}), Set({1}), Set({1, 2}), Set({2}), Set({})})),
            1);
  EXPECT_EQ(EditDistance(planned, {}), 4);
}

TEST(FirstDivergence, ContactsMayBeLetGoInAnyOrder) {
  const Sets planned = {Set({}), Set({1}), Set({1, 2}), Set({1, 2, 3}), Set({})};
  const Sets made = {Set({}), Set({1}), Set({1, 2}), Set({1, 2, 3})};
  for (const Sets& way : {Sets{}, {Set({1, 2})}, {Set({2, 3}), Set({3})}, {Set({2})}}) {
    Sets observed = made;
    observed.insert(observed.end(), way.begin(), way.end());
    observed.push_back(Set({}));
    EXPECT_EQ(FirstDivergence(planned, Observed(observed)), std::nullopt);
    EXPECT_EQ(EditDistance(planned, Observed(observed)), 0);
  }
}

TEST(FirstDivergence, WhatIsMadeAgainWhileLettingGoIsOne) {
  const Sets planned = {Set({}), Set({1, 2, 3}), Set({})};
  const auto divergence =
      FirstDivergence(planned, Observed({Set({}), Set({1, 2, 3}), Set({1}), Set({1, 2}), Set({})}));
  ASSERT_TRUE(divergence);
  EXPECT_EQ(divergence->motion, 3);
  EXPECT_EQ(divergence->planned, Set({}));
  EXPECT_EQ(divergence->observed, Set({1, 2}));
}

TEST(FirstDivergence, WhatIsKeptMustNotBeLetGo) {
  const Sets planned = {Set({}), Set({1}), Set({1, 2, 3}), Set({1})};
  EXPECT_TRUE(FirstDivergence(
      planned, Observed({Set({}), Set({1}), Set({1, 2, 3}), Set({2, 3}), Set({1})})));
}

TEST(FirstDivergence, TellsWhatWasToComeAndWhatCame) {
  const Sets planned = {Set({}), Set({1}), Set({1, 2})};
  const auto wrong = FirstDivergence(planned, Observed({Set({}), Set({3}), Set({1, 3})}));
  ASSERT_TRUE(wrong);
  EXPECT_EQ(*wrong, (Divergence{1, 1, Set({1}), Set({3})}));
  const auto late = FirstDivergence(planned, Observed({Set({}), Set({1})}));
  ASSERT_TRUE(late);
  EXPECT_EQ(*late, (Divergence{1, 2, Set({1, 2}), std::nullopt}));
  const auto more = FirstDivergence(planned, Observed({Set({}), Set({1}), Set({1, 2}), Set({})}));
  ASSERT_TRUE(more);
  EXPECT_EQ(*more, (Divergence{3, 3, Set({1, 2}), Set({})}));
  const auto touching = FirstDivergence(planned, Observed({Set({1}), Set({1, 2})}));
  ASSERT_TRUE(touching);
  EXPECT_EQ(*touching, (Divergence{0, 0, Set({}), Set({1})}));
  EXPECT_TRUE(FirstDivergence(planned, {}));
}

// Returns a plan that starts free, moves to contact 1, and slides along it to contact 2.
PlannedContacts TwoContacts() {
  PlannedContacts planned;
  planned.states = {Set({}), Set({1}), Set({1, 2})};
  planned.motions = {{.before = {}, .kept = {}, .until = K(1), .after = Set({1})},
                     {.before = Set({1}), .kept = Set({1}), .until = K(2), .after = Set({1, 2})}};
  return planned;
}

TEST(Compare, AsPlannedNothingIsUnwanted) {
  const auto comparison = Compare(TwoContacts(), {{0, 0, 1, {}},
                                                  {0, 1, 1.1, Set({1})},
                                                  {1, 1.1, 2, Set({1})},
                                                  {1, 2, 2.01, Set({1, 3})},
                                                  {1, 2.01, 2.2, Set({1, 2})}});
  EXPECT_TRUE(comparison.matches());
  EXPECT_EQ(comparison.edit_distance, 0);
  EXPECT_THAT(comparison.events, IsEmpty()) << "a touch that is shorter than a state";
}

TEST(Compare, TellsWhatIsMadeAndWhatIsLost) {
  const auto comparison = Compare(
      TwoContacts(),
      {{0, 0, 1, {}}, {0, 1, 1.2, Set({1})}, {1, 1.2, 1.5, Set({3})}, {1, 1.5, 2.0, Set({1, 2})}});
  EXPECT_FALSE(comparison.matches());
  EXPECT_THAT(comparison.events,
              ElementsAre(ContactEvent{1, K(1), true}, ContactEvent{1, K(3), false}));
}

TEST(Compare, WhatIsWaitedForAndDoesNotComeIsLost) {
  const auto missed = Compare(TwoContacts(), {{0, 0, 1, {}}});
  EXPECT_THAT(missed.events, ElementsAre(ContactEvent{0, K(1), true}));
  const auto stopped = Compare(TwoContacts(), {{0, 0, 1, {}}, {0, 1, 2, Set({3})}});
  EXPECT_THAT(stopped.events, ElementsAre(ContactEvent{0, K(3), false}));
  ASSERT_TRUE(stopped.divergence);
  EXPECT_EQ(stopped.divergence->motion, 0);
}

}  // namespace
}  // namespace assay::check::sequence_comparison_test
