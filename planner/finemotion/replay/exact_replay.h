#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "planner/base/random.h"
#include "planner/finemotion/search/maneuver.h"

namespace assay::finemotion {

// A part that moves in exact geometry, features taken by their points and planes and nothing made
// linear. It goes on in small steps, after each of which kept contacts are closed by the least
// motion. Tolerances of the model are left out: their rows tell how planes and ends of edges are
// displaced, but not what then becomes of the outlines that points of a face are to be within.
class ExactPart {
 public:
  ExactPart(const Passage& passage, const Pose& X_StationaryMoving, double radius);

  const Pose& X() const { return X_; }

  // What is made first on the way to `most` displacements, kept contacts aside; none: nothing. The
  // part is turned about `believed`, where the tip is believed to be, metres.
  std::optional<ContactKey> Move(const Command& command, double most, Vector3 believed);
  // At most so far beside its features, metres.
  bool Touches(const ContactKey& key, double beside) const;

 private:
  struct Watched;

  std::vector<Watched> Apart(double travel) const;
  void Advance(const PoseChange& step, const Vector3& believed);
  void Close(std::span<const ContactKey> keys);

  const Passage& passage_;
  Pose X_;
  double radius_;
  double size_ = 0;  // metres, of the farthest corner
};

// A strategy's motions and what they are to be replayed with. The slide in the crevice is none of
// them: walls lead it.
struct ExactReplay {
  const Passage& passage;
  Pose X_StationaryStart = Pose::Identity();
  std::span<const CertainMotion> motions;
  double radius = 0.02;         // metres; what a radian comes to
  double velocity_error = 0.0;  // as SegmentModel; its signs are drawn
};

// Where a replay goes otherwise than planned: another contact comes than the planned one, or none,
// or a kept one is off its features.
struct Deviation {
  PoseChange error = PoseChange::Zero();  // the start's
  std::size_t motion = 0;                 // index
  Unwanted unwanted = {};                 // what is first; its scale tells nothing
};

// The first where the start is displaced by `error`; none: all goes as planned.
std::optional<Deviation> DeviationOf(const ExactReplay& replay, const PoseChange& error,
                                     RandomStream& random);

// What came of replays with many errors.
struct ExactReplays {
  int tried = 0;
  std::optional<Deviation> deviation = {};  // of the first error that has one
};

// With the trial errors of a box with these half widths (below), until one goes otherwise. The same
// seed draws the same errors, in shares of the half widths.
ExactReplays ReplayWithErrors(const ExactReplay& replay, const PoseChange& half_widths, int drawn,
                              std::uint64_t seed);

// Errors at the corners, in the middle and in the middles of the faces of a box with these half
// widths; then so many drawn from all of it, and as many from its surface.
std::vector<PoseChange> TrialErrors(const PoseChange& half_widths, int drawn, RandomStream& random);

}  // namespace assay::finemotion
