#include "planner/uncertainty/pads/roll_of_part.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "planner/domain/parts/part_model.h"
#include "planner/geometry/polygon.h"
#include "planner/geometry/solids/mass_properties.h"
#include "planner/uncertainty/error_sets/axis_angle.h"
#include "planner/uncertainty/error_sets/possible_masses.h"
#include "planner/uncertainty/pads/contact_patch.h"
#include "planner/uncertainty/pads/grip.h"
#include "planner/uncertainty/standing/support.h"

namespace assay::uncertainty {
namespace {

using geometry::Polygon;

constexpr double kWithoutEnd = std::numeric_limits<double>::infinity();
constexpr double kSameEnd = 1e-9;  // metres
constexpr double kUpright = 1e-9;  // sine of the angle between two directions
constexpr double kRounding = 1 + 1e-9;

// What a pad touches of a part whose faces lie flat on the pads. x is horizontal along the pads, y
// points up as far as the pads do.
class TouchedRegion {
 public:
  TouchedRegion(const geometry::Patches& in_tool, const Vector3& up) {
    const Vector3 level = up.cross(Vector3::UnitY());
    std::vector<Vector2> corners;
    for (const Polygon& patch : in_tool) {
      for (const Vector2& p : patch) {
        const Vector3 at(p.x(), 0, p.y());
        corners.emplace_back(level.dot(at), up.dot(at));
      }
    }
    corners_ = geometry::Hull2(corners);
  }

  bool IsEmpty() const { return corners_.size() < 3; }

  // Returns how far this region reaches along x (side 1) or against it (side -1), in metres.
  double Reach(double side) const {
    double reach = -kWithoutEnd;
    for (const Vector2& p : corners_) reach = std::max(reach, side * p.x());
    return reach;
  }

  // Returns the heights at which this region ends along x (side 1) or against it (side -1).
  Interval HeightsOfEnd(double side) const {
    const double end = Reach(side);
    Interval heights = {kWithoutEnd, -kWithoutEnd};
    for (const Vector2& p : corners_) {
      if (side * p.x() < end - kSameEnd) continue;
      heights = {std::min(heights.low, p.y()), std::max(heights.high, p.y())};
    }
    return heights;
  }

  // Returns the least extent of this region in any direction, in metres.
  double LeastWidth() const {
    double least = IsEmpty() ? 0 : kWithoutEnd;
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      const Vector2& from = corners_[i];
      const Vector2 along = (corners_[(i + 1) % corners_.size()] - from).normalized();
      double extent = 0;
      for (const Vector2& p : corners_) {
        extent =
            std::max(extent, std::abs(along.x() * (p - from).y() - along.y() * (p - from).x()));
      }
      least = std::min(least, extent);
    }
    return least;
  }

  // Returns the tangent of the angle between x and the normal of the edge that follows this end
  // upwards (1) or downwards (-1).
  double SlopeAfterEnd(double side, double upwards) const {
    double slope = kWithoutEnd;
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      const Vector2 along = (corners_[(i + 1) % corners_.size()] - corners_[i]).normalized();
      const Vector2 normal(side * along.y(), -upwards * along.x());
      if (normal.x() > 0 && normal.y() > kUpright) slope = std::min(slope, normal.y() / normal.x());
    }
    return slope;
  }

 private:
  Polygon corners_;
};

// Two pads on a part that is turned: the first one touches its region at the end along x, the
// second one at the other end. Errors move each end by up to `off`, in metres.
struct TurningPads {
  const TouchedRegion& first;
  const TouchedRegion& second;
  double off = 0;

  // Returns the tilt of the part about x, for each radian of its turn, after which pads touch it
  // along edges. Pads that may press at equal heights do not tilt the part.
  double TiltPerTurn() const {
    const Interval ahead = first.HeightsOfEnd(1);
    const Interval behind = second.HeightsOfEnd(-1);
    double tilt = 0;
    if (ahead.low + off >= behind.high - off) {
      tilt = std::max({tilt, first.SlopeAfterEnd(1, -1), second.SlopeAfterEnd(-1, 1)});
    }
    if (behind.low + off >= ahead.high - off) {
      tilt = std::max({tilt, first.SlopeAfterEnd(1, 1), second.SlopeAfterEnd(-1, -1)});
    }
    return tilt;
  }

  // Returns the greatest couple of the pads' forces about x, in newton metres, for each newton
  // metre of the moment with which the pads turn the part. `friction_angle` is the greatest angle
  // between the force of a sliding pad and its normal.
  double CouplePerMoment(double width, double friction_angle) const {
    const Interval ahead = first.HeightsOfEnd(1);
    const Interval behind = second.HeightsOfEnd(-1);
    const double heights = std::max(ahead.high - behind.low, behind.high - ahead.low) + 2 * off;
    const double lever =
        first.Reach(1) + second.Reach(-1) - 2 * off - width * std::tan(friction_angle);
    return friction_angle < kRightAngle && lever > 0 ? heights / lever : kWithoutEnd;
  }
};

// How the pads hold a part, in a frame about the middle of the pads: x is horizontal along the
// pads, y is the closing direction.
struct Grasp {
  Eigen::AlignedBox2d held;  // where the pads may touch the part
  double width = 0;          // distance of the two pads from each other, metres
  double apart = 0;          // least distance of their contacts from each other along them, metres
};

// The support of a part and what the pads hold of it, seen from the part's centre of mass: x is
// horizontal along the pads, y is the closing direction.
class SupportBetweenPads {
 public:
  // `center` is the centre of mass, and `middle` the middle of the pads, in the support's axes.
  SupportBetweenPads(const Polygon& support, const Vector2& center, const Vector2& closing,
                     const Grasp& grasp, const Vector2& middle)
      : grasp_(grasp) {
    const Vector2 along(closing.y(), -closing.x());
    const auto from_center = [&](const Vector2& p) -> Vector2 {
      return {along.dot(p - center), closing.dot(p - center)};
    };
    for (const Vector2& p : support) {
      corners_.push_back(from_center(p));
      reach_.extend(corners_.back());
    }
    grasp_.held.translate(from_center(middle));
  }

  // Returns the roll for each radian of the tilt. The couples of the pads move the pressure by up
  // to `way` metres along y, at an angle of up to `friction_angle` against y, until the part tips.
  // `turned` is the greatest angle between this frame and the true directions, in radians.
  double RollPerTilt(double friction_angle, double way, double turned) const {
    Region region = {friction_angle + turned, way};
    if (SteepestEdge(region, turned) < 0) return 0;
    region.way = kWithoutEnd;
    const double by_weight = SteepestEdge(region, turned);
    region.x = {std::min(0.0, grasp_.held.min().x()), std::max(0.0, grasp_.held.max().x())};
    region.y = std::max(-grasp_.held.min().y(), grasp_.held.max().y());
    const double by_grasp = std::max(SteepestEdge(region, turned), RollAboutGrasp(turned));
    return std::max(by_weight, std::min(by_grasp, RollByGripsWork()));
  }

 private:
  // Where the pressure of the support may arrive: within a double cone about y with this half
  // angle, up to `way` from its tip. The tip is anywhere in this interval of x, at most y from 0.
  struct Region {
    double angle = 0;
    double way = 0;
    Interval x = {0, 0};
    double y = 0;

    bool Contains(const Vector2& p) const {
      const double beside = std::max({0.0, x.low - p.x(), p.x() - x.high});
      return std::abs(p.y()) <= way * kRounding &&
             beside <= std::tan(angle) * (std::abs(p.y()) + y) * kRounding;
    }
    // The distance from the cone is linear between the points where the edge crosses the end of an
    // interval or the axis x.
    bool Meets(const Vector2& a, const Vector2& b) const {
      if (!(angle < kRightAngle)) return true;
      std::vector<Vector2> points = {a, b};
      const auto add_crossing = [&](double from, double to, double at) {
        const double share = (at - from) / (to - from);
        if (share > 0 && share < 1) points.push_back(a + share * (b - a));
      };
      for (const double at : {x.low, x.high}) add_crossing(a.x(), b.x(), at);
      for (const double at : {0.0, way, -way}) add_crossing(a.y(), b.y(), at);
      return std::ranges::any_of(points, [&](const Vector2& p) { return Contains(p); });
    }
  };

  // Returns how far the part rolls, for each radian of the tilt, if points that are `apart` from
  // each other stay at their heights.
  static double RollAlong(const Vector2& apart, double turned) {
    const double angle = std::atan2(std::abs(apart.y()), std::abs(apart.x())) + turned;
    return angle < kRightAngle ? std::tan(angle) : kWithoutEnd;
  }

  // Returns the roll per tilt about the steepest edge of the support that meets the region; -1 if
  // there is none.
  double SteepestEdge(const Region& region, double turned) const {
    double steepest = -1;
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      const Vector2& a = corners_[i];
      const Vector2& b = corners_[(i + 1) % corners_.size()];
      if (region.Meets(a, b)) steepest = std::max(steepest, RollAlong(b - a, turned));
    }
    return steepest;
  }

  // Returns the roll per tilt if the pads hold points of the part beside its support at the height
  // where they are, so that the part rolls about these points and a corner of the support.
  double RollAboutGrasp(double turned) const {
    const double sticks_out = std::max(grasp_.held.max().x() - reach_.max().x(),
                                       reach_.min().x() - grasp_.held.min().x());
    if (sticks_out <= kSameEnd) return 0;
    const double x =
        grasp_.held.max().x() < reach_.min().x() ? grasp_.held.max().x() : grasp_.held.min().x();
    if (reach_.min().x() <= x && x <= reach_.max().x()) return kWithoutEnd;
    double roll = 0;
    for (const Vector2& corner : corners_) {
      roll = std::max(roll, RollAlong({corner.x() - x, FarthestAlongY(corner)}, turned));
    }
    return roll;
  }

  // Returns the greatest roll per tilt that the friction of the pads may cause. The part moves so
  // that its contacts slide no farther than necessary. If it does not roll, the tilt moves the
  // contacts of both pads along these, up and down by half of their distance, and lifts the middle
  // between them by the height of the corner on which the part stands. A roll moves them across
  // this direction, by no more than the greater of these two ways.
  double RollByGripsWork() const {
    double way = grasp_.width;
    for (const Vector2& corner : corners_) {
      way = std::max(way, 2 * std::abs(corner.y() - grasp_.held.center().y()));
    }
    return way / grasp_.apart;
  }

  double FarthestAlongY(const Vector2& corner) const {
    return std::max(std::abs(corner.y() - grasp_.held.min().y()),
                    std::abs(corner.y() - grasp_.held.max().y()));
  }

  Polygon corners_;
  Eigen::AlignedBox2d reach_;
  Grasp grasp_;
};

// The pads and the support of a part that is turned until its faces lie flat on the pads.
class TurnBetweenPads {
 public:
  TurnBetweenPads(const UncertainWorld& world, PartId part, const plan::Hold& hold,
                  const TurnedPart& turned)
      : problem_(world.problem()),
        part_(part),
        hold_(hold),
        turned_(turned),
        X_WorldPart_(world.X_WorldPart(part)),
        X_WorldTool_(X_WorldPart_ * hold.X_PartTool),
        up_(VerticalInTool(X_WorldTool_)),
        standings_(StandingsOf(world, part, X_WorldPart_)),
        friction_(PossiblePadFriction(problem_)),
        left_(TouchedPatch(Model(), hold, 1, Pad()), up_),
        right_(TouchedPatch(Model(), hold, -1, Pad()), up_) {}

  // Returns the greatest roll, in radians: while the part turns, and when its faces are flat except
  // for the lean of the hand.
  double AngleOfRoll() const {
    if (left_.IsEmpty() || right_.IsEmpty() || up_.y() != 0) return ByWork(turned_.turn);
    const double lean = SwingOf(turned_.hand_turn, up_.z());
    const double tilt = lean + turned_.turn * TiltPerTurn();
    return RollWith(WayOfPressure(), MiddleOfContacts(), tilt, turned_.turn) +
           RollWith(kWithoutEnd, Grasped(), lean, lean);
  }

  // Returns the greatest distance of a contact from the axis through the middle of the pads.
  double ArmOfRoll() const { return FarthestFrom(X_WorldTool_.linear().col(1)); }

 private:
  const domain::PartModel& Model() const { return *problem_.part(part_).model; }
  const Vector2& Pad() const { return problem_.workcell->gripper().pad_half_extents(); }

  double ByWork(double turn) const { return turn == 0 ? 0 : turn / friction_.low; }

  // Returns the greatest roll while the pads turn the part by up to `turn` and tilt it by up to
  // `tilt` radians. They hold it within `held`, and move the pressure of the support by up to
  // `way` metres.
  double RollWith(double way, const Eigen::AlignedBox2d& held, double tilt, double turn) const {
    const double per_tilt = RollPerTilt(way, held);
    if (per_tilt == 0) return 0;
    return per_tilt < kWithoutEnd ? std::min(per_tilt * tilt, ByWork(turn)) : ByWork(turn);
  }

  double TiltPerTurn() const {
    return std::max(TurningPads{left_, right_, turned_.off}.TiltPerTurn(),
                    TurningPads{right_, left_, turned_.off}.TiltPerTurn());
  }

  // Returns how far the pads move the pressure of the support along the closing direction, in
  // metres. The friction of the support resists the turn. The pads press until they overcome it and
  // their own friction, and no harder.
  double WayOfPressure() const {
    const double angle = std::atan(friction_.high) + turned_.turn;
    const double couple =
        std::max(TurningPads{left_, right_, turned_.off}.CouplePerMoment(hold_.width, angle),
                 TurningPads{right_, left_, turned_.off}.CouplePerMoment(hold_.width, angle));
    const double friction = Model().friction() + problem_.tolerances.friction;
    return couple * friction * (FarthestFrom(Vector3::UnitZ()) + Pad().norm() + turned_.off);
  }

  double RollPerTilt(double way, const Eigen::AlignedBox2d& held) const {
    const Polygon support = SupportOf(standings_);
    if (support.size() < 3) return kWithoutEnd;
    const Vector2 surely = (Pad() - Vector2::Constant(turned_.off)).cwiseMax(0);
    const TouchedRegion opposite(OppositePatch(Model(), hold_, surely), up_);
    const Grasp grasp = {.held = held, .width = hold_.width, .apart = opposite.LeastWidth()};
    double roll = 0;
    for (const geometry::MassProperties& mass : PossibleMasses(problem_, part_)) {
      const SupportBetweenPads between(support, (X_WorldPart_ * mass.center).head<2>(),
                                       X_WorldTool_.linear().col(1).head<2>(), grasp,
                                       X_WorldTool_.translation().head<2>());
      roll = std::max(roll, between.RollPerTilt(std::atan(friction_.high), way, turned_.turn));
    }
    return roll;
  }

  // Returns the places midway between the two contacts while the pads turn the part: one is at the
  // end of the first pad's region, the other at the opposite end of the second pad's region. x is
  // horizontal along the pads, y is the closing direction.
  Eigen::AlignedBox2d MiddleOfContacts() const {
    Eigen::AlignedBox2d middle;
    for (const double x : {left_.Reach(1) - right_.Reach(-1), right_.Reach(1) - left_.Reach(-1)}) {
      middle.extend(Vector2(x / 2 - turned_.off, 0));
      middle.extend(Vector2(x / 2 + turned_.off, 0));
    }
    return middle;
  }

  // Returns what the pads may touch of the part: x is horizontal along the pads, y is the closing
  // direction.
  Eigen::AlignedBox2d Grasped() const {
    const Vector2 pad = Pad() + Vector2::Constant(turned_.off);
    Eigen::AlignedBox2d grasped;
    for (const double side : {-1.0, 1.0}) {
      const TouchedRegion region(TouchedPatch(Model(), hold_, side, pad), up_);
      grasped.extend(Vector2(-region.Reach(-1), side * hold_.width / 2));
      grasped.extend(Vector2(region.Reach(1), side * hold_.width / 2));
    }
    return grasped;
  }

  // Returns the greatest distance of a contact from the line through the middle of the pads along a
  // unit vector.
  double FarthestFrom(const Vector3& along) const {
    double farthest = 0;
    for (const Standing& standing : standings_) {
      for (const Vector3& p : standing.at) {
        farthest = std::max(farthest, (p - X_WorldTool_.translation()).cross(along).norm());
      }
    }
    return farthest;
  }

  const domain::Problem& problem_;
  PartId part_;
  const plan::Hold& hold_;
  TurnedPart turned_;
  Pose X_WorldPart_;
  Pose X_WorldTool_;
  Vector3 up_;  // the vertical, in the tool's axes
  std::vector<Standing> standings_;
  Interval friction_;  // of the pads
  TouchedRegion left_;
  TouchedRegion right_;
};

}  // namespace

Roll RollOfPart(const UncertainWorld& world, PartId part, const plan::Hold& hold,
                const TurnedPart& turned) {
  if (turned.turn == 0) return {};
  const TurnBetweenPads turning(world, part, hold, turned);
  const double angle = std::min(turning.AngleOfRoll(), std::numbers::pi);
  return {angle, angle * (turning.ArmOfRoll() + turned.off)};
}

}  // namespace assay::uncertainty
