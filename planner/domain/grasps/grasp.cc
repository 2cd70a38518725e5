#include "planner/domain/grasps/grasp.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <tuple>

#include "planner/base/check.h"
#include "planner/domain/grasps/hand_clearance.h"
#include "planner/domain/parts/exposed_faces.h"
#include "planner/geometry/planar_region.h"
#include "planner/geometry/polygon.h"
#include "planner/geometry/pose.h"
#include "planner/geometry/solids/mass_properties.h"

namespace assay::domain {
namespace {

using geometry::Polygon;

// Normals count as opposite if they deviate from opposite directions by at most this angle, in
// radians.
constexpr double kOpposite = 0.1 * std::numbers::pi / 180;
constexpr double kGridStep = 4e-3;  // distance between candidate positions, metres
// Margin around the pads beyond which more is no better, metres.
constexpr double kDeepEnough = 4e-3;
constexpr double kAllowance = 1e-4;  // overlap of hand and part that is ignored, metres
constexpr double kEqual = 1e-7;      // lengths that differ less are equal, metres

// Two faces with opposite outward normals.
struct FacePair {
  FaceId first;
  FaceId second;
  double width = 0;   // metres between them
  Pose X_PartMiddle;  // frame midway; z is the outward normal of the first, x and y are its x and y
  geometry::Patches region;  // points that are on both faces, seen along z
};

// Returns the surface of a face that pads may touch. Walls of holes are left out: holes are for
// other parts, so a hand does not reach into them.
geometry::Patches Graspable(const PartModel& part, FaceId id) {
  geometry::Patches patches = part.faces()[id.index()].patches;
  for (const Feature& feature : part.features()) {
    for (const Wall& wall : feature.walls) {
      if (wall.face == id) patches = geometry::Without(patches, wall.outline);
    }
  }
  return patches;
}

std::optional<FacePair> PairUp(std::span<const Face> faces, FaceId a, FaceId b, double widest) {
  const Face& first = faces[a.index()];
  const Face& second = faces[b.index()];
  if ((first.normal + second.normal).norm() >= kOpposite) return std::nullopt;
  const Pose X_FirstSecond = first.X_PartFace.inverse() * second.X_PartFace;
  const double width = -X_FirstSecond.translation().z();
  if (width <= kEqual || width > widest + kEqual) return std::nullopt;
  geometry::Patches seen;
  for (const Polygon& patch : second.patches) {
    std::vector<Vector2> corners;
    for (const Vector2& p : patch) {
      corners.push_back((X_FirstSecond * Vector3(p.x(), p.y(), 0)).head<2>());
    }
    seen.push_back(geometry::Hull2(corners));
  }
  geometry::Patches region = geometry::Common(first.patches, seen);
  if (region.empty()) return std::nullopt;
  const Pose X_PartMiddle = first.X_PartFace * geometry::Translation(0, 0, -width / 2);
  return FacePair{a, b, width, X_PartMiddle, std::move(region)};
}

std::vector<FacePair> PairsOf(const PartModel& part, double widest) {
  std::vector<Face> faces = part.faces();
  for (std::size_t i = 0; i < faces.size(); ++i) faces[i].patches = Graspable(part, FaceId(i));
  std::vector<FacePair> pairs;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    for (std::size_t j = i + 1; j < faces.size(); ++j) {
      std::optional<FacePair> pair = PairUp(faces, FaceId(i), FaceId(j), widest);
      if (pair) pairs.push_back(*std::move(pair));
    }
  }
  return pairs;
}

// A candidate position of the pads' centres on a pair of faces.
struct Spot {
  Vector2 center;        // position in the middle plane
  double from_mass = 0;  // distance to the centre of mass in that plane
  double clearance = 0;  // distance to the border of the region, or less
};

// The region of a pair of faces on which pads can be: a convex outline without convex gaps.
class PadRegion {
 public:
  explicit PadRegion(const geometry::Patches& region)
      : outline_(geometry::Hull(region)), gaps_({outline_}) {
    for (const Polygon& patch : region) gaps_ = geometry::Without(gaps_, patch);
  }

  // Returns a lower bound on a point's distance from the border of the region; negative outside.
  double ClearanceAt(const Vector2& p) const {
    double least = geometry::Depth(outline_, p);
    for (const Polygon& gap : gaps_) least = std::min(least, -geometry::Depth(gap, p));
    return least;
  }

  // Returns a pad's distance from the border of the region; negative if the pad sticks out.
  double MarginOf(const Polygon& pad) const {
    double least = kDeepEnough;
    for (const Vector2& corner : pad) least = std::min(least, geometry::Depth(outline_, corner));
    for (const Polygon& gap : gaps_) {
      if (least < 0) break;
      least = std::min(least, geometry::Gap(pad, gap));
    }
    return least;
  }

  // Returns the room that a pad needs and has across the outline's edge at which most room is
  // missing. The pad sticks out by `overhang`. If the outline has room for the pad, the pad sticks
  // out into a gap.
  PadRoom Lacking(const Polygon& pad, double overhang) const {
    PadRoom least;
    for (std::size_t i = 0; i < outline_.size(); ++i) {
      const Vector2 along = (outline_[(i + 1) % outline_.size()] - outline_[i]).normalized();
      const Vector2 across(-along.y(), along.x());
      const PadRoom room = {ExtentOf(pad, across), ExtentOf(outline_, across)};
      if (i == 0 || room.needed - room.available > least.needed - least.available) least = room;
    }
    if (least.fits()) least.available = least.needed - 2 * overhang;
    return least;
  }

  Eigen::AlignedBox2d Bounds() const {
    Eigen::AlignedBox2d bounds;
    for (const Vector2& p : outline_) bounds.extend(p);
    return bounds;
  }

 private:
  static double ExtentOf(const Polygon& polygon, const Vector2& direction) {
    const auto height = [&](const Vector2& p) { return direction.dot(p); };
    const auto [low, high] = std::ranges::minmax(polygon, {}, height);
    return height(high) - height(low);
  }

  Polygon outline_;
  geometry::Patches gaps_;
};

// Returns the positions inside the region on a grid through the region's centroid, and the position
// under the centre of mass. The nearest to the centre of mass come first.
std::vector<Spot> SpotsOf(const FacePair& pair, const PadRegion& room, const Vector2& mass_center) {
  std::vector<Spot> spots;
  const auto add = [&](const Vector2& p) {
    const double clearance = room.ClearanceAt(p);
    if (clearance < 0) return;
    spots.push_back({p, (p - mass_center).norm(), clearance});
  };
  add(mass_center);
  const Vector2 origin = geometry::Centroid(pair.region);
  const Eigen::AlignedBox2d bounds = room.Bounds();
  const Vector2 below = ((bounds.min() - origin) / kGridStep).array().ceil();
  const Vector2 above = ((bounds.max() - origin) / kGridStep).array().floor();
  for (int i = static_cast<int>(below.x()); i <= static_cast<int>(above.x()); ++i) {
    for (int j = static_cast<int>(below.y()); j <= static_cast<int>(above.y()); ++j) {
      add(origin + kGridStep * Vector2(i, j));
    }
  }
  // Keys are rounded, so that rounding errors do not order equal spots.
  const auto key = [](const Spot& spot) {
    return std::tuple(std::llround(spot.from_mass / kEqual), std::llround(spot.center.x() / kEqual),
                      std::llround(spot.center.y() / kEqual));
  };
  std::ranges::stable_sort(spots, {}, key);
  return spots;
}

Polygon PadAt(const Vector2& center, const Approach& approach, const Vector2& half_extents) {
  const Vector2 x = half_extents.x() * approach.x;
  const Vector2 z = half_extents.y() * approach.z;
  // The tool's y points at the viewer, so z to x turns counter-clockwise.
  return {center - x - z, center - x + z, center + x + z, center + x - z};
}

// The search for all grasps of one pair of faces.
class PairSearch {
 public:
  PairSearch(const PartModel& part, const kinematics::Gripper& gripper, FacePair pair,
             bool with_misfits)
      : part_(part),
        pads_(gripper.pad_half_extents()),
        pair_(std::move(pair)),
        region_(pair_.region),
        clearance_(part, gripper, pair_.X_PartMiddle, pair_.width, kAllowance),
        least_margin_(with_misfits ? std::numeric_limits<double>::lowest() : -2 * kEqual) {
    const Vector3 mass_center = pair_.X_PartMiddle.inverse() * part.mass().center;
    spots_ = SpotsOf(pair_, region_, mass_center.head<2>());
  }

  // Returns the grasp that represents its class. Returns none if the pads have no room, or if the
  // hand cannot approach.
  std::optional<Grasp> Along(double angle) const {
    const Approach approach = Approach::At(angle, ExtentAlong(angle));
    const std::optional<Vector2> center = BestCenter(approach);
    if (!center) return std::nullopt;
    const Polygon pad = PadAt(*center, approach, pads_);
    Grasp grasp;
    grasp.X_PartTool = pair_.X_PartMiddle * ToolInMiddle(*center, approach);
    grasp.width = pair_.width;
    grasp.hidden = HiddenBy(pad);
    const double margin = region_.MarginOf(pad);
    if (margin <= -kEqual) grasp.room = region_.Lacking(pad, -margin);
    return grasp;
  }

 private:
  double MarginAt(const Spot& spot, const Approach& approach) const {
    if (spot.clearance >= pads_.norm() + kDeepEnough) return kDeepEnough;
    return region_.MarginOf(PadAt(spot.center, approach, pads_));
  }

  // The spots nearest to the centre of mass come first, so a later spot must lie deeper to replace
  // an earlier one.
  std::optional<Vector2> BestCenter(const Approach& approach) const {
    const std::vector<CObstacle> obstacles = clearance_.ObstaclesOf(approach);
    const Spot* best = nullptr;
    double best_margin = least_margin_;
    for (const Spot& spot : spots_) {
      if (best_margin >= kDeepEnough - kEqual) break;
      const auto blocks = [&](const CObstacle& o) { return o.Contains(spot.center); };
      if (std::ranges::any_of(obstacles, blocks)) continue;
      const double margin = MarginAt(spot, approach);
      if (margin <= best_margin + kEqual) continue;
      best = &spot;
      best_margin = margin;
    }
    return best == nullptr ? std::nullopt : std::optional(best->center);
  }

  static Pose ToolInMiddle(const Vector2& center, const Approach& approach) {
    const auto lift = [](const Vector2& v) { return Vector3(v.x(), v.y(), 0); };
    return geometry::PoseFromColumns(lift(approach.x), Vector3::UnitZ(), lift(approach.z),
                                     lift(center));
  }

  // Returns the length of the part along the approach direction.
  double ExtentAlong(double angle) const {
    const Vector3 along =
        pair_.X_PartMiddle.linear() * Vector3(std::cos(angle), std::sin(angle), 0);
    const auto height = [&](const Vector3& p) { return along.dot(p); };
    const auto [low, high] = std::ranges::minmax(part_.corners(), {}, height);
    return height(high) - height(low);
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
  FacePair pair_;
  PadRegion region_;
  HandClearance clearance_;
  double least_margin_;  // least margin of the pads in the faces; they may end at the border
  std::vector<Spot> spots_;
};

}  // namespace

// The pads lie wholly on exposed surface, and mouths of holes are open. The features that a grasp
// hides therefore depend on its two faces alone. So each pair of faces with one approach direction
// is one class of grasps.
std::vector<Grasp> ComputeGrasps(const PartModel& part, const kinematics::Gripper& gripper,
                                 const GraspSearch& search) {
  ASSAY_CHECK(search.approach_step > kRounding);
  const double turns = 2 * std::numbers::pi / search.approach_step;
  const int directions = static_cast<int>(std::ceil(turns - kRounding));
  std::vector<Grasp> grasps;
  for (FacePair& pair : PairsOf(part, search.widest)) {
    const PairSearch pair_search(part, gripper, std::move(pair), search.with_misfits);
    for (int i = 0; i < directions; ++i) {
      std::optional<Grasp> grasp = pair_search.Along(i * search.approach_step);
      if (!grasp) continue;
      grasp->label = fmt::format("{}G{}", part.initial(), grasps.size() + 1);
      grasps.push_back(*std::move(grasp));
    }
  }
  return grasps;
}

}  // namespace assay::domain
