#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "planner/domain/parts/part_model.h"
#include "planner/domain/resting/resting.h"
#include "planner/geometry/collision.h"
#include "planner/geometry/polygon.h"
#include "planner/geometry/solids/mass_properties.h"
#include "planner/kinematics/grippers/gripper.h"
#include "planner/uncertainty/error_sets/axis_angle.h"
#include "planner/uncertainty/error_sets/possible_masses.h"
#include "planner/uncertainty/error_sets/squeezing.h"
#include "planner/uncertainty/pads/touching_cells.h"
#include "planner/uncertainty/preconditions/precondition.h"
#include "planner/uncertainty/standing/support.h"

namespace assay::uncertainty {
namespace {

constexpr double kPushed = 1e-12;  // metres: less than this is no push

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

  // Returns the greater of two ratios. If both are below 1, the part slides before a pad that
  // pushes it. One is the ratio of the push that overcomes the friction at the part's support to
  // the force of the grip. The other is the ratio of the push's moment about an edge of the support
  // to the moment of the weight. Pads push at the same heights from either side. The pad on the far
  // side of the part pushes it along `outward`.
  double PushRatio() const {
    const double turn = MostOf(world_, before_.theta) + hand_turn_;
    if (ReachOf(world_, part_, before_) + hand_ + turn < kPushed) return 0;
    const std::vector<Standing> standings = StandingsOf(world_, part_, X_WorldPart_);
    const std::vector<TippingEdge> edges = TippingEdgesOf(standings);
    if (edges.empty()) return kNothingBorne;
    const double level = standings.front().at.front().z();
    const double friction = FrictionOf(standings);
    double ratio = 0;
    for (const double side : {1.0, -1.0}) {
      const Vector3 way = -side * X_WorldTool_.linear().col(1);
      ratio = std::max(ratio, GreatestWeight(world_.problem(), part_) * SlidingPush(friction, way) /
                                  world_.problem().workcell->rules().grip_force);
      const double height = HighestOfLowest(side) - level + off_.shift.norm() + hand_;
      for (const TippingEdge& edge : edges) {
        ratio = std::max(ratio, RatioAbout(edge, friction, way, turn, height));
      }
    }
    return std::min(ratio, kNothingBorne);
  }

  // Returns the nearest neighbour and the metres that are left to it; infinite without one.
  Neighbour Nearest() const {
    const domain::Problem& problem = world_.problem();
    const geometry::Polygon own = domain::Footprint(problem.part(part_), X_WorldPart_);
    const BelievedShift shift = world_.ShiftAt(part_, X_WorldTool_.translation());
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
  // Returns the height, in metres, at which a pad surely touches the part as the part topples. It
  // is the height of the lowest cell of the pad. If the hand leans, any cell may touch first.
  double HighestOfLowest(double side) const {
    const domain::PartModel& model = *world_.problem().part(part_).model;
    const Vector2& pad = world_.problem().workcell->gripper().pad_half_extents();
    const TouchingCells cells = TouchingCellsOf(model, hold_, side, pad, {});
    const bool is_straight = std::abs(VerticalInTool(X_WorldTool_).z()) == 1;
    std::map<double, double> lowest;  // lowest height of each column of cells, by the tool's x
    double highest = -std::numeric_limits<double>::infinity();
    for (const Vector2& cell : cells.middles) {
      const Vector3 middle(cell.x(), side * hold_.width / 2, cell.y());
      const double height =
          (X_WorldTool_ * middle).z() + (is_straight ? -cells.half.y() : cells.half.sum());
      highest = std::max(highest, height);
      const auto [column, is_new] = lowest.try_emplace(cell.x(), height);
      if (!is_new) column->second = std::min(column->second, height);
    }
    if (lowest.empty()) return std::numeric_limits<double>::infinity();
    if (!is_straight) return highest;
    return std::ranges::max_element(lowest, {}, [](const auto& c) { return c.second; })->second;
  }

  // Two bodies have the greater of their frictions, and a table has the friction of what is on it.
  double FrictionOf(const std::vector<Standing>& standings) const {
    const domain::Problem& problem = world_.problem();
    double friction = problem.part(part_).model->friction();
    for (const Standing& standing : standings) {
      if (!standing.on.IsNone())
        friction = std::max(friction, problem.part(standing.on).model->friction());
    }
    return friction + problem.tolerances.friction;
  }

  // Returns the force along `way` that overcomes friction, divided by the weight. A pad that is not
  // upright exerts a vertical force, too, which adds to the friction or lifts the part.
  static double SlidingPush(double friction, const Vector3& way) {
    const double sliding = way.head<2>().norm() - friction * std::abs(way.z());
    return sliding > 0 ? friction / sliding : kNothingBorne;
  }

  // Returns the toppling ratio about an edge, for a pad that pushes along `way`, to within `turn`
  // radians. The pad pushes with the force that is needed to overcome the friction of the support.
  double RatioAbout(const TippingEdge& edge, double friction, const Vector3& way, double turn,
                    double height) const {
    const double level = way.head<2>().norm();
    const double vertical = std::abs(way.z());
    const double push = SlidingPush(friction, way);
    if (push >= kNothingBorne || !std::isfinite(height)) return kNothingBorne;
    const double aside = std::acos(std::clamp(edge.outward.dot(way.head<2>()) / level, -1.0, 1.0));
    const double along = std::cos(std::max(0.0, aside - turn));
    if (!(along > 0) && vertical == 0) return 0;
    double ratio = 0;
    for (const geometry::MassProperties& mass : PossibleMasses(world_.problem(), part_)) {
      const double inside = -edge.Beyond(X_WorldPart_ * mass.center);
      if (!(inside > 0)) return kNothingBorne;
      const double across = 2 * world_.problem().part(part_).model->shape().radius();
      const double moment = push * (level * height * std::max(0.0, along) + vertical * across);
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

}  // namespace

std::vector<Precondition> ClosingPreconditions(const UncertainWorld& world, PartId part,
                                               const plan::Hold& hold, const ManipulatorError& draw,
                                               const HeldError& held) {
  const ClosingConditions closing(world, part, hold, draw, held);
  Preconditions conditions;
  conditions.Less(plan::condition::kUpright, "the part slides before a pad and does not topple",
                  closing.PushRatio(), 1);
  const auto [neighbour, room] = closing.Nearest();
  if (!neighbour.IsNone()) {
    conditions.Greater(plan::condition::kPushedClear,
                       "closing pads push the part into no neighbour", room, 0, neighbour);
  }
  return conditions.Take();
}

}  // namespace assay::uncertainty
