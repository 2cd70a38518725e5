#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "planner/base/interval.h"
#include "planner/finemotion/strategy_search/strategy_search.h"
#include "sim/check/contact_sequences/sequence_comparison.h"

namespace assay::check {

// A contact or loss that must not happen in a motion, with its margin and how often it happened.
struct RankedContact {
  ContactEvent event;
  // The least enlargement of the errors that makes it happen (finemotion::Unwanted); kBeyondLadder
  // if no enlargement that was checked does.
  double scale = 0;
  int happened = 0;  // number of trials in which it happened
  int trials = 0;    // number of trials that came to this motion as planned

  double Frequency() const;  // 0 without trials
};

// The comparison of the planner's margins with how often unwanted contacts happened in trials.
struct MarginRanking {
  std::vector<RankedContact> contacts = {};  // in motions that a trial came to; ordered by event
  // Spearman's coefficient between smallness of margin and frequency; 1 if the order is the same.
  // It is missing if there is not enough variation, for instance if nothing happened.
  std::optional<double> correlation = {};
  // The interval that holds the correlation with 95 % confidence, by a bootstrap over both trials
  // and contacts (Efron 1979) with 1000 draws. Draws without variation are left out. The interval
  // is missing if more draws were left out than one tail of the interval has, because the interval
  // would then depend on the remaining draws alone. If k of n trials had anything unwanted in them,
  // a draw misses all k with probability (1 - k/n)^n, about e^-k. The same holds for contacts, so
  // at least four of each are needed.
  std::optional<Interval> interval = {};
};

inline constexpr std::uint64_t kRankingSeed = 1;

// Compares margins with frequencies for all contacts that the planner looked at within `reach`
// metres of where a motion leads. The comparison includes contacts that no checked enlargement of
// the errors makes, and the losses of all contacts that the plan keeps or waits for. A trial counts
// up to the motion in which it first left the plan, because margins predict nothing after that.
MarginRanking RankMargins(const finemotion::Passage& passage,
                          const finemotion::FineMotionPlan& plan, double reach,
                          std::span<const SequenceComparison> trials);

}  // namespace assay::check
