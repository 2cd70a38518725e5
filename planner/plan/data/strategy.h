#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/geometry/coordinates.h"
#include "planner/plan/certificates/condition.h"

namespace assay::plan {

using geometry::Pose;
using geometry::Vector3;

// Lever, in metres, that compares turns with shifts: hybrid control distinguishes contacts by a
// wrench, and takes a turn of one radian to be as easy as a shift by this length.
inline constexpr double kTurnLever = 0.2;

// Greatest difference from unit length of a normal, and of the columns of a rotation.
inline constexpr double kUnit = 1e-6;

// One way in which the parts of a mating touch: a row of generalized contact space (Dakin and
// Popplestone, section 3). Everything is in the fixed part's axes.
struct StrategyContact {
  std::string name;                  // "vertex 3 on face 1"
  Vector3 normal = Vector3::Zero();  // unit vector from the fixed part into free space
  Vector3 at = Vector3::Zero();      // position relative to the tip's origin, metres
};

// The tip's pose relative to its believed pose at the start, in the fixed part's axes.
struct TipError {
  Vector3 d = Vector3::Zero();  // metres
  Vector3 w = Vector3::Zero();  // rotation vector, radians
};

// An event that makes a motion fail: the motion makes a contact that it must not make, or it loses
// a planned contact. The planned contacts are the kept contacts and the awaited contact. The motion
// loses the awaited contact if this contact is missing where it should exist. After a new contact,
// the error state has the kept contacts and the new one. After a loss, it has all planned contacts
// but the lost one.
struct UnwantedContact {
  int contact = 0;  // index in Strategy::contacts
  bool is_loss = false;
  // The least factor on all errors, among the tried factors, with which the contact or loss
  // happens.
  double scale = 0;
  double gap = 0;  // width at the end of the motion without errors, metres
  // Distance between the force signatures of the error state and the plan, 0 .. 1.
  double separation = 0;
  // The mean of the errors that lead to this error state; none: not known.
  std::optional<TipError> likely = {};
};

// One segment of a piecewise-linear trajectory: a contact state to keep, a direction to move in it,
// and a contact that ends it (figure 3 of the paper). The motion's components along the normals of
// the kept contacts are left to force control. The rest is position-controlled.
//
// The motion is over when the tip bears a wrench of the next contact state: one in the force
// signature of the kept and the awaited contacts, with a component that only the awaited contact
// explains.
struct StrategyMotion {
  std::vector<int> kept;  // contacts that are pressed on all the way; indices
  Pose X_FixedTip;  // end pose without errors; the way is straight, with a rotation about one axis
  std::optional<int> until;  // the contact that ends it; none: the motion as a whole
  // The distance by which the motion may go beyond its end until that contact is made, as a
  // multiple of the motion's length.
  double beyond = 0;
  bool slides = false;  // in a crevice: all but the motion's direction is force-controlled to zero
  // The unwanted contacts that happen with one of the tried factors on all errors, in ascending
  // order of UnwantedContact::scale.
  std::vector<UnwantedContact> unwanted = {};
};

// The guarantee of a strategy: all its motions happen as planned while the tip is at its believed
// pose up to these errors. Everything is in the fixed part's axes.
struct StrategyCertificate {
  std::vector<Condition> absorbs = {};  // conditions of the step that need not hold
  Vector3 d = Vector3::Zero();          // half widths of the tip's displacement, metres
  Vector3 w = Vector3::Zero();          // half widths of the rotation vector's components, radians
  double velocity = 0;                  // error of directions of motion, as a share of the motion
  // Least friction at which a part could be held fast in a motion before the last, however hard it
  // is pushed.
  double friction = 0;
  double absorbed = 0;  // greatest multiple of d and w for which the guarantee holds; >= 1
};

// A fine-motion plan in the form in which hybrid control executes it (Dakin and Popplestone,
// sections 2 and 5).
struct Strategy {
  Pose X_HeldTip;     // the tip: reference point and axes of errors and rotations
  Pose X_FixedStart;  // the tip's pose where the first motion starts, in free space
  std::vector<StrategyContact> contacts;
  std::vector<StrategyMotion> motions;
  // Friction of the parts at the contacts; it sets the width of force signatures.
  double friction = 0;
  double length = 0.02;  // torques are divided by it to compare with forces, metres
  StrategyCertificate certificate = {};
};

std::vector<StrategyContact> ContactsAt(const Strategy& strategy, const std::vector<int>& indices);
// Return the indices of the contacts that touch after a motion as planned, and in an error state of
// the motion.
std::vector<int> ContactsAfter(const StrategyMotion& motion);
std::vector<int> ContactsInError(const StrategyMotion& motion, const UnwantedContact& unwanted);

// Returns whether the condition of a step need not hold, since the step's strategy absorbs it.
bool Absorbs(const std::optional<Strategy>& strategy, Condition condition);

// Returns, in words, the reasons why the strategy is not well formed; empty if it is well formed. A
// well-formed strategy need not work (planner/finemotion/strategy_checks/strategy_check.h).
std::vector<std::string> FlawsOfForm(const Strategy& strategy);

}  // namespace assay::plan
