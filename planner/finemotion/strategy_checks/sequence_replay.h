#pragma once

#include <optional>
#include <vector>

#include "planner/finemotion/strategy_search/sequence_search.h"

namespace assay::finemotion {

// The factor between successive multiples of the errors in a search for the greatest one.
inline constexpr double kGrowth = 1.06;

struct ReplayedSequence {
  bool certain = false;
  // If the sequence is not certain, the motion that is not certain is the last one.
  std::vector<CertainMotion> motions = {};
  // The first unwanted contact found, if a contact is the reason why the sequence is not certain.
  std::optional<Unwanted> unwanted = {};
};

// Replays a sequence of maneuvers from other starts, and with larger errors, than those with which
// the sequence was found.
class SequenceReplay {
 public:
  // The multiple of the errors in `problem` is ignored; Replay has its own argument for it.
  SequenceReplay(const SequenceProblem& problem, Starts& starts)
      : problem_(problem), starts_(starts) {}

  ReplayedSequence Replay(const Sequence& sequence, double multiple, Margins margins);

  // Moves the start at random in smaller and smaller steps, and keeps a start that absorbs more
  // than `absorbed`. Returns the multiple of the errors that is absorbed in the end.
  double Widen(Sequence& sequence, double absorbed);

  int replayed() const { return replayed_; }  // number of replays so far
  const TestComparison& comparison() const { return comparison_; }

 private:
  SequenceProblem problem_;
  Starts& starts_;
  int replayed_ = 0;
  TestComparison comparison_ = {};
};

}  // namespace assay::finemotion
