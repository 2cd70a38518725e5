#include "planner/uncertainty/preconditions/touching_ahead.h"

#include <Eigen/Geometry>

#include "planner/domain/parts/part_model.h"
#include "planner/geometry/collision.h"
#include "planner/geometry/polygon.h"

namespace assay::uncertainty {
namespace {

using geometry::ConvexHull;
using geometry::Polygon;
using geometry::Vector2;
using geometry::Vector3;

constexpr double kInSeat = 1e-6;  // metres between pieces that touch at the seat

// Returns the distance along the motion between two pieces at the seat, in metres.
double GapAhead(const domain::Mating& mating, const ConvexHull& of_fixed,
                const ConvexHull& of_held) {
  const Vector3 motion = mating.mating_vector.normalized();
  return -GreatestAlong(of_fixed, -motion) -
         GreatestAlong(Transformed(of_held, mating.X_FixedHeld), motion);
}

// Returns the shadow of a body along z, widened by `around` metres.
Polygon ShadowOf(const ConvexHull& body, double around) {
  std::vector<Vector2> points;
  for (const Vector3& p : body.vertices) {
    for (const Vector2& corner : {Vector2(1, 1), Vector2(1, -1), Vector2(-1, 1), Vector2(-1, -1)})
      points.push_back(p.head<2>() + around * corner);
  }
  return geometry::Hull2(points);
}

}  // namespace

bool LiesAhead(const domain::Mating& mating, const ConvexHull& of_fixed,
               const ConvexHull& of_held) {
  return GapAhead(mating, of_fixed, of_held) > -kInSeat;
}

std::vector<Vector3> FirstTouches(const domain::Problem& problem, const domain::Mating& mating,
                                  double lean, double off) {
  const domain::PartModel& held = *problem.part(mating.held).model;
  const double lowered = lean * 2 * held.shape().radius();  // by a turn about another point
  const Eigen::Quaterniond R_AlongFixed =
      Eigen::Quaterniond::FromTwoVectors(mating.mating_vector.normalized(), Vector3::UnitZ());
  const geometry::Pose X_AlongFixed(R_AlongFixed);
  std::vector<Vector3> touches;
  for (const ConvexHull& of_held : held.pieces()) {
    const Polygon shadow = ShadowOf(Transformed(of_held, X_AlongFixed * mating.X_FixedHeld), off);
    for (const ConvexHull& of_fixed : problem.part(mating.fixed).model->pieces()) {
      const double gap = GapAhead(mating, of_fixed, of_held);
      if (gap <= kInSeat || gap > lowered) continue;
      const ConvexHull along = Transformed(of_fixed, X_AlongFixed);
      const double nearest = -GreatestAlong(along, -Vector3::UnitZ());
      for (const Vector2& p : geometry::Intersection(shadow, ShadowOf(along, 0)))
        touches.push_back(R_AlongFixed.inverse() * Vector3(p.x(), p.y(), nearest));
    }
  }
  return touches;
}

}  // namespace assay::uncertainty
