#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "planner/algebra/expression/simplify.h"
#include "planner/base/check.h"
#include "planner/domain/matings/mating_classes.h"
#include "planner/domain/matings/shaft_fit.h"
#include "planner/geometry/pose.h"
#include "planner/numeric/interval_arithmetic.h"
#include "planner/plan/certificates/condition_table.h"
#include "planner/uncertainty/error_sets/mating_end.h"
#include "planner/uncertainty/preconditions/precondition.h"

namespace assay::uncertainty {
namespace {

using domain::kUnitProduct;
using domain::ShaftFit;
using domain::SideWall;
using geometry::Polygon;
using geometry::Vector2;

// The worst values in a mating, which may be worse than the values of the problem. For every
// condition in this file, the narrowest hole and the greatest friction are the worst case. A larger
// hole only adds room, and no condition relies on a wall that stops the shaft.
struct Worst {
  double narrowing = 0;  // loss of width on each side of a hole, metres
  double friction = 0;   // friction of the mating surfaces
};

Worst WorstOf(const UncertainWorld& world, const domain::Mating& mating) {
  const domain::Problem& problem = world.problem();
  if (world.propagation() == Propagation::kPaper)
    return {.friction = problem.workcell->rules().friction};
  return {.narrowing = problem.tolerances.clearance,
          .friction = domain::GreatestMatingFriction(problem, mating)};
}

// The pose of the shaft's part as seen from the hole's part: its nominal pose and its possible
// pose.
struct Relative {
  Pose nominal;
  Transform possible;
};

class FitConditions {
 public:
  FitConditions(const ShaftFit& fit, const UncertainWorld& world, const domain::Mating& mating,
                Preconditions& conditions)
      : fit_(fit),
        compliance_(world.problem().workcell->rules().lateral_compliance),
        worst_(WorstOf(world, mating)),
        conditions_(conditions),
        walls_(domain::SideWalls(fit, worst_.narrowing)),
        section_(domain::CrossSection(fit)) {
    ASSAY_CHECK(!walls_.empty() && !section_.empty(), "nothing to prove of {}", fit.name);
  }

  // Adds the conditions of one fit. `entering` is the pose with the tip in the mouth, `seated` the
  // pose `depth` metres further. The shaft moves straight in between, so conditions that hold at
  // both ends hold on the way.
  void Require(const Relative& entering, const Relative& seated, double depth) {
    const double bevel = fit_.hole.chamfer + fit_.shaft.chamfer;
    RequireInside(plan::condition::kEntry, entering, 0, bevel);
    if (bevel > 0) RequireInside(plan::condition::kSlideIn, entering, 0, 0);
    RequireInside(plan::condition::kSlideIn, seated, 0, 0);
    RequireInside(plan::condition::kSlideIn, seated, depth, 0);
    RequireUpright(seated, depth);
  }

 private:
  // Requires that the corners of the shaft, `behind` metres behind its tip, lie inside the walls.
  void RequireInside(plan::Condition condition, const Relative& at, double behind, double bevel) {
    if (const std::optional<double> radius = domain::RadiusOfRound(section_)) {
      return RequireInside(condition, at, behind, bevel, *radius);
    }
    std::vector<SymbolicVector> corners;
    for (const Vector2& corner : section_) {
      corners.push_back(at.possible * AsVector(fit_.shaft.X_PartFeature *
                                               Vector3(corner.x(), corner.y(), -behind)));
    }
    const std::string meaning = fmt::format("{} stays inside the walls", fit_.name);
    for (const SideWall& wall : walls_) {
      const SideWall* opposite = Opposite(wall);
      const double yields = opposite != nullptr ? compliance_ : 0;
      for (const SymbolicVector& p : corners) {
        conditions_.Greater(condition, meaning, algebra::Dot(AsVector(wall.normal), p),
                            wall.offset - bevel - yields);
      }
      if (yields > 0) RequireBetween(condition, wall, *opposite, corners, bevel);
    }
  }

  // Requires that a round shaft is inside the walls. The circle through the corners of the shaft
  // reaches no farther along a wall's normal than the radius of the circle, however the shaft turns
  // and leans.
  void RequireInside(plan::Condition condition, const Relative& at, double behind, double bevel,
                     double radius) {
    const SymbolicVector center =
        at.possible * AsVector(fit_.shaft.X_PartFeature * Vector3(0, 0, -behind));
    for (const SideWall& wall : walls_) {
      conditions_.Greater(condition, fmt::format("{} stays inside the walls", fit_.name),
                          algebra::Dot(AsVector(wall.normal), center),
                          wall.offset + radius - bevel);
    }
  }

  // Requires that the shaft is no wider than the hole, however the wrist yields.
  void RequireBetween(plan::Condition condition, const SideWall& wall, const SideWall& opposite,
                      const std::vector<SymbolicVector>& corners, double bevel) {
    for (const SymbolicVector& p : corners) {
      for (const SymbolicVector& q : corners) {
        if (&p == &q) continue;
        constexpr auto kYielding = plan::Circumstance::kYieldingWrist;
        conditions_.Add({.condition = condition,
                         .meaning = fmt::format("{}{}", fit_.name, plan::WordsOf(kYielding)),
                         .expression = algebra::Dot(AsVector(wall.normal), p - q),
                         .relation = plan::Relation::kGreater,
                         .limit = wall.offset + opposite.offset - 2 * bevel,
                         .circumstance = kYielding});
      }
    }
  }

  // Returns the wall that faces this one. Returns null if there is none, or if another wall is
  // neither parallel to this one nor at a right angle to it: yielding across one pair would then be
  // yielding across another pair.
  const SideWall* Opposite(const SideWall& wall) const {
    const SideWall* opposite = nullptr;
    for (const SideWall& other : walls_) {
      const double facing = other.normal.dot(wall.normal);
      if (facing < kUnitProduct - 1) {
        opposite = &other;
      } else if (facing < 1 - kUnitProduct && std::abs(facing) > kUnitProduct) {
        return nullptr;
      }
    }
    return opposite;
  }

  void RequireUpright(const Relative& seated, double depth) {
    const Vector3 axis = fit_.shaft.X_PartFeature.linear().col(2);
    Transform turn = seated.possible;
    turn.translation = {0, 0, 0};
    const SymbolicVector direction = turn * AsVector(axis);
    for (const domain::Slot& slot : domain::SlotsOf(walls_)) {
      const Vector3& across = slot.across;
      const double width = domain::ExtentOf(fit_, section_, across).width();
      const double clearance = slot.high - slot.low - width;
      const double wedging =
          worst_.friction > 0 ? clearance / (worst_.friction * width) : kInfinity;
      conditions_.Within(plan::condition::kTilt,
                         fmt::format("{} neither touches twice nor wedges", NameOf(fit_, slot)),
                         algebra::Dot(AsVector(across), direction),
                         std::min(clearance / depth, wedging));
    }
  }

  const ShaftFit& fit_;
  double compliance_;
  Worst worst_;
  Preconditions& conditions_;
  std::vector<SideWall> walls_;
  Polygon section_;
};

class MatingConditions {
 public:
  MatingConditions(const UncertainWorld& world, domain::MatingId id, const plan::Hold& hold,
                   const Transform& X_ToolGrasp)
      : world_(world),
        mating_(world.problem().mating(id)),
        end_(MatingEndOf(world, id, hold, X_ToolGrasp)),
        seated_({mating_.X_FixedHeld,
                 algebra::Simplify(algebra::Inverse(end_.fixed) * end_.Seated())}) {}

  std::vector<Precondition> Run() {
    for (const ShaftFit& fit : domain::FitsOf(world_.problem(), mating_)) RequireFit(fit);
    RequireSeat();
    return conditions_.Take();
  }

 private:
  // Returns the pose `distance` metres before the end of the mating motion, which goes straight in
  // the world.
  Relative Before(double distance) const {
    const Vector3 shift = -distance * mating_.mating_vector.normalized();
    const Vector3 in_world = -distance * end_.motion;
    Transform to_fixed = algebra::Inverse(end_.fixed);
    to_fixed.translation = {0, 0, 0};
    Transform possible = seated_.possible;
    possible.translation = possible.translation + algebra::Simplify(to_fixed * AsVector(in_world));
    return {geometry::Translation(shift) * seated_.nominal, possible};
  }

  static Relative Inverted(const Relative& relative) {
    return {relative.nominal.inverse(), algebra::Inverse(relative.possible)};
  }

  void RequireFit(const ShaftFit& fit) {
    const Relative entering = Before(fit.depth);
    if (fit.shaft_is_held) {
      FitConditions(fit, world_, mating_, conditions_).Require(entering, seated_, fit.depth);
    } else {
      FitConditions(fit, world_, mating_, conditions_)
          .Require(Inverted(entering), Inverted(seated_), fit.depth);
    }
  }

  void RequireSeat() {
    conditions_.Within(plan::condition::kSeat,
                       "the part reaches its seat within the guarded travel", end_.farther,
                       world_.problem().workcell->rules().guarded_travel);
  }

  const UncertainWorld& world_;
  const domain::Mating& mating_;
  const MatingEnd end_;
  const Relative seated_;
  Preconditions conditions_;
};

}  // namespace

std::vector<Precondition> MatingPreconditions(const UncertainWorld& world, domain::MatingId mating,
                                              const plan::Hold& hold,
                                              const Transform& X_ToolGrasp) {
  return MatingConditions(world, mating, hold, X_ToolGrasp).Run();
}

}  // namespace assay::uncertainty
