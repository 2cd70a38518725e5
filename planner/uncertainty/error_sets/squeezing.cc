#include "planner/uncertainty/error_sets/squeezing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "planner/algebra/expression/simplify.h"
#include "planner/domain/parts/part_model.h"
#include "planner/geometry/pose.h"
#include "planner/geometry/solids/mass_properties.h"
#include "planner/uncertainty/error_sets/axis_angle.h"
#include "planner/uncertainty/error_sets/possible_masses.h"
#include "planner/uncertainty/pads/contact_patch.h"
#include "planner/uncertainty/pads/grip.h"
#include "planner/uncertainty/pads/roll_of_part.h"
#include "planner/uncertainty/standing/tilting.h"
#include "planner/uncertainty/standing/turn_of_push.h"

namespace assay::uncertainty {
namespace {

// The way by which the friction of a pushed part moves the hand, in metres per newton. Servos
// as stiff as those of `assay tune` hold a hand to about 4 micrometres per newton. While the pads
// close, the servos are 16 times as stiff (sim/execution, Execution::Brace).
constexpr double kGivePerNewton = 2.5e-7;
constexpr double kLeastSliding = 1e-3;  // the least share of a push that moves the part
// The share of the friction with which pads jam on a part that is hardly turned, up to which they
// surely turn it flat. With more friction, the moment that turns the part is so small that soft
// contacts leave a part of the turn: in MuJoCo, 0.009 degrees at a share of 0.83.
constexpr double kSurelyFlat = 0.8;
constexpr double kLeastGive = 1e-6;  // metres; a shift of less is lost in the motion of the fingers

HeldError AsPublished(const UncertainWorld& world, PartId part, const plan::Hold& hold) {
  Pose R_WorldTool = world.X_WorldPart(part) * hold.X_PartTool;
  R_WorldTool.translation().setZero();
  const SymbolicVector D = algebra::Simplify(algebra::Inverse(AsTransform(R_WorldTool)) *
                                             world.resting(part).displacement);
  return {.x = D[0], .z = D[2]};
}

// Returns where the grasped point is before the pads close, in the frame of the true hand.
SymbolicVector GraspedPoint(const UncertainWorld& world, PartId part, const plan::Hold& hold,
                            const ManipulatorError& draw) {
  const Pose X_WorldTool = world.X_WorldPart(part) * hold.X_PartTool;
  const Transform X_TrueHandPart = algebra::Inverse(AsTransform(X_WorldTool) * draw.AsTransform()) *
                                   PossiblePose(world.X_WorldPart(part), world.resting(part));
  return algebra::Simplify(X_TrueHandPart * AsTransform(hold.X_PartTool).translation);
}

// Returns the greatest friction at the support of any part. What a part stands on may be rougher
// than the part.
double GreatestFriction(const domain::Problem& problem) {
  double friction = 0;
  for (const domain::Part& part : problem.parts)
    friction = std::max(friction, part.model->friction());
  return friction + problem.tolerances.friction;
}

// Returns how far friction at the part's support may move the hand in any horizontal direction,
// while the pads push the part. `up` is the vertical, in the tool's axes.
double GiveOfHand(const domain::Problem& problem, PartId part, const Vector3& up) {
  const double friction = GreatestFriction(problem);
  // A push that is not horizontal presses the part down or lifts it. If it is so steep that the
  // part does not slide, the part is not proved to stay upright.
  const double sliding = std::hypot(up.x(), up.z()) - friction * std::abs(up.y());
  const double push = GreatestWeight(problem, part) * friction / std::max(sliding, kLeastSliding);
  const double give = kGivePerNewton * push;
  return give > kLeastGive ? give : 0;
}

// Returns the part of the contact's length, in metres, whose moment under the force of the grip
// overcomes the friction at the part's support. The part turns about that point between the pads
// at which friction resists least. `off` is by how much the part may be displaced along the pads.
double LengthAgainstSupport(const UncertainWorld& world, PartId part, const plan::Hold& hold,
                            double off) {
  const domain::Problem& problem = world.problem();
  const Pose X_WorldTool = world.X_WorldPart(part) * hold.X_PartTool;
  const auto at = [&](double y) -> Vector2 { return (X_WorldTool * Vector3(0, y, 0)).head<2>(); };
  const double radius = RadiusAgainstTurn(world, part, world.X_WorldPart(part),
                                          {at(-hold.width / 2), at(hold.width / 2)});
  return GreatestFriction(problem) * GreatestWeight(problem, part) * (radius + off) /
         problem.workcell->rules().grip_force;
}

// Returns the least and the greatest distance, in metres along an axis of the tool, between the
// middle of the pads and the centre of mass of the part. The part may be displaced by `off` metres,
// and turned by up to `turned` radians.
Interval OffsetOfMass(const UncertainWorld& world, PartId part, const plan::Hold& hold,
                      const Vector3& axis, double turned, double off) {
  Interval offset = {std::numeric_limits<double>::infinity(), 0};
  for (const geometry::MassProperties& mass : PossibleMasses(world.problem(), part)) {
    const Vector3 center = hold.X_PartTool.inverse() * mass.center;
    const double doubt = off + center.norm() * std::sin(std::min(turned, kRightAngle));
    const double nominal = std::abs(axis.dot(center));
    offset.low = std::min(offset.low, std::max(0.0, nominal - doubt));
    offset.high = std::max(offset.high, nominal + doubt);
  }
  return offset;
}

// The greatest effect that closing the pads may have on the part. Angles are in radians and lengths
// in metres, about and along the tool's axes; all of them are magnitudes.
class Closing {
 public:
  Closing(const UncertainWorld& world, PartId part, const plan::Hold& hold,
          const ManipulatorError& draw, const SymbolicVector& grasped)
      : up_(VerticalInTool(world.X_WorldPart(part) * hold.X_PartTool)),
        pad_x_(world.problem().workcell->gripper().pad_half_extents().x()),
        pad_z_(world.problem().workcell->gripper().pad_half_extents().y()),
        hand_(Magnitude(world.RangeOf(draw.theta))),
        off_x_(Magnitude(world.RangeOf(grasped[0]))),
        off_y_(Magnitude(world.RangeOf(grasped[1]))),
        off_z_(Magnitude(world.RangeOf(grasped[2]))),
        pad_friction_(PossiblePadFriction(world.problem())) {
    NotePatch(world, part, hold);
    const double theta = Magnitude(world.RangeOf(world.resting(part).theta));
    pushed_turn_ = TurnOfFirstPad(world, part, hold, theta + hand_);
    turn_ = AtMostRight(theta + pushed_turn_ + hand_);
    // The greatest friction covers every case: jammed pads may also leave the part flat.
    const double length = ContactLength() - LengthAgainstSupport(world, part, hold, Displaced());
    jams_ = !(turn_ + std::atan(pad_friction_.high) < std::atan(length / hold.width)) ||
            !(pad_friction_.high < kSurelyFlat * length / hold.width);
    if (jams_ && is_straight()) NoteRoundSide(world, part, hold);
    // If a part is turned too far, the pads press on it beside each other. They then do not turn it
    // back, but farther, until it lies on other faces.
    if (jams_ && !(turn_ < SteepestTurn(world, part, hold))) turn_ = kRightAngle;
    lever_ = LeverOfTurn(world, part, hold, turn_);
    way_ = turn_ + pushed_turn_;
    if (!is_straight())
      tilted_ = MovedByTilt(world, part, hold, SwingOf(hand_, up_.z()), Displaced());
    // If the hand points straight down, its error is a turn about the vertical, which does not tilt
    // the pads.
    roll_ = RollOfPart(world, part, hold, {turn_, is_straight() ? 0 : hand_, Displaced()});
  }

  bool pushes() const { return off_y_ + way_ > 0; }
  const Vector3& up() const { return up_; }  // in the tool's axes
  bool jams() const { return jams_; }
  bool is_round() const { return is_round_; }
  double turn() const { return turn_; }  // between faces and pads, when they touch
  double pushed_turn() const { return pushed_turn_; }

  // Returns how much of the part's total turn is about an axis, in radians. The part may roll about
  // the closing direction. In a tool that leans, flat faces follow the hand's own rotation out of
  // the vertical. Rotations about two axes together turn the part about the third axis by up to
  // their product.
  double TurnAbout(int axis) const {
    const double roll = axis == 1 ? roll_.angle : 0;
    if (is_straight()) return axis == 2 ? way_ : roll;
    const double products = up_.y() == 0 && !jams_ ? 0 : way_ * way_;
    const double hand = axis == 1 ? way_ + hand_ : 1 + way_;
    return std::min(TwistOf(AtMostRight(way_), up_[axis]) + products + hand_ * hand + roll,
                    std::numbers::pi);
  }

  double SlipX() const {
    if (is_round()) return RoundSlip();
    if (is_straight()) return StraightSlip() + roll_.way;
    const Vector3 way = WaysOfGraspedPoint();
    return way.x() + turn_ * (way.y() + way.z());
  }
  double SlipZ() const {
    if (is_straight()) return roll_.way;
    const Vector3 way = WaysOfGraspedPoint();
    return way.z() + turn_ * (way.x() + way.y());
  }
  // Returns the y error of a part that jammed: its two contacts lie within the pads, equally far
  // from the middle.
  double SkewY() const { return 2 * (pad_x_ + pad_z_) * std::sin(turn_); }

 private:
  static double AtMostRight(double angle) { return std::min(angle, kRightAngle); }

  bool is_straight() const { return std::abs(up_.z()) == 1; }
  double Displaced() const { return std::hypot(off_x_, off_z_); }  // along the pads

  // Notes the area that both pads surely touch opposite each other, if the pads close on two faces
  // of the part and do not lie wholly on these faces.
  void NotePatch(const UncertainWorld& world, PartId part, const plan::Hold& hold) {
    const domain::PartModel& model = *world.problem().part(part).model;
    const Vector2 pad(pad_x_, pad_z_);
    const bool on_faces = FaceAt(model, hold, 1) != nullptr && FaceAt(model, hold, -1) != nullptr;
    stay_on_faces_ = LieOnFaces(model, hold, pad + Vector2(off_x_, off_z_));
    if (!on_faces || LieOnFaces(model, hold, pad)) return;
    const geometry::Patches patch = OppositePatch(model, hold, pad - Vector2(off_x_, off_z_));
    patch_ = BoundsOf(patch);
    const Vector3 level = Level();
    for (const geometry::Polygon& polygon : patch) {
      for (const Vector2& p : polygon) {
        const double along = level.x() * p.x() + level.z() * p.y();
        along_level_ = {std::min(along_level_.low, along), std::max(along_level_.high, along)};
      }
    }
  }

  // Returns the horizontal direction along the pads, a unit vector if their normal is horizontal.
  Vector3 Level() const { return up_.cross(Vector3::UnitY()); }

  // Notes whether the part is round about the approach vector, which is vertical. Its middle comes
  // midway between the pads at every turn, since its side looks alike from opposite directions. Its
  // turn does not change if friction keeps the pads from pressing one of its faces flat.
  void NoteRoundSide(const UncertainWorld& world, PartId part, const plan::Hold& hold) {
    const domain::PartModel& model = *world.problem().part(part).model;
    const auto half_step = RoundAboutApproach(model, hold, {pad_x_, pad_z_}, pad_z_ + off_z_);
    if (!half_step || !patch_ || patch_->isEmpty()) return;
    for (const geometry::MassProperties& mass : PossibleMasses(world.problem(), part)) {
      const Vector3 center = hold.X_PartTool.inverse() * mass.center;
      off_axis_ = std::max(off_axis_, center.head<2>().norm());
    }
    round_push_ = off_y_ + hold.width / 2 * (1 / std::cos(*half_step) - 1);
    // The first pad touches at a corner, and may turn the part until the next face lies flat on it.
    pushed_turn_ =
        AtMostRight(pushed_turn_ + TurnOfPush(world, part, world.X_WorldPart(part), round_push_));
    turn_ = AtMostRight(turn_ + pushed_turn_);
    // Opposite corners of the side must touch the pads themselves, and not lie beside them.
    const double corner = hold.width / 2 * std::tan(*half_step);
    is_round_ = std::tan(*half_step) < pad_friction_.low && corner + off_x_ + RoundSlip() <= pad_x_;
    jams_ = !is_round_;
  }

  // Returns the length on which the pads touch the faces, even if the part is displaced along them.
  double ContactLength() const {
    if (patch_) return LengthOfPatch();
    if (stay_on_faces_) return 2 * (is_straight() ? pad_x_ : std::min(pad_x_, pad_z_));
    const double along_x = 2 * pad_x_ - off_x_;
    return is_straight() ? along_x : std::min(along_x, 2 * pad_z_ - off_z_);
  }

  // Returns the turn, in radians, up to which the pads surely turn the part back to the faces
  // between them. Both pads press on opposite ends of these faces, or on opposite edges of their
  // own. The faces may be longer than the pads that lie wholly on them.
  double SteepestTurn(const UncertainWorld& world, PartId part, const plan::Hold& hold) const {
    const domain::PartModel& model = *world.problem().part(part).model;
    double length = ContactLength();
    if (LieOnFaces(model, hold, {pad_x_, pad_z_}) && off_x_ < pad_x_ && off_z_ < pad_z_) {
      length = std::max(length, 2 * ReachOfFaces(model, hold));
    }
    return std::atan(length / hold.width);
  }

  // Returns how far both faces between the pads surely reach to either side of the grasped point,
  // in metres along the pads, at the height of the pads.
  double ReachOfFaces(const domain::PartModel& model, const plan::Hold& hold) const {
    constexpr double kFar = 10;  // metres, beyond every part
    const auto reach = [&](int axis, const Vector2& within) {
      const Eigen::AlignedBox2d bounds = BoundsOf(OppositePatch(model, hold, within));
      return bounds.isEmpty() ? 0 : std::min(-bounds.min()[axis], bounds.max()[axis]);
    };
    const double along_x = reach(0, {kFar, pad_z_ - off_z_});
    return is_straight() ? along_x : std::min(along_x, reach(1, {pad_x_ - off_x_, kFar}));
  }

  // A part that stands turns about the vertical. Only what the pads touch along the horizontal
  // keeps it from turning. In a hand that leans, a narrow upright face lies across the pads at an
  // angle, and touches them on less of the horizontal than its bounds in the tool's axes.
  double LengthOfPatch() const {
    if (patch_->isEmpty()) return 0;
    if (is_straight()) return patch_->sizes().x();
    return std::min(patch_->sizes().minCoeff(), along_level_.high - along_level_.low);
  }

  // Returns how far the first pad may turn the part while this pad pushes the part to the second
  // pad. The result is 0 if the centre of mass is surely behind the first pad.
  double TurnOfFirstPad(const UncertainWorld& world, PartId part, const plan::Hold& hold,
                        double turned) const {
    if (up_.y() == 0 && IsBehindPad(world, part, hold, turned)) return 0;
    const double push = off_y_ + 2 * pad_x_ * std::sin(AtMostRight(turned));
    return AtMostRight(TurnOfPush(world, part, world.X_WorldPart(part), push));
  }

  // Returns whether the centre of mass is surely behind what the pad touches.
  bool IsBehindPad(const UncertainWorld& world, PartId part, const plan::Hold& hold,
                   double turned) const {
    const Vector3 level = Level();
    if (!patch_) {
      const double reach = pad_x_ * std::abs(level.x()) + pad_z_ * std::abs(level.z());
      return OffsetOfMass(world, part, hold, level, turned, Displaced()).high <= reach;
    }
    if (patch_->isEmpty()) return false;
    plan::Hold in_patch = hold;
    const Vector3 middle = (along_level_.low + along_level_.high) / 2 * level;
    in_patch.X_PartTool = hold.X_PartTool * geometry::Translation(middle.x(), 0, middle.z());
    return OffsetOfMass(world, part, in_patch, level, turned, Displaced()).high <=
           (along_level_.high - along_level_.low) / 2;
  }

  // The pads turn the part about a point on the line through their middle in the direction in which
  // they close. Returns the distance of this point from the middle. The support's friction draws
  // the point towards the centre of mass. If the centre of mass is far off, the pads' friction
  // keeps the point between the pads, because they press as hard as the moment of the support's
  // friction requires. Let a be the distance of a contact from the middle of the pads, d the
  // distance of the centre of mass from this middle, and mu the pads' coefficient of friction. A
  // force R of the support requires the normal force R d / (2 a) at each pad. The friction of both
  // pads, 2 mu times this force, is more than R if d > a / mu.
  double LeverOfTurn(const UncertainWorld& world, PartId part, const plan::Hold& hold,
                     double turned) const {
    const double contact = is_straight() ? pad_x_ : std::max(pad_x_, pad_z_);
    const Interval mass = OffsetOfMass(world, part, hold, Vector3::UnitY(), turned, Displaced());
    if (pad_friction_.low * mass.low > contact) return hold.width / 2;
    return std::max(hold.width / 2, mass.high);
  }

  // Returns the slip of the grasped point in an upright tool. A part that is pushed turns first to
  // the turned position and then back; any other part only turns back.
  double StraightSlip() const {
    const double across = lever_ * (pushed_turn_ + std::sin(turn_));
    const double along = 2 * pad_x_ * (1 - std::cos(turn_));
    return across + (pushed_turn_ > 0 ? 2 * along : along);
  }

  // Returns how far the axis of a round part slips along the pads. The first pad pushes it with a
  // force within its friction cone, and the part slides in the direction of the force: along the
  // pad by the friction times the push. Twice as much is allowed for, since the support's friction
  // is not even. A push also turns the part about its centre of mass, which may be off the axis.
  double RoundSlip() const {
    return 2 * pad_friction_.high * round_push_ + off_axis_ * pushed_turn_;
  }

  // Returns how far the grasped point moves, in the part's own axes, when the part turns about
  // points on its faces that the pads reach, and tilts on its support.
  Vector3 WaysOfGraspedPoint() const {
    const Vector3 about(TurnAbout(0), TurnAbout(1), TurnAbout(2));
    const Vector3 arm(2 * pad_x_, lever_, 2 * pad_z_);
    const Vector3 turned(about.z() * arm.y() + about.y() * arm.z() + roll_.way,
                         about.z() * arm.x() + about.x() * arm.z(),
                         about.x() * arm.y() + about.y() * arm.x() + roll_.way);
    return turned + tilted_;
  }

  Vector3 up_;  // the vertical, in the tool's axes
  double pad_x_;
  double pad_z_;
  double hand_;
  double off_x_;
  double off_y_;
  double off_z_;
  double pushed_turn_ = 0;  // by the first pad
  double lever_ = 0;        // of the turn, from the middle of the pads
  double turn_ = 0;
  double way_ = 0;                    // the total turn of the part, there and back
  Vector3 tilted_ = Vector3::Zero();  // movement of the grasped point as the part tilts
  Roll roll_;
  bool jams_ = false;
  bool stay_on_faces_ = false;  // the pads lie wholly on their faces, even if the part is displaced
  // The bounds of what both pads surely touch, in the tool's x and z, and how far it extends along
  // the horizontal, in metres. There are none if the pads lie wholly on their faces.
  std::optional<Eigen::AlignedBox2d> patch_;
  Interval along_level_ = {std::numeric_limits<double>::infinity(),
                           -std::numeric_limits<double>::infinity()};
  Interval pad_friction_;
  bool is_round_ = false;
  double round_push_ = 0;  // of a round part by the first pad, metres
  double off_axis_ = 0;    // distance of a round part's centre of mass from its axis, metres
};

HeldError Sound(UncertainWorld& world, PartId part, const plan::Hold& hold,
                const ManipulatorError& draw) {
  const SymbolicVector grasped = GraspedPoint(world, part, hold, draw);
  const Closing closing(world, part, hold, draw, grasped);
  const auto declare = [&](const plan::ErrorKind& kind, double magnitude) {
    return world.Declare(kind, {-magnitude, magnitude}, part);
  };
  const double give = closing.pushes() ? GiveOfHand(world.problem(), part, closing.up()) : 0;
  HeldError held = {.x = grasped[0] + declare(plan::error::kSlip, closing.SlipX() + give),
                    .z = grasped[2] + declare(plan::error::kRise, closing.SlipZ()),
                    .twist = declare(plan::error::kTwist, closing.TurnAbout(1))};
  if (give > 0) held.y = declare(plan::error::kGive, give);
  if (closing.jams()) {
    held.y = held.y + declare(plan::error::kJam, closing.SkewY());
    held.skew = declare(plan::error::kSkew, std::min(closing.turn(), closing.TurnAbout(2)));
    held.tip = declare(plan::error::kTip, std::min(closing.turn(), closing.TurnAbout(0)));
  }
  if (closing.is_round()) {
    held.skew = declare(plan::error::kSkew, closing.turn());
    held.is_round = true;
  }
  return held;
}

}  // namespace

double TurnBeforeGrasp(const UncertainWorld& world, PartId part, const plan::Hold& hold,
                       const ManipulatorError& draw) {
  return Closing(world, part, hold, draw, GraspedPoint(world, part, hold, draw)).pushed_turn();
}

HeldError ClosePads(UncertainWorld& world, PartId part, const plan::Hold& hold,
                    const ManipulatorError& draw) {
  if (world.propagation() == Propagation::kPaper) return AsPublished(world, part, hold);
  return Sound(world, part, hold, draw);
}

}  // namespace assay::uncertainty
