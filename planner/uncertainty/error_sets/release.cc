#include "planner/uncertainty/error_sets/release.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "planner/algebra/expression/simplify.h"
#include "planner/domain/matings/shaft_fit.h"
#include "planner/domain/parts/part_model.h"
#include "planner/geometry/collision.h"
#include "planner/plan/certificates/pushing.h"
#include "planner/uncertainty/error_sets/axis_angle.h"
#include "planner/uncertainty/pads/touching_cells.h"
#include "planner/uncertainty/standing/tilting.h"

namespace assay::uncertainty {
namespace {

constexpr double kAcross = 1e-9;  // cosine of the angle between two directions across each other

Expression SameOrOppositeSense(const Vector3& up, const Expression& theta) {
  return up.z() < 0 ? -theta : theta;
}

constexpr double kUnlimited = std::numeric_limits<double>::infinity();
constexpr domain::SeatPlay kNoSeat = {.shift = kUnlimited, .turn = kUnlimited, .spin = kUnlimited};

// Adds the errors that arise when a leaning part comes to stand upright at X_WorldPart. The table
// levels the part between the pads, or the part falls as the pads let it go. The walls of a seat
// with this play hold a part that falls.
void SetUpright(UncertainWorld& world, PartId part, const Pose& X_WorldPart, const Leaning& leaning,
                const domain::SeatPlay& play, RestingError& error) {
  const auto declare = [&](const plan::ErrorKind& kind, double magnitude) {
    return world.Declare(kind, {-magnitude, magnitude}, part);
  };
  const Fall fall = FallOf(world, part, X_WorldPart);
  const double by_fall = std::min(fall.turn * leaning.tilt, 2 * play.turn);
  const double theta = std::max(leaning.twist, leaning.turn + by_fall);
  error.theta = declare(plan::error::kTheta, std::min(theta, std::numbers::pi));
  const double radius = world.problem().part(part).model->shape().radius();
  const double fallen = std::min(fall.way * leaning.tilt, 2 * play.shift);
  const double settled = std::max(radius * leaning.levelling, fallen);
  for (Expression& along : error.displacement)
    along = along + declare(plan::error::kSettle, settled);
}

void Yield(UncertainWorld& world, PartId part, RestingError& error) {
  const double compliance = world.problem().workcell->rules().lateral_compliance;
  for (Expression& along : error.displacement) {
    along = along + world.Declare(plan::error::kYield, {-compliance, compliance}, part);
  }
}

// Returns whether a part that is let go in its seat may slide until the walls stop it. It may slide
// if the seat leans more than the least friction between the two parts can hold.
bool SlidesInSeat(const domain::Problem& problem, const domain::Mating& mating,
                  const Vector3& motion) {
  const double friction = std::max(problem.part(mating.held).model->friction(),
                                   problem.part(mating.fixed).model->friction()) -
                          problem.tolerances.friction;
  return motion.head<2>().norm() > friction * -motion.z();
}

}  // namespace

// The hand has turned the part by `turned`, in radians about the tool's axes. The table turns the
// part back until only a turn about the vertical is left, `twist` * up. The axes about which the
// part is turned back depend on the pads. For some values of `twist`, the part is not turned back
// about one of the axes. The remaining turn lies between the least and the greatest of these
// values. Beyond them, the part would have to be turned farther about every axis. Turning about
// several axes adds terms that are products of angles.
Leaning LeaningOf(const UncertainWorld& world, const Vector3& up, const ManipulatorError& draw) {
  const HeldError& held = world.held();
  const auto most = [&](const Expression& angle) { return Magnitude(world.RangeOf(angle)); };
  Vector3 turned(most(held.tip), most(held.twist), most(draw.theta) + most(held.skew));
  Leaning leaning;
  for (const int axis : {0, 1, 2}) leaning.tilt += SwingOf(turned[axis], up[axis]);
  turned.array() += leaning.tilt * turned.sum();
  leaning.turn = up.cwiseAbs().dot(turned);
  for (const int axis : {0, 1, 2}) {
    if (up[axis] == 0) continue;
    const double twist = std::min(std::numbers::pi, turned[axis] / std::abs(up[axis]));
    Vector3 back = twist * up.cwiseAbs() + turned;
    back[axis] = 0;
    leaning.twist = std::max(leaning.twist, twist);
    leaning.levelling = std::max(leaning.levelling, back.norm());
  }
  return leaning;
}

bool ComesUpright(const UncertainWorld& world, const plan::Hold& hold, const Pose& X_WorldPart) {
  const HeldError& held = world.held();
  return std::abs(VerticalInTool(X_WorldPart * hold.X_PartTool).z()) == 1 &&
         held.tip.IsConstant(0) && held.twist.IsConstant(0);
}

double SlideOfPads(const UncertainWorld& world, const ManipulatorError& draw,
                   const RestingError& released) {
  if (plan::PadsBearResistance(world.problem())) return 0;
  const double doubt = Magnitude(world.RangeOf(draw.z)) +
                       Magnitude(world.RangeOf(released.displacement[2])) +
                       OffInHandOf(world, world.held()).shift.norm();
  const double travel = world.problem().workcell->rules().guarded_travel;
  return 2 * std::min(doubt, travel) + plan::kBeyondContact;
}

namespace {

// Adds the movement of a part that pads push aside as they slide down on it along `motion`, a unit
// vector.
void SlideAside(UncertainWorld& world, PartId part, const plan::Hold& hold,
                const ManipulatorError& draw, const Pose& X_WorldPart, const Vector3& motion,
                RestingError& error) {
  if (world.propagation() == Propagation::kPaper) return;
  const Vector3 closing = (X_WorldPart * hold.X_PartTool).linear().col(1);
  const Vector3 aside = closing - closing.dot(motion) * motion;
  const double slide = SlideOfPads(world, draw, error);
  if (slide == 0 || std::abs(closing.dot(motion)) < kAcross) return;
  if (aside.norm() < kAcross) return;  // such pads bear the part, and do not slide along it
  const Vector3 pushed = slide * std::abs(closing.dot(motion)) / aside.squaredNorm() * aside;
  for (const int axis : {0, 1, 2}) {
    const double most = std::abs(pushed[axis]);
    error.displacement[axis] =
        error.displacement[axis] + world.Declare(plan::error::kSettle, {-most, most}, part);
  }
}

// Returns the error of a part after the hand has let it go, in a seat with this play.
RestingError ReleaseWithin(UncertainWorld& world, PartId part, const plan::Hold& hold,
                           const Transform& X_ToolGrasp, const ManipulatorError& draw,
                           const Pose& X_WorldPart, const domain::SeatPlay& play) {
  const Pose X_WorldTool = X_WorldPart * hold.X_PartTool;
  const Transform released = PossibleHeldPose(X_WorldTool, X_ToolGrasp, hold.X_PartTool);
  RestingError error;
  error.displacement =
      algebra::Simplify(released.translation - AsTransform(X_WorldPart).translation);
  const Vector3 up = VerticalInTool(X_WorldTool);
  error.theta = SameOrOppositeSense(up, draw.theta + world.held().skew);
  if (world.propagation() == Propagation::kSound && !ComesUpright(world, hold, X_WorldPart)) {
    SetUpright(world, part, X_WorldPart, LeaningOf(world, up, draw), play, error);
  }
  return error;
}

}  // namespace

RestingError Release(UncertainWorld& world, PartId part, const plan::Hold& hold,
                     const Transform& X_ToolGrasp, const ManipulatorError& draw,
                     const Pose& X_WorldPart) {
  return ReleaseWithin(world, part, hold, X_ToolGrasp, draw, X_WorldPart, kNoSeat);
}

RestingError ReleaseOnTable(UncertainWorld& world, PartId part, const plan::Hold& hold,
                            const Transform& X_ToolGrasp, const ManipulatorError& draw,
                            const Pose& X_WorldPart) {
  RestingError error = Release(world, part, hold, X_ToolGrasp, draw, X_WorldPart);
  SlideAside(world, part, hold, draw, X_WorldPart, -Vector3::UnitZ(), error);
  return error;
}

RestingError ReleaseInSeat(UncertainWorld& world, domain::MatingId id, const plan::Hold& hold,
                           const Transform& X_ToolGrasp, const ManipulatorError& draw) {
  const domain::Mating& mating = world.problem().mating(id);
  const Pose& X_WorldFixed = world.X_WorldPart(mating.fixed);
  const Pose X_WorldHeld = X_WorldFixed * mating.X_FixedHeld;
  if (world.propagation() == Propagation::kPaper)
    return Release(world, mating.held, hold, X_ToolGrasp, draw, X_WorldHeld);
  const domain::SeatPlay play =
      domain::PlayInSeat(world.problem(), mating, world.problem().tolerances.clearance);
  RestingError error =
      ReleaseWithin(world, mating.held, hold, X_ToolGrasp, draw, X_WorldHeld, play);
  const Vector3 along = X_WorldFixed.linear() * mating.mating_vector.normalized();
  if (SlidesInSeat(world.problem(), mating, along)) return LedToSeat(world, id);
  SlideAside(world, mating.held, hold, draw, X_WorldHeld, along, error);
  Yield(world, mating.held, error);
  const SymbolicVector motion = AsVector(along);
  const SymbolicVector seat = PossiblePose(X_WorldFixed, world.resting(mating.fixed)) *
                                  AsVector(mating.X_FixedHeld.translation()) -
                              AsVector(X_WorldHeld.translation());
  const Expression farther = algebra::Dot(motion, seat - error.displacement);
  for (const int axis : {0, 1, 2}) {
    error.displacement[axis] = algebra::Simplify(error.displacement[axis] + farther * motion[axis]);
  }
  return error;
}

RestingError LedToSeat(UncertainWorld& world, domain::MatingId id) {
  const domain::Problem& problem = world.problem();
  const domain::Mating& mating = problem.mating(id);
  const Pose& X_WorldFixed = world.X_WorldPart(mating.fixed);
  const RestingError& fixed = world.resting(mating.fixed);
  const SymbolicVector origin = AsVector(mating.X_FixedHeld.translation());
  const domain::SeatPlay play = domain::PlayInSeat(problem, mating, problem.tolerances.clearance);
  const auto declare = [&](const plan::ErrorKind& kind, double magnitude) {
    return world.Declare(kind, {-magnitude, magnitude}, mating.held);
  };
  RestingError error;
  error.displacement = algebra::Simplify(PossiblePose(X_WorldFixed, fixed) * origin -
                                         AsTransform(X_WorldFixed) * origin);
  for (Expression& along : error.displacement)
    along = along + declare(plan::error::kPlay, play.shift);
  error.theta = fixed.theta + declare(plan::error::kTurn, play.turn);
  return error;
}

}  // namespace assay::uncertainty
