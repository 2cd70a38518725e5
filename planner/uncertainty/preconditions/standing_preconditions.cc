#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "planner/domain/matings/shaft_fit.h"
#include "planner/domain/parts/part_model.h"
#include "planner/geometry/box.h"
#include "planner/geometry/collision.h"
#include "planner/geometry/solids/mass_properties.h"
#include "planner/kinematics/grippers/gripper.h"
#include "planner/plan/certificates/pushing.h"
#include "planner/uncertainty/error_sets/axis_angle.h"
#include "planner/uncertainty/error_sets/possible_masses.h"
#include "planner/uncertainty/error_sets/release.h"
#include "planner/uncertainty/pads/grip.h"
#include "planner/uncertainty/preconditions/precondition.h"
#include "planner/uncertainty/preconditions/touching_ahead.h"
#include "planner/uncertainty/standing/support.h"

namespace assay::uncertainty {
namespace {

class StandingConditions {
 public:
  StandingConditions(const UncertainWorld& world, PartId part, const plan::Hold& hold,
                     const ManipulatorError& draw, const Pose& X_WorldPart,
                     const RestingError& released)
      : world_(world),
        draw_(draw),
        released_(released),
        part_(part),
        hold_(hold),
        X_WorldPart_(X_WorldPart),
        standings_(StandingsOf(world, part, X_WorldPart)),
        edges_(TippingEdgesOf(SureStandingsOf(world, part, X_WorldPart, released))),
        off_(OnParts() ? ReachOf(world, part, released) + ReachOfSupports() : 0) {}

  // Returns the ratio that must be below 1 for a part that leans by `tilt` to fall back.
  double FallRatio(double tilt) const {
    return WorstOf([&](const TippingEdge& edge, const geometry::MassProperties& mass) {
      const Vector3 center = X_WorldPart_ * mass.center;
      const double inside = -edge.Beyond(center);
      if (!(inside > 0)) return kNothingBorne;
      return (center.z() - Level()) * std::tan(std::min(tilt, kSteep)) / inside;
    });
  }

  // Returns the metres by which the fingers stay above the table, and above or beside the part's
  // support.
  double RoomOfFingers() const {
    const domain::Problem& problem = world_.problem();
    const geometry::CollisionShape hand = problem.workcell->HandShape(hold_.width);
    const OffInHand off = OffInHandOf(world_, world_.held());
    const double around =
        off_ + off.shift.norm() + hand.radius() * (off.turn + MostOf(world_, draw_.theta));
    double room = LowestFinger();
    for (const Standing& standing : standings_) {
      if (standing.on.IsNone()) continue;
      const Pose& X_WorldOther = world_.X_WorldPart(standing.on);
      const geometry::CollisionShape& other = problem.part(standing.on).model->shape();
      const double beside =
          geometry::Distance(hand, X_WorldPart_ * hold_.X_PartTool, other, X_WorldOther) - around;
      room = std::min(room, std::max(LowestFinger() - HighestOf(standing.on), beside));
    }
    return room - SlideOfPads(world_, draw_, released_);
  }

  // Pads that slide down on the part press on it in the middle of the patch that they touch. If
  // this middle is beyond an edge of the support, the pads turn the part over. They do not turn it
  // over if the part's weight is great enough, or if the pads bear the force with which the edge
  // pushes back.
  double PressRatio() const {
    const OffInHand off = OffInHandOf(world_, world_.held());
    const Grip grip = GripOf(world_.problem(), part_, hold_, off);
    if (!grip.touches) return kNothingBorne;
    const Vector2& center = grip.friction.center();
    const Vector3 middle = X_WorldPart_ * hold_.X_PartTool * Vector3(center.x(), 0, center.y());
    const double beside = off.shift.norm() + off.turn * hold_.width;
    return WorstOf([&](const TippingEdge& edge, const geometry::MassProperties& mass) {
      const double inside = -edge.Beyond(X_WorldPart_ * mass.center);
      if (!(inside > 0)) return kNothingBorne;
      const double beyond = std::max(0.0, edge.Beyond(middle) + beside);
      const double by_weight = GreatestPress() * beyond / (mass.mass * kGravity * inside);
      return std::min(by_weight, GivenBackRatio(grip, edge, beyond));
    });
  }

 private:
  static constexpr double kSteep = 1.5;  // radians

  template <class Ratio>
  double WorstOf(const Ratio& ratio_of) const {
    if (edges_.empty()) return kNothingBorne;
    double ratio = 0;
    for (const geometry::MassProperties& mass : PossibleMasses(world_.problem(), part_)) {
      for (const TippingEdge& edge : edges_) ratio = std::max(ratio, ratio_of(edge, mass));
    }
    return std::min(ratio, kNothingBorne);
  }

  // Returns the height of the lowest contact: the lever of a part that leans about it is the
  // longest.
  double Level() const {
    double level = std::numeric_limits<double>::infinity();
    for (const Standing& standing : standings_) {
      for (const Vector3& p : standing.at) level = std::min(level, p.z());
    }
    return level;
  }

  bool OnParts() const {
    return std::ranges::any_of(standings_, [](const Standing& s) { return !s.on.IsNone(); });
  }
  double ReachOfSupports() const {
    double reach = 0;
    for (const Standing& standing : standings_) {
      if (standing.on.IsNone()) continue;
      reach = std::max(reach, ReachOf(world_, standing.on, world_.resting(standing.on)));
    }
    return reach;
  }

  // Returns the lowest height of the fingers (world z), for any error of the part in the hand. A
  // turn about each axis of the tool counts to first order, and its rest is bounded.
  double LowestFinger() const {
    const kinematics::Gripper& gripper = world_.problem().workcell->gripper();
    const Pose X_WorldTool = X_WorldPart_ * hold_.X_PartTool;
    const Vector3 up = VerticalInTool(X_WorldTool);
    const HeldError& held = world_.held();
    const Vector3 turns(MostOf(world_, held.tip), MostOf(world_, held.twist),
                        MostOf(world_, held.skew));
    double lowest = std::numeric_limits<double>::infinity();
    for (const geometry::Box& box : gripper.FingerBoxes(hold_.width)) {
      for (const Vector3& corner : box.Corners()) {
        const double swung =
            turns.dot(corner.cross(up).cwiseAbs()) + turns.sum() * turns.sum() / 2 * corner.norm();
        lowest = std::min(lowest, (X_WorldTool * corner).z() - swung);
      }
    }
    return lowest - up.cwiseAbs().dot(OffInHandOf(world_, held).shift);
  }

  double HighestOf(PartId part) const {
    double highest = -std::numeric_limits<double>::infinity();
    for (const Vector3& v : world_.problem().part(part).model->corners()) {
      highest = std::max(highest, (world_.X_WorldPart(part) * v).z());
    }
    return highest;
  }

  double GreatestPress() const {
    const domain::Problem& problem = world_.problem();
    return std::min(plan::kGreatestPush,
                    2 * PossiblePadFriction(problem).high * problem.workcell->rules().grip_force);
  }

  // Returns the ratio of the force that stops a guarded move to what the pads bear. The force
  // acts at an edge that is `beyond` metres beside the middle of the pads.
  double GivenBackRatio(const Grip& grip, const TippingEdge& edge, double beyond) const {
    const geometry::Matrix3 R_ToolWorld = (X_WorldPart_ * hold_.X_PartTool).linear().transpose();
    const Vector3 push = plan::kResistance * R_ToolWorld.col(2);
    const Vector3 lever = -beyond * (R_ToolWorld * Vector3(edge.outward.x(), edge.outward.y(), 0));
    const Vector3 moment = lever.cross(push);
    const PlaneLoad in_plane = ActingAt({lever.x(), lever.z()}, Vector2(push.x(), push.z()));
    return grip.RatioOf({.slipping = grip.friction.RatioOf(in_plane),
                         .across = std::abs(push.y()),
                         .tilting = std::hypot(moment.x(), moment.z())},
                        world_.problem().workcell->rules().grip_force);
  }

  const UncertainWorld& world_;
  const ManipulatorError& draw_;
  const RestingError& released_;
  PartId part_;
  const plan::Hold& hold_;
  Pose X_WorldPart_;
  std::vector<Standing> standings_;
  std::vector<TippingEdge> edges_;
  double off_;  // metres by which other parts under this one may be elsewhere
};

// Returns the corners of the mouths of the mated holes, in the world.
std::vector<Vector3> MouthsOf(const UncertainWorld& world, const domain::Mating& mating) {
  const Pose& X_WorldFixed = world.X_WorldPart(mating.fixed);
  std::vector<Vector3> corners;
  for (const domain::ShaftFit& fit : domain::FitsOf(world.problem(), mating)) {
    const Pose X_WorldHole = fit.shaft_is_held ? X_WorldFixed : X_WorldFixed * mating.X_FixedHeld;
    for (const domain::Mouth& mouth : fit.hole.mouths) {
      const domain::Face& face = fit.hole_model.faces()[mouth.face.index()];
      for (const Vector2& p : mouth.outline)
        corners.push_back(X_WorldHole * face.X_PartFace * Vector3(p.x(), p.y(), 0));
    }
  }
  return corners;
}

// Returns the greatest angle, in radians, by which the parts of a straight mating lean against each
// other at the seat: a turn about the mating vector is no lean.
double LeanAgainstFixed(const UncertainWorld& world, const domain::Mating& mating,
                        const plan::Hold& hold, const ManipulatorError& draw) {
  const Pose& X_WorldFixed = world.X_WorldPart(mating.fixed);
  const Vector3 motion = mating.mating_vector.normalized();
  const Vector3 in_tool = (mating.X_FixedHeld * hold.X_PartTool).linear().transpose() * motion;
  const double of_fixed = MostOf(world, world.resting(mating.fixed).theta);
  return LeaningOf(world, in_tool, draw).tilt +
         SwingOf(of_fixed, (X_WorldFixed.linear() * motion).z());
}

// Returns the points of the fixed part on which the straight mating may push, in the world: where
// the parts touch in their seat, and where they may touch before it because they lean. If the
// mating ends on the table, the parts touch at the hole's walls alone. What is pushed may be
// elsewhere by `off` metres.
std::vector<Vector3> PushedAt(const UncertainWorld& world, const domain::Mating& mating,
                              double lean, double off) {
  const Pose& X_WorldFixed = world.X_WorldPart(mating.fixed);
  std::vector<Vector3> at;
  if (mating.ends_on_table) at = MouthsOf(world, mating);
  for (const Standing& standing :
       StandingsOf(world, mating.held, X_WorldFixed * mating.X_FixedHeld)) {
    if (standing.on == mating.fixed) std::ranges::copy(standing.at, std::back_inserter(at));
  }
  if (lean == 0) return at;
  for (const Vector3& p : FirstTouches(world.problem(), mating, lean, off))
    at.push_back(X_WorldFixed * p);
  return at;
}

// Returns the push of the mating on the fixed part. A straight mating pushes along its vector. A
// strategy pushes in any direction, wherever the parts may touch on the way.
Push PushOf(const UncertainWorld& world, const domain::Mating& mating, std::vector<Vector3> at,
            const plan::Strategy* strategy) {
  const Pose& X_WorldFixed = world.X_WorldPart(mating.fixed);
  const double weight = GreatestWeight(world.problem(), mating.held);
  Push push = {.at = std::move(at)};
  if (strategy != nullptr) {
    push.at.push_back(X_WorldFixed * strategy->X_FixedStart.translation());
    push.down = weight + plan::kStrategyPush;
    push.aside = plan::kStrategyPush;
    return push;
  }
  const Vector3 way = X_WorldFixed.linear() * mating.mating_vector.normalized();
  push.down = weight + plan::kGreatestPush * -way.z();
  push.aside = plan::kGreatestPush * way.head<2>().norm();
  return push;
}

}  // namespace

std::vector<Precondition> StandingPreconditions(const UncertainWorld& world, PartId part,
                                                const plan::Hold& hold,
                                                const ManipulatorError& draw,
                                                const Pose& X_WorldPart,
                                                const RestingError& released, double play) {
  const StandingConditions standing(world, part, hold, draw, X_WorldPart, released);
  const Vector3 up = VerticalInTool(X_WorldPart * hold.X_PartTool);
  const double tilt = std::max(play, LeaningOf(world, up, draw).tilt);
  Preconditions conditions;
  conditions.Less(plan::condition::kStanding, "the part stands after the hand lets it go",
                  standing.FallRatio(tilt), 1);
  conditions.Less(plan::condition::kPressed, "pads that press the part down do not tip it",
                  standing.PressRatio(), 1);
  conditions.Greater(plan::condition::kFingertip, "the fingers stay above what the part is set on",
                     standing.RoomOfFingers(), 0);
  return conditions.Take();
}

std::vector<Precondition> FixedPreconditions(const UncertainWorld& world, domain::MatingId id,
                                             const plan::Hold& hold, const ManipulatorError& draw,
                                             const RestingError& released,
                                             const plan::Strategy* strategy) {
  const domain::Mating& mating = world.problem().mating(id);
  const double off = ReachOf(world, mating.held, released) +
                     ReachOf(world, mating.fixed, world.resting(mating.fixed));
  const double lean = strategy == nullptr ? LeanAgainstFixed(world, mating, hold, draw) : 0;
  std::vector<Push> pushes = WeightsOn(world, mating.fixed);
  pushes.push_back(PushOf(world, mating, PushedAt(world, mating, lean, off), strategy));
  const bool touch = !pushes.back().at.empty();
  Preconditions conditions;
  conditions.Less(plan::condition::kFixedStands,
                  "the push of the mating does not tip the fixed part",
                  touch ? TippingRatio(world, mating.fixed, pushes, off) : kNothingBorne, 1);
  conditions.Less(plan::condition::kFixedStays,
                  "the push of the mating does not push the fixed part aside",
                  SlidingRatio(world, mating.fixed, pushes), 1);
  return conditions.Take();
}

}  // namespace assay::uncertainty
