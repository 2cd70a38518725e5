#include "planner/uncertainty/clearance.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/algebra/simplify.h"
#include "planner/base/interval.h"
#include "planner/domain/part_model.h"

namespace assay::uncertainty {
namespace {

constexpr double kParallelEdges = 1e-6;  // sine of the angle between edges
constexpr double kAhead = 1e-12;         // metres: less is rounding

Expression Along(const Vector3& direction, const SymbolicVector& p) {
  return direction.x() * p[0] + direction.y() * p[1] + direction.z() * p[2];
}

// From where to where the body reaches along a direction, in the plan.
Interval ReachAlong(const Vector3& direction, const Body& body) {
  Interval reach = {std::numeric_limits<double>::infinity(),
                    -std::numeric_limits<double>::infinity()};
  for (const Body::Point& p : body.points()) {
    const double along = direction.dot(p.planned);
    reach = {std::min(reach.low, along), std::max(reach.high, along)};
  }
  return reach;
}

bool IsNone(const BeliefShift& shift) {
  return shift.turn.IsConstant(0) &&
         std::ranges::all_of(shift.displacement, [](const auto& d) { return d.IsConstant(0); });
}

PossibleFrame FrameOf(const UncertainWorld& world, const Pose& planned, const RestingError& error) {
  return {planned, PossiblePose(planned, error), Magnitude(world.RangeOf(error.theta))};
}

// The plane that leaves the widest gap between two bodies beyond what displacements may take.
class WidestGap {
 public:
  WidestGap(const Body& from, const Body& to, const Vector3& displacement)
      : from_(from), to_(to), displacement_(displacement) {}

  void TrySides() {
    for (int i = 0; i < 3; ++i) {
      Try(from_.axes().col(i));
      Try(to_.axes().col(i));
    }
  }
  void TryEdges() {
    TryEdges(from_, from_);
    TryEdges(to_, to_);
    TryEdges(from_, to_);
  }

  double gap() const { return gap_; }  // negative if there is none
  const Vector3& direction() const { return direction_; }

 private:
  // Edges of one body make its faces; those of a box are known.
  void TryEdges(const Body& a, const Body& b) {
    if (&a == &b && a.edges().size() == 3) return;
    for (const Vector3& of_a : a.edges()) {
      for (const Vector3& of_b : b.edges()) Try(of_a.cross(of_b));
    }
  }
  void Try(const Vector3& normal) {
    if (normal.norm() < kParallelEdges) return;
    const Vector3 direction = normal.normalized();
    const double displaced = displacement_.dot(direction.cwiseAbs());
    const Interval from = ReachAlong(direction, from_);
    const Interval to = ReachAlong(direction, to_);
    Widen(to.low - from.high - displaced, direction);
    Widen(from.low - to.high - displaced, -direction);
  }
  void Widen(double gap, const Vector3& direction) {
    if (!(gap > gap_)) return;
    gap_ = gap;
    direction_ = direction;
  }

  const Body& from_;
  const Body& to_;
  const Vector3& displacement_;
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
                      const BeliefShift& shift) {
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

Body::Body(const PossibleFrame& frame, const geometry::Box& box, const StraightWay& way)
    : frame_(&frame), way_(way), axes_(frame.planned.linear() * box.X_FrameBox.linear()) {
  for (int i = 0; i < 3; ++i) edges_.push_back(axes_.col(i));
  const bool goes = way.planned.norm() > 0;
  if (goes) edges_.push_back(way.planned.normalized());
  double radius = 0;
  for (const Vector3& corner : box.Corners()) {
    const Vector3 planned = frame.planned * corner;
    points_.push_back({corner, planned, false});
    if (goes) points_.push_back({corner, planned + way.planned, true});
    radius = std::max(radius, corner.norm());
  }
  turned_ = radius * frame.angle + way.doubt;
}

SymbolicVector Body::Possible(const Point& point) const {
  const SymbolicVector p = frame_->possible * AsVector(point.local);
  return point.at_far_end ? p + way_.possible : p;
}

// One that is surely behind another one is not: they are displaced alike, and turned, one against
// the other, by no more than their distance allows.
std::vector<Body::Point> Body::Foremost(const Vector3& direction) const {
  std::vector<Point> foremost;
  std::ranges::copy_if(points_, std::back_inserter(foremost), [&](const Point& p) {
    return std::ranges::none_of(points_, [&](const Point& other) {
      const double apart = (other.local - p.local).norm();
      const double doubt =
          frame_->angle * apart + (other.at_far_end != p.at_far_end ? way_.doubt : 0);
      const double ahead = direction.dot(other.planned - p.planned);
      return ahead > doubt + kAhead;
    });
  });
  return foremost;
}

void RequireApart(const Body& a, const Body& b, const Clearance& clearance,
                  Preconditions& conditions) {
  const double turned = a.turned() + b.turned();
  const Vector3 displacement = clearance.displacement + clearance.slack;
  WidestGap widest(a, b, displacement);
  widest.TrySides();
  if (widest.gap() > turned) return;
  widest.TryEdges();
  if (widest.gap() > turned) return;
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
