#include <fmt/format.h>

#include <algorithm>

#include "planner/algebra/simplify.h"
#include "planner/domain/part_model.h"
#include "planner/domain/shaft_fit.h"
#include "planner/uncertainty/clearance.h"
#include "planner/uncertainty/mating_end.h"
#include "planner/uncertainty/precondition.h"

namespace assay::uncertainty {
namespace {

using domain::ShaftFit;
using geometry::Box;

constexpr double kInPlane = 1e-6;  // metres by which what lies in a plane may stand out of it

double GreatestAlong(const Vector3& direction, const Box& box) {
  return direction.dot(box.X_FrameBox.translation()) +
         (box.X_FrameBox.linear().transpose() * direction).cwiseAbs().dot(box.half_extents);
}

// What `entry` and `slide-in` are about: a piece of a shaft, no wider than that is at its tip, and
// a piece of the hole's part that lies behind one of the hole's walls, and no farther out than its
// mouth.
class FitPieces {
 public:
  explicit FitPieces(const ShaftFit& fit)
      : fit_(fit), walls_(domain::SideWalls(fit, 0)), section_(domain::CrossSection(fit)) {}

  bool Has(const Box& of_held, const Box& of_fixed) const {
    return fit_.shaft_is_held ? IsOfShaft(of_held) && IsBehindWall(of_fixed)
                              : IsOfShaft(of_fixed) && IsBehindWall(of_held);
  }

 private:
  bool IsOfShaft(const Box& box) const {
    const Pose X_FeaturePart = fit_.shaft.X_PartFeature.inverse();
    return std::ranges::all_of(box.Corners(), [&](const Vector3& corner) {
      const Vector3 p = X_FeaturePart * corner;
      return p.z() < kInPlane && geometry::Depth(section_, p.head<2>()) > -kInPlane;
    });
  }
  bool IsBehindWall(const Box& box) const {
    const Vector3 out = fit_.hole.X_PartFeature.linear().col(2);
    const double mouth = out.dot(fit_.hole.X_PartFeature.translation());
    return GreatestAlong(out, box) < mouth + kInPlane &&
           std::ranges::any_of(walls_, [&](const domain::SideWall& wall) {
             return GreatestAlong(wall.normal, box) < wall.offset + kInPlane;
           });
  }

  const ShaftFit& fit_;
  std::vector<domain::SideWall> walls_;
  geometry::Polygon section_;
};

class PassingConditions {
 public:
  PassingConditions(const UncertainWorld& world, domain::MatingId id, const plan::Hold& hold,
                    const Transform& X_ToolGrasp)
      : world_(world),
        mating_(world.problem().mating(id)),
        held_model_(*world.problem().part(mating_.held).model),
        end_(MatingEndOf(world, id, hold, X_ToolGrasp)),
        back_(-LengthOfWay(world, id, end_.farther) * end_.motion),
        held_(Seated(world, mating_, end_)) {}

  // But for shafts and the walls of their holes, and for what lies ahead of the held part even at
  // the end: what meets first there is its seat.
  void RequireClearOfFixed() {
    const std::vector<ShaftFit> fits = domain::FitsOf(world_.problem(), mating_);
    const std::vector<FitPieces> pieces(fits.begin(), fits.end());
    const PossibleFrame fixed = BelievedFrameOf(world_, mating_.fixed);
    const Clearance clearance = ClearOf(mating_.fixed, PartId::None(), held_, fixed);
    for (const Box& of_held : held_model_.boxes()) {
      const Body body(held_, of_held, WayOf(world_, back_, 0));
      for (const Box& of_fixed : world_.problem().part(mating_.fixed).model->boxes()) {
        if (IsAhead(of_fixed, of_held)) continue;
        if (std::ranges::any_of(pieces,
                                [&](const FitPieces& fit) { return fit.Has(of_held, of_fixed); })) {
          continue;
        }
        RequireApart(body, Body(fixed, of_fixed), clearance, conditions_);
      }
    }
  }

  void RequireClearOf(PartId neighbour) {
    const BeliefShift shift = world_.ShiftAt(mating_.fixed, held_.planned.translation());
    const PossibleFrame held = Shifted(world_, held_, shift);
    const PossibleFrame other = FrameOf(world_, neighbour);
    const Clearance clearance = ClearOf(neighbour, neighbour, held, other);
    const StraightWay way = WayOf(world_, back_, shift.turn);
    for (const Box& of_held : held_model_.boxes()) {
      const Body body(held, of_held, way);
      for (const Box& box : world_.problem().part(neighbour).model->boxes()) {
        RequireApart(body, Body(other, box), clearance, conditions_);
      }
    }
  }

  std::vector<Precondition> Take() { return conditions_.Take(); }

 private:
  // Where the hand has it once it meets its seat.
  static PossibleFrame Seated(const UncertainWorld& world, const domain::Mating& mating,
                              const MatingEnd& end) {
    double angle = Magnitude(world.problem().gripper_error.theta);
    for (const Expression* turned : {&world.held().skew, &world.held().tip, &world.held().twist}) {
      angle += Magnitude(world.RangeOf(*turned));
    }
    return {world.X_WorldPart(mating.fixed) * mating.X_FixedHeld, algebra::Simplify(end.Seated()),
            angle};
  }

  bool IsAhead(const Box& of_fixed, const Box& of_held) const {
    const Vector3 motion = mating_.mating_vector.normalized();
    const double front = GreatestAlong(motion, of_held.Transformed(mating_.X_FixedHeld));
    return front < -GreatestAlong(-motion, of_fixed) + kInPlane;
  }

  Clearance ClearOf(PartId part, PartId neighbour, const PossibleFrame& held,
                    const PossibleFrame& other) const {
    const domain::Problem& problem = world_.problem();
    return {
        {"passing clear", fmt::format("{} passes {} on its way in", problem.part(mating_.held).name,
                                      problem.part(part).name)},
        DisplacementBetween(world_, held, other),
        Vector3::Constant(problem.workcell->rules().lateral_compliance),
        neighbour};
  }

  const UncertainWorld& world_;
  const domain::Mating& mating_;
  const domain::PartModel& held_model_;
  const MatingEnd end_;
  Vector3 back_;  // from the seat to where the motion starts, in the world
  PossibleFrame held_;
  Preconditions conditions_;
};

}  // namespace

std::vector<Precondition> PassingPreconditions(const UncertainWorld& world, domain::MatingId id,
                                               const plan::Hold& hold,
                                               const Transform& X_ToolGrasp) {
  const domain::Mating& mating = world.problem().mating(id);
  PassingConditions conditions(world, id, hold, X_ToolGrasp);
  conditions.RequireClearOfFixed();
  for (int p = 0; p < static_cast<int>(world.problem().parts.size()); ++p) {
    const PartId other(p);
    if (other != mating.held && other != mating.fixed) conditions.RequireClearOf(other);
  }
  return conditions.Take();
}

}  // namespace assay::uncertainty
