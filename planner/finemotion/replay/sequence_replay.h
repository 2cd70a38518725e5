#pragma once

#include <optional>
#include <vector>

#include "planner/finemotion/search/sequence_search.h"

namespace assay::finemotion {

// A step in which it is looked how great errors may be, as a factor.
inline constexpr double kGrowth = 1.06;

struct ReplayedSequence {
  bool certain = false;
  std::vector<CertainMotion> motions = {};  // the last one is that which is not
  // If it is not certain: the first that is found, if it is for a contact.
  std::optional<Unwanted> unwanted = {};
};

// A sequence of maneuvers from other starts, and with larger errors, than it was found with.
class SequenceReplay {
 public:
  // The problem's multiple does not count.
  SequenceReplay(const SequenceProblem& problem, Starts& starts)
      : problem_(problem), starts_(starts) {}

  ReplayedSequence Replay(const Sequence& sequence, double multiple, Margins margins);

  // Moves the start at random, less and less, and keeps it where more is absorbed than `absorbed`.
  // The multiple of the errors that is absorbed at last.
  double Widen(Sequence& sequence, double absorbed);

  int replayed() const { return replayed_; }  // so far
  const TestComparison& comparison() const { return comparison_; }

 private:
  SequenceProblem problem_;
  Starts& starts_;
  int replayed_ = 0;
  TestComparison comparison_ = {};
};

}  // namespace assay::finemotion
