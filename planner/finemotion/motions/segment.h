#pragma once

#include <vector>

#include "planner/finemotion/contacts/contact_range.h"
#include "planner/finemotion/contacts/primitive_contact.h"
#include "planner/finemotion/motions/believed_pose.h"
#include "planner/finemotion/motions/segment_model.h"

namespace assay::finemotion {

// The distance, in metres, by which a kept contact may be beyond its limits, that is, beside its
// features.
inline constexpr double kLost = 2e-5;

// A contact that must not be made, or one that must not be lost because it is kept or waited for.
struct Unwanted {
  ContactKey contact;
  bool is_loss = false;
  // The least factor, among the tried ones, by which all errors must be enlarged so that the
  // contact or loss happens (motion_checker.h).
  double scale = 1;
};

// Counts the exact tests that decide whether a contact can be made. Where the paper's edge test
// (meeting.h) can be applied too, it also counts the contacts that the edge test misses.
struct TestComparison {
  int tests = 0;
  int compared = 0;
  int missed = 0;  // number of contacts that can be made, but are met by no edge

  TestComparison& operator+=(const TestComparison& other);
};

// The result of a command for any errors.
struct SegmentCheck {
  // The sequence of contact states is certain: nothing unwanted happens with the errors as they
  // are.
  bool certain = false;
  std::vector<Unwanted> unwanted = {};
  BelievedPose after = {};
  double longest = 1;  // greatest time of the motion; 1 is the time of the commanded displacement
  TestComparison comparison = {};
};

// The unwanted contacts and losses that a check reports.
enum class Telling {
  kFirst,  // only the first unwanted contact that is found
  kAll,
};

// Checks a command against all contacts with the exact test (meeting.h). The hand turns the part
// about the place where the hand believes the tip to be, so errors turn with the hand. Kept
// contacts may run off their ends by 20 micrometres and 2 milliradians, to make up for what linear
// rows leave out. If the result is not certain although nothing unwanted happens, there are three
// possible reasons. A contact of the command does not exist, tolerances separate kept contacts, or
// the contact that ends the motion does not surely come.
SegmentCheck Check(const SegmentModel& model, const BelievedPose& believed, const Command& command,
                   Telling telling = Telling::kFirst);

// Returns how far from the command's end without errors the part may touch something in the motion,
// and how far it may then be turned against its believed pose. `touching` holds at least the
// command's contacts. `size` is the distance in metres from the part's origin to its farthest
// feature.
ContactRange RangeOf(const SegmentModel& touching, const BelievedPose& believed,
                     const Command& command, double size);

}  // namespace assay::finemotion
