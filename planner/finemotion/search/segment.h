#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "planner/finemotion/contacts/contact_range.h"
#include "planner/finemotion/contacts/parallel_edges.h"
#include "planner/finemotion/contacts/primitive_contact.h"

namespace assay::finemotion {

// A change of the moving part's pose: d added, turned by w about its origin. The pose's part of a
// point of generalized space.
using PoseChange = Eigen::Matrix<double, kPoseDimensions, 1>;
using PoseChanges = Eigen::Matrix<double, kPoseDimensions, Eigen::Dynamic>;  // a column each

// What is known of where the moving part is: nominally at X, displaced by errors.col(i) times any
// factor in -1 .. 1, for all i, and in contact with what it keeps. The first factors are also those
// of the model's tolerances, in their half widths.
struct Belief {
  Pose X_StationaryMoving = Pose::Identity();
  PoseChanges errors;
  std::vector<ContactKey> kept = {};
  Eigen::VectorXd tolerances = {};  // half widths, metres
};

// By how much errors can change the value of a row.
double ErrorOf(const SmallVector& row, const Belief& belief);

Pose Displaced(const Pose& X_StationaryMoving, const PoseChange& z);
// The change by which `from` is displaced to `to`.
PoseChange Between(const Pose& from, const Pose& to);

// The least change of a pose, from z, that closes the contacts' gaps to first order; rotations
// count as lengths at `radius`.
PoseChange Closing(const std::vector<const PrimitiveContact*>& contacts, const PoseChange& z,
                   double radius);

// A straight motion in a contact state, and what ends it.
struct Command {
  PoseChange displacement;       // without errors it leads so far
  std::vector<ContactKey> kept;  // of those there were; the others are let go
  std::optional<ContactKey> until = {};
};

// Metres that kept contacts may be beyond their limits, beside their features.
inline constexpr double kLost = 2e-5;

// A contact that must not be made, or one that must not be lost: that is kept, or waited for.
struct Unwanted {
  ContactKey contact;
  bool is_loss = false;
  // The least enlargement of all errors, of the ladder, at which it happens (margins.h).
  double scale = 1;
};

// How many exact tests whether a contact can be made there were, and of those in which the paper's
// edge test (meeting.h) is applicable how many it answers otherwise.
struct TestComparison {
  int tests = 0;
  int compared = 0;
  int missed = 0;  // a contact that can be made, but at no edge

  TestComparison& operator+=(const TestComparison& other);
};

// What becomes of a command, whatever the errors.
struct SegmentCheck {
  // The sequence of contact states is certain: nothing unwanted happens with errors as they are.
  bool certain = false;
  std::vector<Unwanted> unwanted = {};
  Belief after = {};
  double longest = 1;  // how many displacements it may take at most
  TestComparison comparison = {};
};

// How it is decided whether errors can bring a contact about.
enum class MeetingTest {
  kExact,
  kEdges,    // the paper's, where there are few enough errors; it misses some
  kCompare,  // exact, and compared with the paper's
};

struct SegmentModel {
  // Linearized where the command leads without errors.
  const std::vector<PrimitiveContact>& contacts;
  // Of a displacement: of its length, and of its turn times the radius, in each direction; of its
  // turn about each axis.
  double velocity_error = 0.02;
  double radius = 0.02;  // metres
  MeetingTest test = MeetingTest::kExact;
  // Those that are no contacts, as they are there, too. None of them may touch.
  std::span<const ParallelEdges> parallel_edges = {};
};

enum class Telling {
  kFirst,  // of what is unwanted only the first that is found
  kAll,
};

// A loop over all contacts with the exact test (meeting.h). The hand turns the part about where it
// believes the tip to be, so that errors turn with it. Kept contacts may run off their ends by 20
// micrometres and 2 milliradians, which is what linear rows leave out. Not certain, with nothing
// unwanted: a contact of the command is not there, tolerances part kept contacts, or its end never
// surely comes.
SegmentCheck Check(const SegmentModel& model, const Belief& belief, const Command& command,
                   Telling telling = Telling::kFirst);

// From where the command leads without errors, how far away the part can touch something in the
// motion, and how far it can be turned against its belief. `touching`: the command's contacts, or
// more. `size`: how far from its origin the part has features, metres.
ContactRange RangeOf(const SegmentModel& touching, const Belief& belief, const Command& command,
                     double size);

}  // namespace assay::finemotion
