#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "planner/domain/part/part_model.h"
#include "planner/domain/part/resting.h"
#include "planner/kinematics/gripper.h"
#include "planner/plan/data/pushing.h"
#include "planner/uncertainty/errors/axis_angle.h"
#include "planner/uncertainty/errors/possible_masses.h"
#include "planner/uncertainty/errors/release.h"
#include "planner/uncertainty/errors/squeezing.h"
#include "planner/uncertainty/preconditions/grip.h"
#include "planner/uncertainty/preconditions/precondition.h"
#include "planner/uncertainty/preconditions/support.h"
#include "planner/uncertainty/preconditions/touching_cells.h"

namespace assay::uncertainty {
namespace {

constexpr double kPushed = 1e-12;  // metres: less than this is no push

double MostOf(const UncertainWorld& world, const Expression& e) {
  return Magnitude(world.RangeOf(e));
}

// Returns the greatest distance, in metres, by which any point of a part may be elsewhere in the
// plane of the table.
double ReachOf(const UncertainWorld& world, PartId part, const RestingError& error) {
  return std::hypot(MostOf(world, error.displacement[0]), MostOf(world, error.displacement[1])) +
         world.problem().part(part).model->shape().radius() * MostOf(world, error.theta);
}

// ---- Closing pads ---------------------------------------------------------------------------

// A part beside the one that is pushed, and the room that is left between the two, in metres.
struct Neighbour {
  PartId part = PartId::None();  // None: no neighbour
  double room = std::numeric_limits<double>::infinity();
};

class ClosingConditions {
 public:
  ClosingConditions(const UncertainWorld& world, PartId part, const plan::Hold& hold,
                    const ManipulatorError& draw, const HeldError& held)
      : world_(world),
        part_(part),
        hold_(hold),
        X_WorldPart_(world.X_WorldPart(part)),
        X_WorldTool_(X_WorldPart_ * hold.X_PartTool),
        hand_turn_(MostOf(world, draw.theta)),
        hand_(std::hypot(MostOf(world, draw.x), MostOf(world, draw.y), MostOf(world, draw.z))),
        off_(OffInHandOf(world, held)),
        before_(world.about_plan(part)),
        turned_on_the_way_(TurnBeforeGrasp(world, part, hold, draw)) {}

  // Pads push at the same heights from either side. The pad on the far side of the part pushes it
  // along `outward`.
  double ToppleRatio() const {
    const double turn = MostOf(world_, before_.theta) + hand_turn_;
    if (ReachOf(world_, part_, before_) + hand_ + turn < kPushed) return 0;
    const std::vector<Standing> standings = StandingsOf(world_, part_, X_WorldPart_);
    const std::vector<TippingEdge> edges = TippingEdgesOf(standings);
    if (edges.empty()) return kNothingBorne;
    const double level = standings.front().at.front().z();
    double ratio = 0;
    for (const double side : {1.0, -1.0}) {
      const Vector3 way = -side * X_WorldTool_.linear().col(1);
      const double height = HighestOfLowest(side) - level + off_.shift.norm() + hand_;
      for (const TippingEdge& edge : edges) {
        ratio = std::max(ratio, RatioAbout(edge, way, turn, height));
      }
    }
    return ratio;
  }

  // Returns the nearest neighbour and the metres that are left to it; infinite without one.
  Neighbour Nearest() const {
    const domain::Problem& problem = world_.problem();
    const geometry::Polygon own = domain::Footprint(problem.part(part_), X_WorldPart_);
    const BeliefShift shift = world_.ShiftAt(part_, X_WorldTool_.translation());
    const double moved =
        std::hypot(MostOf(world_, shift.displacement[0]), MostOf(world_, shift.displacement[1])) +
        hand_ + off_.shift.norm() +
        problem.part(part_).model->shape().radius() *
            (MostOf(world_, shift.turn) + hand_turn_ + off_.turn);
    // On the way, the first pad may have turned the part about any of its points.
    const double swung = 2 * problem.part(part_).model->shape().radius() * turned_on_the_way_;
    const double reach = std::max(moved, ReachOf(world_, part_, before_)) + swung;
    Neighbour nearest;
    for (int p = 0; p < static_cast<int>(problem.parts.size()); ++p) {
      const PartId other(p);
      if (other == part_ || other == world_.in_hand()) continue;
      const double gap =
          geometry::Gap(own, domain::Footprint(problem.part(other), world_.X_WorldPart(other)));
      const double room = gap - reach - ReachOf(world_, other, world_.about_plan(other));
      if (room < nearest.room) nearest = {other, room};
    }
    return nearest;
  }

 private:
  // Returns the height, in metres, at which a pad surely touches as the part topples. It is the
  // height of the lowest of its cells. If the hand leans, any cell may touch first.
  double HighestOfLowest(double side) const {
    const domain::PartModel& model = *world_.problem().part(part_).model;
    const Vector2& pad = world_.problem().workcell->gripper().pad_half_extents();
    const Vector2 half = pad / kCellsPerSide;
    const bool is_straight = std::abs(VerticalInTool(X_WorldTool_).z()) == 1;
    std::map<double, double> lowest;  // lowest height of each column of cells, by the tool's x
    double highest = -std::numeric_limits<double>::infinity();
    for (const Vector2& cell : TouchingCells(model, hold_, side, pad, {})) {
      const Vector3 middle(cell.x(), side * hold_.width / 2, cell.y());
      const double height = (X_WorldTool_ * middle).z() + (is_straight ? -half.y() : half.sum());
      highest = std::max(highest, height);
      const auto [column, is_new] = lowest.try_emplace(cell.x(), height);
      if (!is_new) column->second = std::min(column->second, height);
    }
    if (lowest.empty()) return std::numeric_limits<double>::infinity();
    if (!is_straight) return highest;
    return std::ranges::max_element(lowest, {}, [](const auto& c) { return c.second; })->second;
  }

  double TableFriction() const {
    return world_.problem().part(part_).model->friction() + world_.problem().tolerances.friction;
  }

  // Returns the toppling ratio about an edge, for a pad that pushes along `way`, to within `turn`
  // radians. The pad pushes with the force that the friction of the table takes. A pad that is not
  // upright exerts a vertical force, too, which adds to the friction or lifts the part.
  double RatioAbout(const TippingEdge& edge, const Vector3& way, double turn, double height) const {
    const double level = way.head<2>().norm();
    const double vertical = std::abs(way.z());
    const double friction = TableFriction();
    const double sliding = level - friction * vertical;
    if (!(sliding > 0) || !std::isfinite(height)) return kNothingBorne;
    const double aside = std::acos(std::clamp(edge.outward.dot(way.head<2>()) / level, -1.0, 1.0));
    const double along = std::cos(std::max(0.0, aside - turn));
    if (!(along > 0) && vertical == 0) return 0;
    double ratio = 0;
    for (const geometry::MassProperties& mass : PossibleMasses(world_.problem(), part_)) {
      const double inside = -edge.Beyond(X_WorldPart_ * mass.center);
      if (!(inside > 0)) return kNothingBorne;
      const double across = 2 * world_.problem().part(part_).model->shape().radius();
      const double moment =
          friction / sliding * (level * height * std::max(0.0, along) + vertical * across);
      ratio = std::max(ratio, moment / inside);
    }
    return std::min(ratio, kNothingBorne);
  }

  const UncertainWorld& world_;
  PartId part_;
  const plan::Hold& hold_;
  Pose X_WorldPart_;
  Pose X_WorldTool_;
  double hand_turn_;  // error of the hand, radians
  double hand_;       // error of the hand, metres
  OffInHand off_;
  RestingError before_;
  double turned_on_the_way_;  // radians
};

// ---- A part that is let go ------------------------------------------------------------------

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
        edges_(TippingEdgesOf(standings_)),
        off_(OnParts() ? ReachOf(world, part, released) + ReachOfSupports() : 0) {}

  // Returns the ratio that must be below 1 for a part that leans by `tilt` to fall back.
  double FallRatio(double tilt) const {
    return WorstOf([&](const TippingEdge& edge, const geometry::MassProperties& mass) {
      const Vector3 center = X_WorldPart_ * mass.center;
      const double inside = -edge.Beyond(center) - off_;
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
  // this middle is beyond an edge of the support, they turn the part over. They do not if the
  // part's weight holds it, or if the pads bear the force with which the edge pushes back.
  double PressRatio() const {
    const OffInHand off = OffInHandOf(world_, world_.held());
    const Grip grip = GripOf(world_.problem(), part_, hold_, off);
    if (!(grip.reach.minCoeff() > 0)) return kNothingBorne;
    const Vector2& center = grip.friction.center();
    const Vector3 middle = X_WorldPart_ * hold_.X_PartTool * Vector3(center.x(), 0, center.y());
    const double beside = off.shift.norm() + off.turn * hold_.width + off_;
    return WorstOf([&](const TippingEdge& edge, const geometry::MassProperties& mass) {
      const double inside = -edge.Beyond(X_WorldPart_ * mass.center) - off_;
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

  double Level() const { return standings_.front().at.front().z(); }

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
    for (const Vector3& v : world_.problem().part(part).model->hull().vertices) {
      highest = std::max(highest, (world_.X_WorldPart(part) * v).z());
    }
    return highest;
  }

  double GreatestPress() const {
    const domain::WorkcellRules& rules = world_.problem().workcell->rules();
    const double friction = rules.pad_friction + world_.problem().tolerances.pad_friction;
    return std::min(plan::kGreatestPush, 2 * friction * rules.grip_force);
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

// ---- The fixed part of a mating -------------------------------------------------------------

// Returns the push of the mating on the fixed part. A straight mating pushes along its vector where
// the parts touch at the end. A strategy pushes in any direction, wherever the parts may touch on
// the way.
Push PushOf(const UncertainWorld& world, const domain::Mating& mating,
            const plan::Strategy* strategy) {
  const Pose& X_WorldFixed = world.X_WorldPart(mating.fixed);
  const double weight = GreatestWeight(world.problem(), mating.held);
  Push push;
  for (const Standing& standing :
       StandingsOf(world, mating.held, X_WorldFixed * mating.X_FixedHeld)) {
    if (standing.on == mating.fixed) push.at = standing.at;
  }
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

// Returns the weights of the parts that already stand on this one; each acts somewhere in its patch
// of contact.
std::vector<Push> WeightsOn(const UncertainWorld& world, PartId part) {
  std::vector<Push> weights;
  for (int p = 0; p < static_cast<int>(world.problem().parts.size()); ++p) {
    const PartId other(p);
    if (other == part || other == world.in_hand()) continue;
    for (const Standing& standing : StandingsOf(world, other, world.X_WorldPart(other))) {
      if (standing.on != part) continue;
      weights.push_back({standing.at, GreatestWeight(world.problem(), other), 0});
    }
  }
  return weights;
}

}  // namespace

std::vector<Precondition> ClosingPreconditions(const UncertainWorld& world, PartId part,
                                               const plan::Hold& hold, const ManipulatorError& draw,
                                               const HeldError& held) {
  const ClosingConditions closing(world, part, hold, draw, held);
  Preconditions conditions;
  conditions.Less("upright", "the part slides before a pad and does not topple",
                  closing.ToppleRatio(), 1);
  const auto [neighbour, room] = closing.Nearest();
  if (!neighbour.IsNone()) {
    conditions.Greater("pushed clear", "closing pads push the part into no neighbour", room, 0,
                       neighbour);
  }
  return conditions.Take();
}

std::vector<Precondition> StandingPreconditions(const UncertainWorld& world, PartId part,
                                                const plan::Hold& hold,
                                                const ManipulatorError& draw,
                                                const Pose& X_WorldPart,
                                                const RestingError& released, double play) {
  const StandingConditions standing(world, part, hold, draw, X_WorldPart, released);
  const Vector3 up = VerticalInTool(X_WorldPart * hold.X_PartTool);
  const double tilt = std::max(play, LeaningOf(world, up, draw).tilt);
  Preconditions conditions;
  conditions.Less("standing", "the part stands after the hand lets it go", standing.FallRatio(tilt),
                  1);
  conditions.Less("pressed", "pads that press the part down do not tip it", standing.PressRatio(),
                  1);
  conditions.Greater("fingertip", "the fingers stay above what the part is set on",
                     standing.RoomOfFingers(), 0);
  return conditions.Take();
}

std::vector<Precondition> FixedPreconditions(const UncertainWorld& world, domain::MatingId id,
                                             const RestingError& released,
                                             const plan::Strategy* strategy) {
  const domain::Problem& problem = world.problem();
  const domain::Mating& mating = problem.mating(id);
  const double off = ReachOf(world, mating.held, released) +
                     ReachOf(world, mating.fixed, world.resting(mating.fixed));
  std::vector<Push> pushes = WeightsOn(world, mating.fixed);
  pushes.push_back(PushOf(world, mating, strategy));
  const bool touch = !pushes.back().at.empty();
  Preconditions conditions;
  conditions.Less("fixed stands", "the push of the mating does not tip the fixed part",
                  touch ? TippingRatio(world, mating.fixed, pushes, off) : kNothingBorne, 1);
  conditions.Less("fixed stays", "the push of the mating does not push the fixed part aside",
                  SlidingRatio(problem, mating.fixed, pushes), 1);
  return conditions.Take();
}

}  // namespace assay::uncertainty
