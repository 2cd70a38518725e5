#include <fmt/format.h>

#include <algorithm>

#include "planner/algebra/expression/simplify.h"
#include "planner/domain/matings/shaft_fit.h"
#include "planner/domain/parts/part_model.h"
#include "planner/geometry/hull.h"
#include "planner/geometry/polygon.h"
#include "planner/plan/data/tool_route.h"
#include "planner/uncertainty/error_sets/mating_end.h"
#include "planner/uncertainty/pads/touching_cells.h"
#include "planner/uncertainty/preconditions/clearance.h"
#include "planner/uncertainty/preconditions/precondition.h"
#include "planner/uncertainty/preconditions/touching_ahead.h"

namespace assay::uncertainty {
namespace {

using domain::ShaftFit;
using geometry::ConvexHull;

constexpr double kInPlane = 1e-6;  // metres by which a body in a plane may stand out of it

// Recognizes the pairs of pieces that the conditions `entry` and `slide-in` cover. One piece
// belongs to a shaft and is no wider than the shaft at its tip. The other piece belongs to the
// hole's part, lies behind one of the hole's walls, and is no farther out than the hole's mouth.
class FitPieces {
 public:
  explicit FitPieces(const ShaftFit& fit)
      : fit_(fit), walls_(domain::SideWalls(fit, 0)), section_(domain::CrossSection(fit)) {}

  bool Has(const ConvexHull& of_held, const ConvexHull& of_fixed) const {
    return fit_.shaft_is_held ? IsOfShaft(of_held) && IsBehindWall(of_fixed)
                              : IsOfShaft(of_fixed) && IsBehindWall(of_held);
  }

 private:
  bool IsOfShaft(const ConvexHull& piece) const {
    const Pose X_FeaturePart = fit_.shaft.X_PartFeature.inverse();
    return std::ranges::all_of(piece.vertices, [&](const Vector3& corner) {
      const Vector3 p = X_FeaturePart * corner;
      return p.z() < kInPlane && geometry::Depth(section_, p.head<2>()) > -kInPlane;
    });
  }
  bool IsBehindWall(const ConvexHull& piece) const {
    const Vector3 out = fit_.hole.X_PartFeature.linear().col(2);
    const double mouth = out.dot(fit_.hole.X_PartFeature.translation());
    return GreatestAlong(piece, out) < mouth + kInPlane &&
           std::ranges::any_of(walls_, [&](const domain::SideWall& wall) {
             return GreatestAlong(piece, wall.normal) < wall.offset + kInPlane;
           });
  }

  const ShaftFit& fit_;
  std::vector<domain::SideWall> walls_;
  geometry::Polygon section_;
};

// The straight way of the held part, with unchanged believed poses.
struct WayIn {
  PossibleFrame end;  // frame of the part at the end, in the world
  Vector3 back;       // vector from there to where the way begins, metres
};

// Returns the greatest angle, in radians, by which the held part may be turned.
double AngleOfHeld(const UncertainWorld& world) {
  return Magnitude(world.problem().gripper_error.theta) + OffInHandOf(world, world.held()).turn;
}

WayIn WayToSeat(const UncertainWorld& world, domain::MatingId id, const plan::Hold& hold,
                const Transform& X_ToolGrasp) {
  const domain::Mating& mating = world.problem().mating(id);
  const MatingEnd end = MatingEndOf(world, id, hold, X_ToolGrasp);
  return {{world.X_WorldPart(mating.fixed) * mating.X_FixedHeld, algebra::Simplify(end.Seated()),
           AngleOfHeld(world)},
          -LengthOfWay(world, id, end.farther) * end.motion};
}

// Returns the way to where the strategy starts. The strategy's own certificate covers what follows.
WayIn WayToStrategy(const UncertainWorld& world, const plan::Action& assemble,
                    const Transform& X_ToolGrasp, const plan::Strategy& strategy) {
  const domain::Mating& mating = world.problem().mating(assemble.mating);
  const plan::ToolRoute route =
      plan::RouteOf(world.problem(), assemble, &strategy, world.X_WorldPart(mating.fixed));
  const Pose& start = route.to_work.back();
  const Pose& X_PartTool = assemble.hold.X_PartTool;
  return {{start * X_PartTool.inverse(),
           algebra::Simplify(PossibleHeldPose(start, X_ToolGrasp, X_PartTool)), AngleOfHeld(world)},
          route.poised.translation() - start.translation()};
}

class PassingConditions {
 public:
  PassingConditions(const UncertainWorld& world, domain::MatingId id, const WayIn& way)
      : world_(world),
        mating_(world.problem().mating(id)),
        held_model_(*world.problem().part(mating_.held).model),
        way_(way) {}

  // Requires clearance from the fixed part. Shafts and the walls of their holes are left out.
  // Pieces that lie ahead of the held part even at its seat are left out, too: the condition `fixed
  // stands` allows for the push on them (FirstTouches).
  void RequireClearOfFixed(bool to_seat) {
    const std::vector<ShaftFit> fits = domain::FitsOf(world_.problem(), mating_);
    const std::vector<FitPieces> pieces(fits.begin(), fits.end());
    const auto are_to_meet = [&](const ConvexHull& of_held, const ConvexHull& of_fixed) {
      return to_seat && (LiesAhead(mating_, of_fixed, of_held) ||
                         std::ranges::any_of(pieces, [&](const FitPieces& fit) {
                           return fit.Has(of_held, of_fixed);
                         }));
    };
    const PossibleFrame fixed = BelievedFrameOf(world_, mating_.fixed);
    const Clearance clearance = ClearOf(mating_.fixed, PartId::None(), way_.end, fixed);
    for (const ConvexHull& of_held : held_model_.pieces()) {
      const Body body(way_.end, of_held, WayOf(world_, way_.back, 0));
      for (const ConvexHull& of_fixed : world_.problem().part(mating_.fixed).model->pieces()) {
        if (are_to_meet(of_held, of_fixed)) continue;
        RequireApart(body, Body(fixed, of_fixed), clearance, conditions_);
      }
    }
  }

  void RequireClearOf(PartId neighbour) {
    const BelievedShift shift = world_.ShiftAt(mating_.fixed, way_.end.planned.translation());
    const PossibleFrame held = Shifted(world_, way_.end, shift);
    const PossibleFrame other = FrameOf(world_, neighbour);
    const Clearance clearance = ClearOf(neighbour, neighbour, held, other);
    const StraightWay way = WayOf(world_, way_.back, shift.turn);
    for (const ConvexHull& of_held : held_model_.pieces()) {
      const Body body(held, of_held, way);
      for (const ConvexHull& piece : world_.problem().part(neighbour).model->pieces()) {
        RequireApart(body, Body(other, piece), clearance, conditions_);
      }
    }
  }

  // Requires that the held part stays above the table on which the fixed part rests. The part is
  // lowest at the end of the way. The corners that no error brings to the table are left out.
  void RequireClearOfTable() {
    if (mating_.ends_on_table) return;
    const Expression& table = world_.resting(mating_.fixed).displacement[2];
    const PossibleFrame fixed = BelievedFrameOf(world_, mating_.fixed);
    const double lowered = DisplacementBetween(world_, way_.end, fixed).z();
    for (const ConvexHull& of_held : held_model_.pieces()) {
      const Body body(way_.end, of_held);
      for (const Body::Point& p : body.Foremost(-Vector3::UnitZ())) {
        if (p.planned.z() > lowered + body.turned()) continue;
        conditions_.Less(plan::condition::kPassingClear,
                         fmt::format("{} passes the table on its way in",
                                     world_.problem().part(mating_.held).name),
                         table - body.Possible(p)[2], 0);
      }
    }
  }

  std::vector<Precondition> Take() { return conditions_.Take(); }

 private:
  Clearance ClearOf(PartId part, PartId neighbour, const PossibleFrame& held,
                    const PossibleFrame& other) const {
    const domain::Problem& problem = world_.problem();
    const double yields = problem.workcell->rules().lateral_compliance;
    return {{plan::condition::kPassingClear,
             fmt::format("{} passes {} on its way in", problem.part(mating_.held).name,
                         problem.part(part).name)},
            DisplacementBetween(world_, held, other),
            Vector3::Constant(yields + problem.tolerances.clearance),
            neighbour};
  }

  const UncertainWorld& world_;
  const domain::Mating& mating_;
  const domain::PartModel& held_model_;
  const WayIn& way_;
  Preconditions conditions_;
};

}  // namespace

std::vector<Precondition> PassingPreconditions(const UncertainWorld& world,
                                               const plan::Action& assemble,
                                               const Transform& X_ToolGrasp,
                                               const plan::Strategy* strategy) {
  const domain::Mating& mating = world.problem().mating(assemble.mating);
  const WayIn way = strategy != nullptr
                        ? WayToStrategy(world, assemble, X_ToolGrasp, *strategy)
                        : WayToSeat(world, assemble.mating, assemble.hold, X_ToolGrasp);
  PassingConditions conditions(world, assemble.mating, way);
  conditions.RequireClearOfFixed(strategy == nullptr);
  conditions.RequireClearOfTable();
  for (int p = 0; p < static_cast<int>(world.problem().parts.size()); ++p) {
    const PartId other(p);
    if (other != mating.held && other != mating.fixed) conditions.RequireClearOf(other);
  }
  return conditions.Take();
}

}  // namespace assay::uncertainty
