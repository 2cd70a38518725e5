#include "planner/uncertainty/standing/dragging.h"

#include <algorithm>
#include <numbers>

#include "planner/domain/parts/part_model.h"
#include "planner/domain/resting/resting.h"
#include "planner/geometry/collision.h"
#include "planner/geometry/polygon.h"
#include "planner/plan/certificates/pushing.h"
#include "planner/uncertainty/error_sets/axis_angle.h"
#include "planner/uncertainty/error_sets/release.h"
#include "planner/uncertainty/standing/support.h"
#include "planner/uncertainty/standing/turn_of_push.h"

namespace assay::uncertainty {
namespace {

double RadiusOf(const domain::Problem& problem, PartId part) {
  return problem.part(part).model->shape().radius();
}

// Returns how far a straight mating may push what it meets aside, in metres.
double WayOfPush(const UncertainWorld& world, const domain::Mating& mating, const plan::Hold& hold,
                 const ManipulatorError& draw) {
  const domain::Problem& problem = world.problem();
  const double yields = problem.workcell->rules().lateral_compliance;
  const Pose X_WorldHeld = world.X_WorldPart(mating.fixed) * mating.X_FixedHeld;
  if (ComesUpright(world, hold, X_WorldHeld)) return yields;
  const Vector3 up = VerticalInTool(X_WorldHeld * hold.X_PartTool);
  return yields + RadiusOf(problem, mating.held) * LeaningOf(world, up, draw).levelling;
}

// Returns whether friction between the two parts may move the fixed part along.
bool Drags(const UncertainWorld& world, const domain::Mating& mating) {
  const domain::Problem& problem = world.problem();
  const double between = std::max(problem.part(mating.held).model->friction(),
                                  problem.part(mating.fixed).model->friction()) +
                         problem.tolerances.friction;
  const Push push = {.at = {}, .down = plan::kGreatestPush, .aside = between * plan::kGreatestPush};
  return SlidingRatio(world, mating.fixed, {push}) >= 1;
}

// Returns whether a part that is dragged may touch another one, seen from above.
bool MayTouch(const UncertainWorld& world, const Drag& drag, PartId other) {
  const domain::Problem& problem = world.problem();
  const Pose& X_WorldPart = world.X_WorldPart(drag.part);
  const Pose& X_WorldOther = world.X_WorldPart(other);
  const double moves = std::numbers::sqrt2 * ReachOfDrag(problem, {drag}, drag.part) +
                       ReachOf(world, drag.part, world.about_plan(drag.part)) +
                       ReachOf(world, other, world.about_plan(other));
  return geometry::Gap(domain::Footprint(problem.part(drag.part), X_WorldPart),
                       domain::Footprint(problem.part(other), X_WorldOther)) <= moves;
}

// Returns the movement of a part that moves rigidly with another one, or is pushed by it.
Drag MovedAlong(const UncertainWorld& world, const Drag& drag, PartId to) {
  const Pose& X_WorldTo = world.X_WorldPart(to);
  const double arm =
      (X_WorldTo.translation() - world.X_WorldPart(drag.part).translation()).head<2>().norm();
  const double radius = RadiusOf(world.problem(), to);
  const double pushed = drag.way + drag.turn * (arm + radius);
  const double turn =
      std::max(drag.turn, TurnOfPush(world, to, X_WorldTo, std::numbers::sqrt2 * pushed));
  return {to, pushed + turn * radius, turn};
}

}  // namespace

double ReachOfDrag(const domain::Problem& problem, const std::vector<Drag>& drags, PartId part) {
  const auto drag = std::ranges::find(drags, part, &Drag::part);
  return drag == drags.end() ? 0 : drag->way + drag->turn * RadiusOf(problem, part);
}

std::vector<Drag> DragsOf(const UncertainWorld& world, domain::MatingId id, const plan::Hold& hold,
                          const ManipulatorError& draw) {
  if (world.propagation() == Propagation::kPaper) return {};
  const domain::Mating& mating = world.problem().mating(id);
  const double way = WayOfPush(world, mating, hold, draw);
  if (way == 0 || !Drags(world, mating)) return {};
  const Pose& X_WorldFixed = world.X_WorldPart(mating.fixed);
  std::vector<Drag> drags = {
      {mating.fixed, way, TurnOfPush(world, mating.fixed, X_WorldFixed, way)}};
  for (std::size_t i = 0; i < drags.size(); ++i) {
    for (int p = 0; p < static_cast<int>(world.problem().parts.size()); ++p) {
      const PartId other(p);
      if (other == world.in_hand() || std::ranges::count(drags, other, &Drag::part) > 0) continue;
      if (MayTouch(world, drags[i], other)) drags.push_back(MovedAlong(world, drags[i], other));
    }
  }
  return drags;
}

Drag DragOfFixed(const UncertainWorld& world, domain::MatingId id, const plan::Hold& hold,
                 const ManipulatorError& draw) {
  const std::vector<Drag> drags = DragsOf(world, id, hold, draw);
  return drags.empty() ? Drag{world.problem().mating(id).fixed} : drags.front();
}

void DragAlong(UncertainWorld& world, const std::vector<Drag>& drags) {
  for (const auto& [part, way, turn] : drags) {
    RestingError error = world.resting(part);
    for (const int axis : {0, 1}) {
      error.displacement[axis] =
          error.displacement[axis] + world.Declare(plan::error::kDrag, {-way, way}, part);
    }
    error.theta = error.theta + world.Declare(plan::error::kThetaDrag, {-turn, turn}, part);
    const BelievedShift shift = world.shift(part);
    world.SetResting(part, Pose(world.X_WorldPart(part)), error, shift);
  }
}

}  // namespace assay::uncertainty
