#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/algebra/expression/simplify.h"
#include "planner/domain/matings/mating_success.h"
#include "planner/domain/matings/shaft_fit.h"
#include "planner/domain/parts/part_model.h"
#include "planner/numeric/interval_arithmetic.h"
#include "planner/uncertainty/preconditions/precondition.h"
#include "planner/uncertainty/standing/dragging.h"

namespace assay::uncertainty {
namespace {

using domain::Mating;
using domain::Problem;

// Returns how far the walls of the holes let the held part move along a direction of the fixed
// part, in metres; infinite if no wall faces this direction.
double PlayAlong(const Problem& problem, const Mating& mating, const Vector3& along) {
  double play = kInfinity;
  for (const domain::FitGap& gap : domain::GapsOf(problem, mating)) {
    if (std::abs(gap.across.dot(along)) < 1 - domain::kUnitProduct) continue;
    play = std::min(play, std::max(gap.low, gap.high) + problem.tolerances.clearance);
  }
  return play;
}

// The requirements that points of a mated part end near their places. Walls that hold the part may
// prove them, whatever the errors are.
class PlaceConditions {
 public:
  PlaceConditions(const UncertainWorld& world, const Mating& mating, const RestingError& released,
                  const Drag& drag)
      : problem_(world.problem()),
        mating_(mating),
        drag_(drag),
        X_PossibleHeld_(PossiblePoseInFixed(world, mating, released)),
        X_FixedFeature_(FeatureOf(mating.fixed, mating.features[0].second)) {}

  std::vector<Precondition> Run() {
    const Vector3 shaft = PointOf(0);
    for (const int axis : {0, 1}) {
      RequireNear("lateral error", shaft, Axis(axis), PlayAlong(problem_, mating_, Axis(axis)),
                  domain::LateralLimit(problem_));
    }
    for (std::size_t pair = 1; pair < mating_.features.size(); ++pair) RequireAligned(pair, shaft);
    return conditions_.Take();
  }

 private:
  static Transform PossiblePoseInFixed(const UncertainWorld& world, const Mating& mating,
                                       const RestingError& released) {
    const Pose& X_WorldFixed = world.X_WorldPart(mating.fixed);
    return algebra::Simplify(
        algebra::Inverse(PossiblePose(X_WorldFixed, world.resting(mating.fixed))) *
        PossiblePose(X_WorldFixed * mating.X_FixedHeld, released));
  }

  Pose FeatureOf(PartId part, domain::FeatureNumber number) const {
    return problem_.part(part).model->FindFeature(number)->X_PartFeature;
  }
  Vector3 PointOf(std::size_t pair) const {
    return FeatureOf(mating_.held, mating_.features[pair].first).translation();
  }
  // Returns the axis of the held part's first feature, in its own frame.
  Vector3 ShaftAxis() const {
    return FeatureOf(mating_.held, mating_.features[0].first).linear().col(2);
  }
  Vector3 Axis(int axis) const { return X_FixedFeature_.linear().col(axis); }

  // Holes that are to lie in line are displaced with the shaft, and turned with the shaft about its
  // axis. The limit is a limit of the norm of two components. Each component gets an equal share of
  // this limit.
  void RequireAligned(std::size_t pair, const Vector3& shaft) {
    const Vector3 point = PointOf(pair);
    const double limit = domain::AlignmentLimit(problem_);
    double play = kInfinity;
    if (domain::HasShaftInHole(problem_, mating_)) {
      const domain::SeatPlay seat =
          domain::PlayInSeat(problem_, mating_, problem_.tolerances.clearance);
      play =
          std::hypot(PlayAlong(problem_, mating_, Axis(0)), PlayAlong(problem_, mating_, Axis(1))) +
          seat.spin * (point - shaft).cross(ShaftAxis()).norm();
    }
    const double share = play < limit ? limit : limit / std::numbers::sqrt2;
    for (const int axis : {0, 1}) RequireNear("alignment", point, Axis(axis), play, share);
  }

  // Requires that the point of the held part ends within the limit of its place, along a direction
  // of the fixed part. The walls let it move by `play`.
  void RequireNear(const char* what, const Vector3& p_Held, const Vector3& along, double play,
                   double limit) {
    const std::string meaning =
        fmt::format("{} of {} in {}", what, problem_.part(mating_.held).name,
                    problem_.part(mating_.fixed).name);
    if (play < limit) return conditions_.Less(plan::condition::kInPlace, meaning, play, limit);
    const Vector3 place = mating_.X_FixedHeld * p_Held;
    const Expression off =
        algebra::Dot(AsVector(along), X_PossibleHeld_ * AsVector(p_Held)) - along.dot(place);
    const double dragged = std::numbers::sqrt2 * drag_.way + drag_.turn * place.norm();
    conditions_.Within(plan::condition::kInPlace, meaning, off, limit - dragged);
  }

  const Problem& problem_;
  const Mating& mating_;
  const Drag& drag_;
  const Transform X_PossibleHeld_;
  const Pose X_FixedFeature_;
  Preconditions conditions_;
};

}  // namespace

std::vector<Precondition> PlacePreconditions(const UncertainWorld& world, domain::MatingId mating,
                                             const RestingError& released, const Drag& drag) {
  return PlaceConditions(world, world.problem().mating(mating), released, drag).Run();
}

}  // namespace assay::uncertainty
