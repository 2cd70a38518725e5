#include "planner/finemotion/strategy_checks/sequence_replay.h"

#include <algorithm>
#include <iterator>

namespace assay::finemotion {

namespace {

// The sizes of the steps in the local search for a better start, as fractions of the range from
// which starts are drawn.
constexpr double kFirstStep = 0.3;
constexpr double kLeastStep = 0.02;

// Returns the first unwanted contact that happens with the errors as they are.
std::optional<Unwanted> FirstOf(const SegmentCheck& check) {
  if (check.unwanted.empty() || check.unwanted.front().scale > 1) return std::nullopt;
  return check.unwanted.front();
}

}  // namespace

ReplayedSequence SequenceReplay::Replay(const Sequence& sequence, double multiple,
                                        Margins margins) {
  ++replayed_;
  ReplayedSequence replay;
  const auto holds = [&](const SegmentCheck& check) {
    if (!check.certain) replay.unwanted = FirstOf(check);
    return check.certain;
  };
  BelievedPose believed = starts_.BelievedPoseAt(sequence.start, multiple);
  std::size_t point = 0;
  const auto& maneuvering = problem_.maneuvering;
  if (!holds(maneuvering[point].CheckReached(believed))) return replay;
  for (const Maneuver& maneuver : sequence.maneuvers) {
    const int here = static_cast<int>(point);
    const int after = PointAfter(maneuver, here);
    if (after != here && !holds(maneuvering[point].CheckThrough(believed))) return replay;
    Maneuvered done = maneuvering[point].Apply(maneuvering[point].At(believed), maneuver, margins);
    comparison_ += done.Comparison();
    for (CertainMotion& motion : done.motions) motion.critical_point = here;
    if (!done.certain && !done.motions.empty()) holds(done.motions.back().check);
    std::ranges::move(done.motions, std::back_inserter(replay.motions));
    if (!done.certain) return replay;
    believed = std::move(done.after);
    point = static_cast<std::size_t>(after);
  }
  replay.certain = holds(maneuvering[point].CheckThrough(believed));
  return replay;
}

double SequenceReplay::Widen(Sequence& sequence, double absorbed) {
  double size = kFirstStep;
  const StrategyOptions& options = problem_.options;
  for (int i = 0; i < options.tries && absorbed < options.greatest; ++i) {
    const Start moved = i == 0 ? sequence.start : starts_.Near(sequence.start, size);
    if (Replay({moved, sequence.maneuvers}, kGrowth * absorbed, Margins::kNone).certain) {
      sequence.start = moved;
      absorbed *= kGrowth;
      size = std::min(kFirstStep, 1.5 * size);
    } else {
      size = std::max(kLeastStep, 0.97 * size);
    }
  }
  return absorbed;
}

}  // namespace assay::finemotion
