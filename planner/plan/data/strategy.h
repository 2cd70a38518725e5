#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planner/geometry/pose.h"

namespace assay::plan {

using geometry::Pose;
using geometry::Vector3;

// Metres: as hybrid control tells contacts apart by a wrench, a turn of a radian is as easy as such
// a shift.
inline constexpr double kTurnLever = 0.2;

// By how much the length of a normal, and the columns of a rotation, may differ from unit length.
inline constexpr double kUnit = 1e-6;

// One way in which the parts of a mating touch: a row of generalized contact space (Dakin and
// Popplestone, section 3). All in the fixed part's axes.
struct StrategyContact {
  std::string name;                  // "vertex 3 on face 1"
  Vector3 normal = Vector3::Zero();  // from the fixed part into free space, unit
  Vector3 at = Vector3::Zero();      // from the tip's origin, metres
};

// Where the tip is, seen from where it is believed to be at the start, in the fixed part's axes.
struct TipError {
  Vector3 d = Vector3::Zero();  // metres
  Vector3 w = Vector3::Zero();  // rotation vector, radians
};

// A contact that a motion must not make; or must not lose, if it is kept or waited for. The error
// state is then that of the contacts that are kept and this one, or of the planned ones but this.
struct UnwantedContact {
  int contact = 0;  // index in Strategy::contacts
  bool is_loss = false;
  double scale = 0;       // the least enlargement of all errors, of a ladder, at which it happens
  double gap = 0;         // metres, where the motion leads if there are no errors
  double separation = 0;  // of the error state's force signature from the planned one's, 0 .. 1
  std::optional<TipError> likely = {};  // mean of the errors that lead to it; none: not known
};

// One segment of a piecewise-linear trajectory: a contact state to be in, where to go in it, and
// what ends it (figure 3 of the paper). What of the motion is along the normals of the contacts
// that are kept is left to force control; the rest is position-controlled.
//
// It is over when the tip bears a wrench of the contact state after it: of the force signature of
// what is kept and waited for, with a part that only what is waited for explains.
struct StrategyMotion {
  std::vector<int> kept;     // contacts that are pressed on all the way; indices
  Pose X_FixedTip;           // where it leads if there are no errors; the way is straight, and the
                             // rotation about one axis
  std::optional<int> until;  // the contact that ends it; none: the motion as a whole
  double beyond = 0;    // how much farther it may go until that is made, in lengths of the motion
  bool slides = false;  // in a crevice: all but the motion's direction is force-controlled,
                        // to nothing
  std::vector<UnwantedContact> unwanted = {};  // by rising scale; of those on the ladder
};

// What is certain of a strategy: all its motions come about as planned while the tip is where it is
// believed to be, but for these errors. All in the fixed part's axes.
struct StrategyCertificate {
  std::vector<std::string> absorbs = {};  // conditions of the step that need not hold
  Vector3 d = Vector3::Zero();            // half widths: metres the tip may be displaced,
  Vector3 w = Vector3::Zero();            // and components of the rotation vector, radians
  double velocity = 0;                    // what directions of motion err by, a share
  // The least friction of the parts that could hold one in a motion before the last, however hard
  // it is pushed.
  double friction = 0;
  double absorbed = 0;  // the greatest multiple of d and w for which all is certain; >= 1
};

// A fine-motion plan as hybrid control runs it (Dakin and Popplestone, sections 2 and 5).
struct Strategy {
  Pose X_HeldTip;     // the tip: the point and axes in which errors and rotations are told
  Pose X_FixedStart;  // of the tip, where the first motion starts; in free space
  std::vector<StrategyContact> contacts;
  std::vector<StrategyMotion> motions;
  double friction = 0;   // of the parts at the contacts: how wide force signatures are
  double length = 0.02;  // metres that torques are divided by to compare with forces
  StrategyCertificate certificate = {};
};

std::vector<StrategyContact> ContactsAt(const Strategy& strategy, const std::vector<int>& indices);
// Indices of the contacts that touch after a motion as planned, and in an error state of it.
std::vector<int> ContactsAfter(const StrategyMotion& motion);
std::vector<int> ContactsInError(const StrategyMotion& motion, const UnwantedContact& unwanted);

// Whether the step's condition (CertifiedPrecondition::condition) need not hold, since its strategy
// takes care of it.
bool Absorbs(const std::optional<Strategy>& strategy, std::string_view condition);

// What makes it no strategy, in words; empty: nothing. That its numbers mean something is not that
// it works (planner/finemotion/replay/strategy_check.h).
std::vector<std::string> FlawsOfForm(const Strategy& strategy);

}  // namespace assay::plan
