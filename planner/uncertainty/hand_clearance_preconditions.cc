#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>

#include "planner/algebra/simplify.h"
#include "planner/base/interval.h"
#include "planner/domain/part_model.h"
#include "planner/geometry/box.h"
#include "planner/uncertainty/precondition.h"

namespace assay::uncertainty {
namespace {

using geometry::Box;

constexpr double kParallelEdges = 1e-6;  // sine of the angle between edges

using Corners = std::array<Vector3, 8>;

// The box, along the frame's axes, about all these.
Box Around(std::initializer_list<Corners> all) {
  Eigen::AlignedBox3d bounds;
  for (const Corners& corners : all) {
    for (const Vector3& corner : corners) bounds.extend(corner);
  }
  return Box::FromCorners(bounds.min(), bounds.max());
}

// Hand and fingers as they come, close or open, and go back along the tool's axis, in the tool's
// frame: boxes, as they go along their own sides.
std::vector<Box> SweptHand(const domain::Workcell& workcell, double width) {
  const kinematics::Gripper& gripper = workcell.gripper();
  const Pose back = geometry::Translation(0, 0, -workcell.rules().approach_distance);
  std::vector<Box> swept;
  for (const Box& box : gripper.HandBoxes()) {
    swept.push_back(Around({box.Corners(), box.Transformed(back).Corners()}));
  }
  const std::vector<Box> open = gripper.FingerBoxes(gripper.max_opening());
  const std::vector<Box> closed = gripper.FingerBoxes(width);
  for (std::size_t i = 0; i < open.size(); ++i) {
    swept.push_back(
        Around({open[i].Corners(), closed[i].Corners(), open[i].Transformed(back).Corners(),
                closed[i].Transformed(back).Corners()}));
  }
  return swept;
}

// From where to where the points reach along a direction.
Interval ReachAlong(const Vector3& direction, const Corners& points) {
  Interval reach = {std::numeric_limits<double>::infinity(),
                    -std::numeric_limits<double>::infinity()};
  for (const Vector3& p : points) {
    const double along = direction.dot(p);
    reach = {std::min(reach.low, along), std::max(reach.high, along)};
  }
  return reach;
}

Corners Moved(const Pose& X, Corners points) {
  for (Vector3& p : points) p = X * p;
  return points;
}

Expression Along(const Vector3& direction, const SymbolicVector& p) {
  return direction.x() * p[0] + direction.y() * p[1] + direction.z() * p[2];
}

// The plane that leaves the widest gap between two boxes, of those along their sides, and along an
// edge of each: one of them separates boxes that are apart.
class WidestGap {
 public:
  WidestGap(const Corners& from, const Corners& to) : from_(from), to_(to) {}

  void TrySides(const geometry::Matrix3& a, const geometry::Matrix3& b) {
    for (int i = 0; i < 3; ++i) {
      Try(a.col(i));
      Try(b.col(i));
    }
  }
  void TryEdges(const geometry::Matrix3& a, const geometry::Matrix3& b) {
    for (int i = 0; i < 9; ++i) Try(a.col(i / 3).cross(b.col(i % 3)));
  }

  double gap() const { return gap_; }  // negative if there is none
  const Vector3& direction() const { return direction_; }

 private:
  void Try(const Vector3& normal) {
    if (normal.norm() < kParallelEdges) return;
    const Vector3 direction = normal.normalized();
    const Interval from = ReachAlong(direction, from_);
    const Interval to = ReachAlong(direction, to_);
    Widen(to.low - from.high, direction);
    Widen(from.low - to.high, -direction);
  }
  void Widen(double gap, const Vector3& direction) {
    if (!(gap > gap_)) return;
    gap_ = gap;
    direction_ = direction;
  }

  const Corners& from_;
  const Corners& to_;
  double gap_ = -std::numeric_limits<double>::infinity();
  Vector3 direction_ = Vector3::UnitZ();
};

// A box that goes with a frame of which the plan has the pose.
struct Body {
  Corners local;   // in the frame
  Corners points;  // where the plan has them
  geometry::Matrix3 axes;
  const Transform* pose;  // of the frame, possible
  double shift = 0;       // metres: how far any of its points may be from the plan's, at most
};

// How a frame may be off.
struct FrameError {
  double displacement = 0;  // metres
  double angle = 0;         // radians

  double Shift(const Corners& local) const {
    double radius = 0;
    for (const Vector3& p : local) radius = std::max(radius, p.norm());
    return displacement + radius * angle;
  }
};

class HandConditions {
 public:
  HandConditions(const UncertainWorld& world, const Pose& X_WorldTool, const BeliefShift& shift,
                 const ManipulatorError& draw, double width)
      : world_(world),
        tool_(algebra::Simplify(
            PossiblePose(X_WorldTool, {.displacement = shift.displacement, .theta = shift.turn}) *
            draw.AsTransform())),
        error_{Length(tool_.translation - AsVector(X_WorldTool.translation())),
               Magnitude(world.RangeOf(shift.turn)) + Magnitude(world.RangeOf(draw.theta))} {
    for (const Box& box : SweptHand(*world.problem().workcell, width)) {
      hand_.push_back(MakeBody(box, X_WorldTool, tool_, error_));
    }
  }

  void RequireClearOf(PartId part) {
    const domain::Part& neighbour = world_.problem().part(part);
    const Pose& X_WorldPart = world_.X_WorldPart(part);
    const RestingError error = world_.about_plan(part);
    const FrameError range = {Length(error.displacement), Magnitude(world_.RangeOf(error.theta))};
    const Transform possible = PossiblePose(X_WorldPart, error);
    for (const Box& box : neighbour.model->boxes()) {
      const Body other = MakeBody(box, X_WorldPart, possible, range);
      for (const Body& piece : hand_) RequireApart(piece, other, part);
    }
  }

  std::vector<Precondition> Take() { return conditions_.Take(); }

 private:
  static Body MakeBody(const Box& box, const Pose& X_World, const Transform& possible,
                       const FrameError& error) {
    const Corners local = box.Corners();
    return {local, Moved(X_World, local), X_World.linear() * box.X_FrameBox.linear(), &possible,
            error.Shift(local)};
  }

  double Length(const SymbolicVector& v) const {
    return Vector3(Magnitude(world_.RangeOf(v[0])), Magnitude(world_.RangeOf(v[1])),
                   Magnitude(world_.RangeOf(v[2])))
        .norm();
  }

  // By the plane that leaves the widest gap in the plan.
  void RequireApart(const Body& hand, const Body& other, PartId neighbour) {
    const double reach = hand.shift + other.shift;
    WidestGap widest(hand.points, other.points);
    widest.TrySides(hand.axes, other.axes);
    if (widest.gap() > reach) return;  // proved: no error is as great
    widest.TryEdges(hand.axes, other.axes);
    if (widest.gap() > reach) return;
    const Vector3& best = widest.direction();
    for (std::size_t i = 0; i < hand.local.size(); ++i) {
      for (std::size_t j = 0; j < other.local.size(); ++j) {
        if (best.dot(other.points[j] - hand.points[i]) > reach) continue;
        conditions_.Less(
            "hand clear",
            fmt::format("the hand stays clear of {}", world_.problem().part(neighbour).name),
            Along(best, *hand.pose * AsVector(hand.local[i])) -
                Along(best, *other.pose * AsVector(other.local[j])),
            0, neighbour);
      }
    }
  }

  const UncertainWorld& world_;
  const Transform tool_;
  const FrameError error_;
  std::vector<Body> hand_;
  Preconditions conditions_;
};

}  // namespace

std::vector<Precondition> HandClearancePreconditions(const UncertainWorld& world,
                                                     const std::vector<PartId>& handled,
                                                     const Pose& X_WorldTool,
                                                     const BeliefShift& shift, double width,
                                                     const ManipulatorError& draw) {
  HandConditions conditions(world, X_WorldTool, shift, draw, width);
  for (int p = 0; p < static_cast<int>(world.problem().parts.size()); ++p) {
    if (std::ranges::find(handled, PartId(p)) == handled.end()) {
      conditions.RequireClearOf(PartId(p));
    }
  }
  return conditions.Take();
}

}  // namespace assay::uncertainty
