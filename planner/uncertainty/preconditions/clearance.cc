#include "planner/uncertainty/preconditions/clearance.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/algebra/expression/simplify.h"
#include "planner/base/interval.h"
#include "planner/domain/parts/part_model.h"
#include "planner/geometry/hull.h"

namespace assay::uncertainty {
namespace {

constexpr double kParallelEdges = 1e-6;  // sine of the angle between edges
constexpr double kOpposite = 1e-9;       // length of the sum of opposite unit normals
constexpr double kAhead = 1e-12;         // metres: less than this is rounding

Expression Along(const Vector3& direction, const SymbolicVector& p) {
  return direction.x() * p[0] + direction.y() * p[1] + direction.z() * p[2];
}

bool IsNone(const BelievedShift& shift) {
  return shift.turn.IsConstant(0) &&
         std::ranges::all_of(shift.displacement, [](const auto& d) { return d.IsConstant(0); });
}

PossibleFrame FrameOf(const UncertainWorld& world, const Pose& planned, const RestingError& error) {
  return {planned, PossiblePose(planned, error), Magnitude(world.RangeOf(error.theta))};
}

// Searches for the plane for which the gap between two bodies is widest after the possible
// displacements are subtracted. The first plane that leaves enough ends the search.
class WidestGap {
 public:
  WidestGap(const Body& from, const Body& to, const Vector3& displacement, double enough)
      : from_(from), to_(to), displacement_(displacement), enough_(enough) {}

  bool TrySides() {
    const auto tries = [&](const Vector3& normal) { return Try(normal); };
    return std::ranges::any_of(from_.normals(), tries) || std::ranges::any_of(to_.normals(), tries);
  }
  bool TryEdges() { return TryEdges(from_, from_) || TryEdges(to_, to_) || TryEdges(from_, to_); }

  const Vector3& direction() const { return direction_; }

 private:
  // Planes along two edges of one body are its own faces. The faces of a body without a way are
  // tried already.
  bool TryEdges(const Body& a, const Body& b) {
    if (&a == &b && !a.has_way()) return false;
    return std::ranges::any_of(a.edges(), [&](const Vector3& along_a) {
      return std::ranges::any_of(
          b.edges(), [&](const Vector3& along_b) { return Try(along_a.cross(along_b)); });
    });
  }
  bool Try(const Vector3& normal) {
    const double length = normal.norm();
    if (length < kParallelEdges) return false;
    const Vector3 direction = normal / length;
    const double displaced = displacement_.dot(direction.cwiseAbs());
    const Interval from = from_.ReachAlong(direction);
    const Interval to = to_.ReachAlong(direction);
    Widen(to.low - from.high - displaced, direction);
    Widen(from.low - to.high - displaced, -direction);
    return gap_ > enough_;
  }
  void Widen(double gap, const Vector3& direction) {
    if (!(gap > gap_)) return;
    gap_ = gap;
    direction_ = direction;
  }

  const Body& from_;
  const Body& to_;
  const Vector3& displacement_;
  double enough_;
  double gap_ = -std::numeric_limits<double>::infinity();
  Vector3 direction_ = Vector3::UnitZ();
};

}  // namespace

Vector3 DisplacementBetween(const UncertainWorld& world, const PossibleFrame& a,
                            const PossibleFrame& b) {
  const Vector3 planned = a.planned.translation() - b.planned.translation();
  const SymbolicVector off =
      algebra::Simplify(a.possible.translation - b.possible.translation - AsVector(planned));
  return {Magnitude(world.RangeOf(off[0])), Magnitude(world.RangeOf(off[1])),
          Magnitude(world.RangeOf(off[2]))};
}

PossibleFrame FrameOf(const UncertainWorld& world, PartId part) {
  return FrameOf(world, world.X_WorldPart(part), world.about_plan(part));
}

PossibleFrame BelievedFrameOf(const UncertainWorld& world, PartId part) {
  return FrameOf(world, world.X_WorldPart(part), world.resting(part));
}

PossibleFrame Shifted(const UncertainWorld& world, const PossibleFrame& frame,
                      const BelievedShift& shift) {
  if (IsNone(shift)) return frame;
  const Transform moved =
      PossiblePose(frame.planned, {.displacement = shift.displacement, .theta = shift.turn}) *
      AsTransform(frame.planned.inverse());
  return {frame.planned, algebra::Simplify(moved * frame.possible),
          frame.angle + Magnitude(world.RangeOf(shift.turn))};
}

StraightWay WayOf(const UncertainWorld& world, const Vector3& planned, const Expression& turn) {
  return {planned, algebra::Simplify(algebra::RotationZ(turn) * AsVector(planned)),
          planned.norm() * Magnitude(world.RangeOf(turn))};
}

Body::Body(const PossibleFrame& frame, const geometry::ConvexHull& solid, const StraightWay& way)
    : frame_(&frame), solid_(solid), way_(way), planned_(Transformed(solid, frame.planned)) {
  double radius = 0;
  for (const Vector3& vertex : solid.vertices) radius = std::max(radius, vertex.norm());
  turned_ = radius * frame.angle + way.doubt;
  for (const geometry::Facet& facet : planned_.facets) {
    const auto is_opposite = [&](const Vector3& normal) {
      return (normal + facet.normal).norm() < kOpposite;
    };
    if (std::ranges::none_of(normals_, is_opposite)) normals_.push_back(facet.normal);
  }
  edges_ = EdgeDirections(planned_);
  if (has_way()) edges_.push_back(way_.planned.normalized());
}

Interval Body::ReachAlong(const Vector3& direction) const {
  const double way = direction.dot(way_.planned);
  return {-GreatestAlong(planned_, -direction) + std::min(way, 0.0),
          GreatestAlong(planned_, direction) + std::max(way, 0.0)};
}

SymbolicVector Body::Possible(const Point& point) const {
  const SymbolicVector p = frame_->possible * AsVector(point.local);
  return point.at_far_end ? p + way_.possible : p;
}

// A point that is surely behind another one is left out. Both points have the same displacement,
// and a turn moves one against the other by no more than their distance allows.
std::vector<Body::Point> Body::Foremost(const Vector3& direction) const {
  std::vector<Point> points;
  for (const Vector3& corner : solid_.vertices) {
    const Vector3 planned = frame_->planned * corner;
    points.push_back({corner, planned, false});
    if (has_way()) points.push_back({corner, planned + way_.planned, true});
  }
  const auto is_behind = [&](const Point& p, const Point& other) {
    const double way = other.at_far_end != p.at_far_end ? way_.doubt : 0;
    return direction.dot(other.planned - p.planned) >
           frame_->angle * (other.local - p.local).norm() + way + kAhead;
  };
  std::vector<Point> foremost;
  std::ranges::copy_if(points, std::back_inserter(foremost), [&](const Point& p) {
    return std::ranges::none_of(points, [&](const Point& other) { return is_behind(p, other); });
  });
  return foremost;
}

void RequireApart(const Body& a, const Body& b, const Clearance& clearance,
                  Preconditions& conditions) {
  const double turned = a.turned() + b.turned();
  const Vector3 displacement = clearance.displacement + clearance.slack;
  WidestGap widest(a, b, displacement, turned);
  if (widest.TrySides() || widest.TryEdges()) return;
  const Vector3& best = widest.direction();
  const double slack = clearance.slack.dot(best.cwiseAbs());
  const double reach = displacement.dot(best.cwiseAbs()) + turned;
  for (const Body::Point& p : a.Foremost(best)) {
    for (const Body::Point& q : b.Foremost(-best)) {
      if (best.dot(q.planned - p.planned) > reach) continue;
      conditions.Less(clearance.statement.condition, clearance.statement.meaning,
                      Along(best, a.Possible(p)) - Along(best, b.Possible(q)), 0 - slack,
                      clearance.neighbour);
    }
  }
}

}  // namespace assay::uncertainty
