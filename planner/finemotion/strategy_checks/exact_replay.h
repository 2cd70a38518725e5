#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "planner/base/random.h"
#include "planner/finemotion/contacts/round_contacts.h"
#include "planner/finemotion/strategy_search/maneuver.h"

namespace assay::finemotion {

// A part that moves in exact geometry: features are taken by their points and planes, and nothing
// is linearized. It moves in small steps, and after each step the least motion closes the kept
// contacts. Tolerances of the model are left out: their rows say how planes and ends of edges are
// displaced, but not how the outlines change that bound the points of a face.
class ExactPart {
 public:
  ExactPart(const Passage& passage, const Pose& X_StationaryMoving, double radius);

  const Pose& X() const { return X_; }

  // Moves the part by up to `most` displacements and returns the first contact that is made, or
  // none. Kept contacts are not considered. The part is turned about `believed`, the believed
  // position of the tip in metres.
  std::optional<ContactKey> Move(const Command& command, double most, Vector3 believed);
  // Returns whether the contact's point is at most `beside` metres beside its features.
  bool Touches(const ContactKey& key, double beside) const;

 private:
  struct Watched;

  std::vector<Watched> Apart(double travel) const;
  void Advance(const PoseChange& step, const Vector3& believed);
  void Close(std::span<const ContactKey> keys);

  const Passage& passage_;
  RoundContacts round_;
  Pose X_;
  double radius_;
  double size_ = 0;  // metres from the origin to the farthest corner
};

// A strategy's motions, and the settings of their replay. The slide in the crevice is left out,
// since walls lead it.
struct ExactReplay {
  const Passage& passage;
  Pose X_StationaryStart = Pose::Identity();
  std::span<const CertainMotion> motions;
  double radius = 0.02;         // metres; a rotation times this radius counts as a length
  double velocity_error = 0.0;  // as in SegmentModel; its signs are drawn
};

// A deviation of a replay from the plan. Either a motion makes another contact than the planned
// one, or it does not make the planned contact, or a kept contact leaves its features.
struct Deviation {
  PoseChange error = PoseChange::Zero();  // the error of the start
  std::size_t motion = 0;                 // index of the motion that deviates
  Unwanted unwanted = {};                 // the first that happens; its scale has no meaning
};

// Replays with the start displaced by `error`. Returns the first deviation, or none if all goes as
// planned.
std::optional<Deviation> DeviationOf(const ExactReplay& replay, const PoseChange& error,
                                     RandomStream& random);

// The result of replays with many errors.
struct ExactReplays {
  int tried = 0;
  std::optional<Deviation> deviation = {};  // the deviation of the first error that has one
};

// Replays with the errors of TrialErrors until one deviates. Equal seeds draw equal errors, as
// fractions of the half widths.
ExactReplays ReplayWithErrors(const ExactReplay& replay, const PoseChange& half_widths, int drawn,
                              std::uint64_t seed);

// Returns errors of the box with these half widths: its middle, its corners, the middles of its
// faces, then `drawn` errors from the whole box and as many from its surface.
std::vector<PoseChange> TrialErrors(const PoseChange& half_widths, int drawn, RandomStream& random);

}  // namespace assay::finemotion
