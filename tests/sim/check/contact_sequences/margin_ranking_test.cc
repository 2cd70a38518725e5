#include "sim/check/contact_sequences/margin_ranking.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace assay::check::margin_ranking_test {
namespace {

using finemotion::ContactKind;
using ::testing::SizeIs;

ContactKey K(int moving) { return {ContactKind::kVertexFace, moving, 0}; }

// Returns a plan of two motions with four unwanted contacts each. The contacts have the scales
// 1.25, 1.5, 2 and 3 in the order of their numbers.
finemotion::FineMotionPlan Plan() {
  finemotion::FineMotionPlan plan;
  plan.motions.resize(2);
  for (finemotion::CertainMotion& motion : plan.motions) {
    for (int i = 0; i < 4; ++i)
      motion.check.unwanted.push_back({K(i), false, finemotion::kLadder[i + 1]});
  }
  return plan;
}

SequenceComparison Trial(const std::vector<ContactEvent>& events, std::optional<int> left = {}) {
  SequenceComparison trial{.divergence = {}, .edit_distance = 0, .events = events};
  if (left) trial.divergence = Divergence{.motion = *left};
  return trial;
}

MarginRanking Ranked(const std::vector<SequenceComparison>& trials) {
  return RankMargins({}, Plan(), 0.01, trials);
}

TEST(MarginRanking, WithoutEventsThereIsNotEnoughVariation) {
  const MarginRanking ranking = Ranked({Trial({}), Trial({})});
  EXPECT_THAT(ranking.contacts, SizeIs(8));
  EXPECT_EQ(ranking.correlation, std::nullopt);
  EXPECT_EQ(ranking.interval, std::nullopt);
  EXPECT_THAT(Ranked({}).contacts, SizeIs(0));
}

// A contact with a smaller margin happens more often, so the rank correlation is 1.
TEST(MarginRanking, IsOneWhereTheOrderIsTheSame) {
  std::vector<SequenceComparison> trials;
  for (int trial = 0; trial < 40; ++trial) {
    std::vector<ContactEvent> events;
    for (int motion = 0; motion < 2; ++motion) {
      for (int i = 0; i <= trial % 4; ++i) events.push_back({motion, K(i), false});
    }
    trials.push_back(Trial(events));
  }
  const MarginRanking ranking = Ranked(trials);
  ASSERT_TRUE(ranking.correlation);
  EXPECT_NEAR(*ranking.correlation, 1, 1e-12);
  EXPECT_NEAR(ranking.contacts[1].Frequency(), 0.75, 1e-12);
  ASSERT_TRUE(ranking.interval);
  EXPECT_LE(ranking.interval->low, 1);
  EXPECT_NEAR(ranking.interval->high, 1, 1e-12);
}

// If contacts happen in only k of many trials, a fraction of about e^-k of the bootstrap draws
// contains none of these trials.
TEST(MarginRanking, AnIntervalTakesFourTrialsAndFourContacts) {
  const auto has_interval = [](int trials, int contacts) {
    std::vector<ContactEvent> events;
    for (int i = 0; i < contacts; ++i) events.push_back({i / 4, K(i % 4), false});
    std::vector<SequenceComparison> study(200, Trial({}));
    std::fill_n(study.begin(), trials, Trial(events));
    return Ranked(study).interval.has_value();
  };
  EXPECT_FALSE(has_interval(2, 8));
  EXPECT_FALSE(has_interval(3, 4));
  EXPECT_TRUE(has_interval(6, 4));
  EXPECT_FALSE(has_interval(20, 1));
}

TEST(MarginRanking, IsNegativeWhereThatOfTheGreatestMarginHappens) {
  const MarginRanking ranking = Ranked({Trial({{0, K(3), false}, {1, K(3), false}})});
  EXPECT_LT(*ranking.correlation, 0);
}

TEST(MarginRanking, ATrialCountsUpToWhereItLeftThePlan) {
  const MarginRanking ranking =
      Ranked({Trial({{0, K(0), false}, {1, K(1), false}}, 0), Trial({}, 1)});
  for (const RankedContact& contact : ranking.contacts) {
    EXPECT_EQ(contact.trials, contact.event.motion == 0 ? 2 : 1);
    const bool is_first = contact.event == ContactEvent{0, K(0), false};
    EXPECT_EQ(contact.happened, is_first ? 1 : 0);
  }
}

TEST(MarginRanking, WhatNoMarginTellsIsBeyondTheLadder) {
  const MarginRanking ranking = Ranked({Trial({{1, K(9), false}})});
  ASSERT_THAT(ranking.contacts, SizeIs(9));
  EXPECT_EQ(ranking.contacts.back().scale, finemotion::kBeyondLadder);
  EXPECT_LT(*ranking.correlation, 0);
}

}  // namespace
}  // namespace assay::check::margin_ranking_test
