#include "planner/domain/grasps/grasp.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "planner/base/check.h"
#include "planner/domain/grasps/face_pair.h"
#include "planner/domain/grasps/hand_clearance.h"
#include "planner/domain/grasps/pad_region.h"
#include "planner/domain/grasps/round_grasps.h"
#include "planner/domain/grasps/round_side.h"
#include "planner/domain/grasps/shaft_end.h"
#include "planner/domain/parts/exposed_faces.h"
#include "planner/geometry/planar_region.h"
#include "planner/geometry/polygon.h"
#include "planner/geometry/pose.h"
#include "planner/geometry/solids/mass_properties.h"

namespace assay::domain {
namespace {

using geometry::Patches;
using geometry::Polygon;

constexpr double kAllowance = 1e-4;  // overlap of hand and part that is ignored, metres
// Overlap of hand and part that is ignored if the pads stick out of their faces, in metres. It is
// this small so that no pad reaches into another face.
constexpr double kNarrowAllowance = 1e-6;
constexpr double kEqual = kEqualLength;
constexpr double kFlush = -2 * kEqual;  // pads that stick out by less are on the faces, metres
// The least breadth of the patch that both pads touch, in metres, and its least extent across the
// approach, as a share of the width of the grasp. Narrower patches hold nothing, since pads jam on
// them however little the part is turned.
constexpr double kLeastPatch = 1e-3;
constexpr double kLeastShare = 0.1;
// An edge is ahead if the cosine between its outward normal and the approach is at least this. The
// hand leans too much for a table at other edges.
constexpr double kAhead = 0.45;

// A hand comes from behind a shaft if the cosine between the approach and the direction to the tip
// is at least this. A hand that mates the shaft straight down comes so.
constexpr double kFromBehind = 0.7;

Polygon PadAt(const Vector2& center, const Approach& approach, const Vector2& half_extents) {
  const Vector2 x = half_extents.x() * approach.x;
  const Vector2 z = half_extents.y() * approach.z;
  // The tool's y points at the viewer, so z to x turns counter-clockwise.
  return {center - x - z, center - x + z, center + x + z, center + x - z};
}

// Returns whether the margin around pads at a spot cannot exceed `margin` however they are turned,
// since the circle in the middle of a pad has no greater margin.
bool IsNarrowerAt(const Spot& spot, const Vector2& pads, double margin) {
  return spot.clearance - pads.minCoeff() <= margin;
}

// A pair of faces, and where pads can be on it.
struct PadPlaces {
  PadPlaces(const PartModel& part, FacePair faces)
      : pair(std::move(faces)),
        room(pair.region),
        mass_center((pair.X_PartMiddle.inverse() * part.mass().center).head<2>()),
        spots(SpotsOf(pair.region, room, mass_center, mass_center)) {}

  FacePair pair;
  PadRegion room;
  Vector2 mass_center;  // of the part, in the middle plane
  std::vector<Spot> spots;
};

// Returns the directions in which no pad has room on the faces.
std::vector<double> CrampedAngles(const PadPlaces& places, const Vector2& pads,
                                  std::vector<double> angles) {
  std::erase_if(angles, [&](double angle) {
    const Approach approach = Approach::At(angle, 0);
    return std::ranges::any_of(places.spots, [&](const Spot& spot) {
      return !IsNarrowerAt(spot, pads, kFlush) &&
             places.room.MarginOf(PadAt(spot.center, approach, pads), kFlush) > kFlush;
    });
  });
  return angles;
}

// The search for all grasps of one pair of faces.
class PairSearch {
 public:
  // `round` is the round side that narrow faces belong to. Overlaps of hand and part up to
  // `allowance` metres are ignored. The part and the places must outlive the search.
  PairSearch(const PartModel& part, const kinematics::Gripper& gripper, const PadPlaces& places,
             const std::optional<RoundSide>& round, double allowance)
      : part_(part),
        pads_(gripper.pad_half_extents()),
        pair_(places.pair),
        is_round_(round.has_value()),
        room_(places.room),
        clearance_(part, gripper, pair_.X_PartMiddle, pair_.width, allowance),
        spots_(places.spots) {
    if (!is_round_) return;
    const Vector2 middle = geometry::Centroid(pair_.region);
    axis_ = (pair_.X_PartMiddle.inverse().linear() * round->X_PartAxis.linear().col(2)).head<2>();
    const Vector2 nearest = middle + axis_.dot(places.mass_center - middle) * axis_;
    spots_ = SpotsOf(pair_.region, room_, nearest, places.mass_center);
    std::erase_if(spots_, [&](const Spot& spot) {
      const Vector2 off = spot.center - middle;
      return std::abs(off.x() * axis_.y() - off.y() * axis_.x()) > kRounding;
    });
  }

  // Returns the directions of the approach. For a round side, they are the two directions along its
  // axis and the two directions across its axis. For flat faces, they are all directions in `all`.
  std::vector<double> Angles(std::vector<double> all) const {
    if (!is_round_) return all;
    const double along = std::atan2(axis_.y(), axis_.x());
    all.clear();
    for (const int quarter : {0, 1, 2, 3}) all.push_back(along + quarter * std::numbers::pi / 2);
    return all;
  }

  // Returns the grasp that represents its class, with pads wholly on the faces. If `with_misfits`
  // is set, the pads may stick out of the faces. Returns none if the pads have no room, or if the
  // hand cannot approach.
  std::optional<Grasp> OnFaces(double angle, bool with_misfits) const {
    const Approach approach = Approach::At(angle, ExtentAlong(angle).length());
    const std::optional<Vector2> center = DeepestCenter(approach, with_misfits);
    if (!center) return std::nullopt;
    Grasp grasp = GraspAt(*center, approach);
    const Polygon pad = PadAt(*center, approach, pads_);
    const double margin = room_.MarginOf(pad);
    if (margin <= -kEqual) grasp.room = room_.Lacking(pad, -margin);
    return grasp;
  }

  // Returns the grasp that stands for its class on faces that are too narrow for the pads; none if
  // the pads touch too little, or if there is no way in.
  std::optional<Grasp> OnNarrowFaces(double angle) const {
    const Approach approach = Approach::At(angle, ExtentAlong(angle).length());
    const std::optional<Vector2> center = WidestTouch(approach);
    return center ? std::optional(GraspAt(*center, approach)) : std::nullopt;
  }

  // Returns the grasps that leave more of a shaft free than this grasp at the same angle does:
  // those that come from behind a shaft with its faces, and hold it as far from its tip as they
  // can.
  std::vector<Grasp> FartherFromTips(double angle, const Grasp& grasp) const {
    const Approach approach = Approach::At(angle, ExtentAlong(angle).length());
    const std::vector<CObstacle> obstacles = clearance_.ObstaclesOf(approach);
    const Vector2 center =
        (pair_.X_PartMiddle.inverse() * grasp.X_PartTool.translation()).head<2>();
    const Polygon pad = PadAt(center, approach, pads_);
    const double touched = geometry::Area(geometry::Common(pair_.region, {pad}));
    std::vector<Grasp> farther;
    for (const Vector2& away : AwayFromTips(part_, pair_)) {
      if (away.dot(approach.z) > -kFromBehind) continue;
      const std::optional<Vector2> end = TowardsEnd(room_.outline(), pad, center, away);
      if (!end || IsBlocked(obstacles, *end)) continue;
      const Polygon there = PadAt(*end, approach, pads_);
      const double area = geometry::Area(geometry::Common(pair_.region, {there}));
      if (area < touched - kEqual * pads_.norm() || geometry::Meets(pair_.walls, there)) continue;
      farther.push_back(GraspAt(*end, approach));
    }
    return farther;
  }

 private:
  struct Extent {
    double low = 0;
    double high = 0;
    double length() const { return high - low; }
  };
  // An edge of the faces that looks ahead in the approach direction, and how far the pads may reach
  // in the direction of the edge's outward normal.
  struct EdgeAhead {
    Vector2 outward;
    double ahead = 0;        // outward . approach.z
    double limit = 0;        // greatest outward . p of a point p that pads may reach
    double half_extent = 0;  // of the pads along their x, seen along `outward`
  };

  Grasp GraspAt(const Vector2& center, const Approach& approach) const {
    Grasp grasp;
    grasp.X_PartTool = pair_.X_PartMiddle * ToolInMiddle(center, approach);
    grasp.width = pair_.width;
    grasp.hidden = HiddenBy(PadAt(center, approach, pads_));
    return grasp;
  }

  // Returns the margin around the pads (PadRegion::MarginOf).
  double MarginAt(const Spot& spot, const Approach& approach, double floor) const {
    if (spot.clearance >= pads_.norm() + kDeepEnough) return kDeepEnough;
    return room_.MarginOf(PadAt(spot.center, approach, pads_), floor);
  }

  // The spots nearest to the centre of mass come first, so a later spot must lie deeper to replace
  // an earlier one.
  std::optional<Vector2> DeepestCenter(const Approach& approach, bool with_misfits) const {
    const std::vector<CObstacle> obstacles = clearance_.ObstaclesOf(approach);
    const Spot* best = nullptr;
    double best_margin = with_misfits ? std::numeric_limits<double>::lowest() : kFlush;
    for (const Spot& spot : spots_) {
      if (best_margin >= kDeepEnough - kEqual) break;
      if (best_margin >= kFlush && IsNarrowerAt(spot, pads_, best_margin)) continue;
      if (IsBlocked(obstacles, spot.center)) continue;
      const double margin = MarginAt(spot, approach, best_margin + kEqual);
      if (margin <= best_margin + kEqual) continue;
      best = &spot;
      best_margin = margin;
    }
    return best == nullptr ? std::nullopt : std::optional(best->center);
  }

  // As above, with the area that the pads touch instead of their depth.
  std::optional<Vector2> WidestTouch(const Approach& approach) const {
    const std::vector<CObstacle> obstacles = clearance_.ObstaclesOf(approach);
    const std::vector<EdgeAhead> edges = EdgesAhead(approach);
    const double enough = MostTouched(approach) - kEqual * pads_.norm() / 2;
    std::optional<Vector2> best;
    double best_area = 0;
    for (const Spot& spot : spots_) {
      if (best_area >= enough) break;
      const Vector2 center = HeldBack(spot.center, approach, edges);
      if (IsBlocked(obstacles, center)) continue;
      const Polygon pad = PadAt(center, approach, pads_);
      const Patches touched = geometry::Common(pair_.region, {pad});
      const double area = geometry::Area(touched);
      if (area <= best_area + kEqual * pads_.norm()) continue;
      if (!Suffices(touched, approach) || geometry::Meets(pair_.walls, pad)) continue;
      best = center;
      best_area = area;
    }
    return best;
  }

  bool Suffices(const Patches& touched, const Approach& approach) const {
    const Polygon outline = geometry::Hull(touched);
    if (is_round_) return ExtentOf(outline, axis_) >= kLeastPatch;
    return BreadthOf(outline) >= kLeastPatch &&
           ExtentOf(outline, approach.x) >= kLeastShare * pair_.width;
  }

  // Returns an area that pads in this direction cannot exceed wherever they are, up to rounding:
  // the faces are in a strip as broad as they are across each of their edges, and pads touch most
  // of a strip in its middle.
  double MostTouched(const Approach& approach) const {
    const Polygon& outline = room_.outline();
    const Polygon pad = PadAt(Vector2::Zero(), approach, pads_);
    double most = geometry::Area(pad);
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Vector2 edge = (outline[(i + 1) % outline.size()] - outline[i]).normalized();
      const Vector2 along = 2 * pads_.norm() * edge;
      const Vector2 across =
          ExtentOf(outline, {-edge.y(), edge.x()}) / 2 * Vector2(-edge.y(), edge.x());
      const Polygon strip = {-along - across, along - across, along + across, across - along};
      most = std::min(most, geometry::Area(geometry::Intersection(pad, strip)));
    }
    return most;
  }

  // Returns the edges of the faces that look ahead in the approach direction. Measured along an
  // edge's outward normal from the middle of the faces, the pads may reach half as far as the part.
  std::vector<EdgeAhead> EdgesAhead(const Approach& approach) const {
    const Polygon& outline = room_.outline();
    std::vector<EdgeAhead> edges;
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Vector2 edge = outline[(i + 1) % outline.size()] - outline[i];
      const Vector2 outward = Vector2(edge.y(), -edge.x()).normalized();
      const double ahead = outward.dot(approach.z);
      if (ahead < kAhead) continue;
      const double middle = outward.dot(outline[i]) - ExtentOf(outline, outward) / 2;
      const double end = ExtentAlong(std::atan2(outward.y(), outward.x())).high;
      edges.push_back({.outward = outward,
                       .ahead = ahead,
                       .limit = (middle + end) / 2,
                       .half_extent = pads_.x() * std::abs(outward.dot(approach.x))});
    }
    return edges;
  }

  // Returns the center, moved back against the approach, so that the pads end before the part does.
  // If the part stands with one of these edges on a table, the pads then do not reach the table.
  Vector2 HeldBack(const Vector2& center, const Approach& approach,
                   const std::vector<EdgeAhead>& edges) const {
    double back = 0;
    for (const EdgeAhead& edge : edges) {
      const double reach = edge.outward.dot(center) + edge.half_extent + pads_.y() * edge.ahead;
      back = std::max(back, (reach - edge.limit) / edge.ahead);
    }
    return center - back * approach.z;
  }

  static bool IsBlocked(const std::vector<CObstacle>& obstacles, const Vector2& center) {
    return std::ranges::any_of(obstacles, [&](const CObstacle& o) { return o.Contains(center); });
  }

  static Pose ToolInMiddle(const Vector2& center, const Approach& approach) {
    const auto lift = [](const Vector2& v) { return Vector3(v.x(), v.y(), 0); };
    return geometry::PoseFromColumns(lift(approach.x), Vector3::UnitZ(), lift(approach.z),
                                     lift(center));
  }

  // Returns where the part is along the approach direction, from the origin of the middle plane.
  Extent ExtentAlong(double angle) const {
    const Vector3 along =
        pair_.X_PartMiddle.linear() * Vector3(std::cos(angle), std::sin(angle), 0);
    const auto height = [&](const Vector3& p) {
      return along.dot(p - pair_.X_PartMiddle.translation());
    };
    const auto [low, high] = std::ranges::minmax(part_.corners(), {}, height);
    return {height(low), height(high)};
  }

  std::vector<FeatureNumber> HiddenBy(const Polygon& pad) const {
    std::vector<Vector3> corners;
    for (const Vector2& p : pad) corners.push_back(pair_.X_PartMiddle * Vector3(p.x(), p.y(), 0));
    std::vector<FeatureNumber> hidden;
    for (FaceId face : {pair_.first, pair_.second}) {
      const Polygon on_face = OnFace(part_.faces()[face.index()], corners);
      for (FeatureNumber number : part_.FeaturesUnder(face, on_face)) hidden.push_back(number);
    }
    std::ranges::sort(hidden);
    hidden.erase(std::unique(hidden.begin(), hidden.end()), hidden.end());
    return hidden;
  }

  const PartModel& part_;
  Vector2 pads_;  // half extents along the tool's x and z
  const FacePair& pair_;
  bool is_round_;
  Vector2 axis_ = Vector2::Zero();  // of the round side, in the middle plane
  const PadRegion& room_;
  HandClearance clearance_;
  std::vector<Spot> spots_;
};

std::vector<double> AnglesBy(double step) {
  const int count = static_cast<int>(std::ceil(2 * std::numbers::pi / step - kRounding));
  std::vector<double> angles;
  for (int i = 0; i < count; ++i) angles.push_back(i * step);
  return angles;
}

}  // namespace

// The features that a grasp hides depend on its two faces, and on where the pads stick out of them.
// Each pair of faces with one approach direction counts as one class of grasps.
std::vector<Grasp> ComputeGrasps(const PartModel& part, const kinematics::Gripper& gripper,
                                 const GraspSearch& search) {
  ASSAY_CHECK(search.approach_step > kRounding);
  const std::vector<double> angles = AnglesBy(search.approach_step);
  std::vector<Grasp> grasps;
  std::vector<Grasp> farther_from_tips;
  const auto add = [&](const PairSearch& pair, double angle, std::optional<Grasp> grasp) {
    if (!grasp) return;
    if (grasp->room.fits())
      std::ranges::move(pair.FartherFromTips(angle, *grasp), std::back_inserter(farther_from_tips));
    grasps.push_back(*std::move(grasp));
  };
  std::vector<std::pair<PadPlaces, std::vector<double>>> narrow;
  for (FacePair& pair : PairsOf(part, search.widest)) {
    PadPlaces places(part, std::move(pair));
    std::vector<double> cramped = CrampedAngles(places, gripper.pad_half_extents(), angles);
    if (cramped.size() < angles.size()) {
      const PairSearch on_faces(part, gripper, places, std::nullopt, kAllowance);
      for (const double angle : angles) {
        if (!std::ranges::binary_search(cramped, angle))
          add(on_faces, angle, on_faces.OnFaces(angle, search.with_misfits));
      }
    }
    if (!cramped.empty()) narrow.emplace_back(std::move(places), std::move(cramped));
  }
  RoundGrasps round_grasps(search.approach_step);
  for (const auto& [places, cramped] : narrow) {
    const FacePair& pair = places.pair;
    const std::optional<RoundSide> round =
        cramped.size() == angles.size() ? RoundSideOf(part, pair) : std::nullopt;
    if (round && !round_grasps.Add(*round, pair.X_PartMiddle.linear().col(2))) continue;
    const PairSearch on_faces(part, gripper, places, round, kNarrowAllowance);
    for (const double angle : on_faces.Angles(cramped)) {
      std::optional<Grasp> grasp = on_faces.OnNarrowFaces(angle);
      if (!grasp && search.with_misfits) grasp = on_faces.OnFaces(angle, true);
      add(on_faces, angle, std::move(grasp));
    }
  }
  std::ranges::move(farther_from_tips, std::back_inserter(grasps));
  for (std::size_t i = 0; i < grasps.size(); ++i)
    grasps[i].label = fmt::format("{}G{}", part.initial(), i + 1);
  return grasps;
}

}  // namespace assay::domain
