#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "planner/base/interval.h"
#include "planner/finemotion/search/strategy_search.h"
#include "sim/check/contacts/sequence_comparison.h"

namespace assay::check {

// Something that is not to happen in a motion, by its margin and by trials.
struct RankedContact {
  ContactEvent event;
  double scale = 0;  // finemotion::Unwanted; kBeyondLadder: not on the ladder
  int happened = 0;  // in so many trials
  int trials = 0;    // of those that came to this motion as planned

  double Frequency() const;  // 0 without trials
};

// Whether what the planner's margins say is likelier happened more often.
struct MarginRanking {
  std::vector<RankedContact> contacts = {};  // of motions that a trial came to; by event
  // Spearman's coefficient of smallness of margin and frequency; 1: the order is the same. None:
  // not enough variation, as when nothing happened.
  std::optional<double> correlation = {};
  // In which it lies with 95 % confidence: by drawing both trials and contacts anew (Efron 1979),
  // 1000 times; draws without variation are left out. None: too little happened. More draws would
  // be left out than a tail of the interval has, and it would be one of the others alone. Of n
  // trials k of which had anything unwanted in them, a draw misses all with probability (1 -
  // k/n)^n, about e^-k, and so with contacts: it takes four of each at least.
  std::optional<Interval> interval = {};
};

inline constexpr std::uint64_t kRankingSeed = 1;

// Of all contacts that the planner looked at, within `reach` metres of where a motion leads, also
// of those that no enlargement of the ladder makes, and of the losses of all that it keeps or
// waits for. A trial counts up to the motion in which it first left the plan: nothing is said of
// what comes after that.
MarginRanking RankMargins(const finemotion::Passage& passage,
                          const finemotion::FineMotionPlan& plan, double reach,
                          std::span<const SequenceComparison> trials);

}  // namespace assay::check
