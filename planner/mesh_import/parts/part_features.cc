#include "planner/mesh_import/parts/part_features.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "planner/geometry/hull.h"
#include "planner/geometry/polygon.h"
#include "planner/mesh_import/parts/exposure.h"

namespace assay::mesh_import {
namespace {

constexpr std::size_t kMostSides = 12;  // of a polygon whose sides become features
constexpr double kLeastSide = 0.1;      // length of such a side, as a share of the greatest width
constexpr double kLeastFacet = 0.04;    // area of a hull's facet that is a feature, as a share
constexpr int kShadowSides = 48;

std::string Length(double metres) { return fmt::format("{:.6g}", std::round(metres * 1e6) / 1e3); }

std::string Toward(const Vector3& direction) {
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(std::abs(direction[axis]) - 1) < 1e-6)
      return fmt::format("{}{}", direction[axis] > 0 ? '+' : '-', "xyz"[axis]);
  }
  return fmt::format("({:.2f} {:.2f} {:.2f})", direction.x(), direction.y(), direction.z());
}

// Returns "round", "square" and so on with the dimensions.
std::string FormOf(const Contour& contour, const char* noun) {
  const Vector2 sizes = contour.Bounds().sizes();
  switch (contour.kind) {
    case Contour::Kind::kCircle:
      return fmt::format("round {}, {} mm", noun, Length(2 * contour.radius));
    case Contour::Kind::kRectangle:
      if (Length(sizes.x()) == Length(sizes.y()))
        return fmt::format("square {}, {} mm", noun, Length(sizes.x()));
      return fmt::format("rectangular {}, {} x {} mm", noun, Length(sizes.maxCoeff()),
                         Length(sizes.minCoeff()));
    case Contour::Kind::kPolygon:
      return fmt::format("{} with {} sides, {} x {} mm", noun, contour.corners.size(),
                         Length(sizes.maxCoeff()), Length(sizes.minCoeff()));
  }
  return noun;
}

// Returns whether a contour has no corner inside its hull. In a part file, a hole has none, or
// its mouth would count as covered.
bool HasNoNiche(const Contour& contour) {
  constexpr double kRounding = 1e-7;  // metres
  const geometry::Polygon hull = geometry::Hull2(contour.corners);
  return contour.IsCircle() || std::ranges::all_of(contour.corners, [&](const Vector2& corner) {
           return geometry::Depth(hull, corner) <= kRounding;
         });
}

class FeatureFinder {
 public:
  explicit FeatureFinder(PartSketch& sketch)
      : sketch_(sketch), sampler_(sketch), margin_(sampler_.margin()) {}

  void Find() {
    for (const SketchSolid& solid : sketch_.solids) {
      if (solid.post && !solid.post->is_step) {
        AddFaces(solid);
      } else if (!solid.post) {
        AddFacets(solid);
      }
    }
    for (const SketchPocket& pocket : sketch_.pockets) {
      if (!pocket.pocket.post.is_step) AddHole(pocket);
    }
    for (std::size_t i = 0; i < sketch_.solids.size(); ++i) {
      const std::optional<Post>& post = sketch_.solids[i].post;
      if (post && post->is_straight && !post->is_step) AddShafts(i);
    }
  }

 private:
  using Kind = SketchFeature::Kind;

  void Add(Kind kind, const std::string& of, const Vector3& direction, std::string what,
           double chamfer = 0) {
    sketch_.features.push_back({kind, of, direction, std::move(what), chamfer});
  }

  // Adds a face unless a feature has the same plane already.
  void AddFace(const SketchSolid& solid, const Vector3& normal, double offset, std::string what) {
    const bool is_known = std::ranges::any_of(planes_, [&](const auto& plane) {
      return (plane.first - normal).norm() < 1e-6 && std::abs(plane.second - offset) < margin_;
    });
    if (is_known) return;
    planes_.emplace_back(normal, offset);
    Add(Kind::kFace, solid.name, normal, std::move(what));
  }

  // Returns " of NAME" where a part has more than one solid.
  std::string OfSolid(const SketchSolid& solid) const {
    return sketch_.solids.size() > 1 ? " of " + solid.name : "";
  }

  void AddFaces(const SketchSolid& solid) {
    const Post& post = *solid.post;
    const Vector3 axis = solid.R_PartLocal.col(2);
    for (const bool top : {true, false}) {
      if (!sampler_.OfEnd(solid.R_PartLocal, post, top).Some()) continue;
      const Vector3 normal = top ? axis : Vector3(-axis);
      AddFace(solid, normal, top ? post.high : -post.low,
              fmt::format("end{} toward {}", OfSolid(solid), Toward(normal)));
    }
    const std::vector<Vector2>& corners = post.at_low.corners;
    if (!post.is_straight || post.at_low.IsCircle() || corners.size() > kMostSides) return;
    const double width = post.at_low.Bounds().sizes().maxCoeff();
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vector2& a = corners[i];
      const Vector2& b = corners[(i + 1) % corners.size()];
      if ((b - a).norm() < kLeastSide * width ||
          !sampler_.OfSide(solid.R_PartLocal, post, a, b).Some())
        continue;
      const Vector2 outward = Vector2((b - a).y(), (a - b).x()).normalized();
      const Vector3 normal = solid.R_PartLocal * Vector3(outward.x(), outward.y(), 0);
      AddFace(solid, normal, outward.dot(a),
              fmt::format("side{} toward {}", OfSolid(solid), Toward(normal)));
    }
  }

  // A body of one convex piece has faces that can be named.
  void AddFacets(const SketchSolid& solid) {
    if (solid.pieces.size() != 1) return;
    const geometry::ConvexHull& hull = solid.pieces.front();
    std::vector<double> areas;
    double total = 0;
    for (const geometry::Facet& facet : hull.facets) {
      Vector3 area = Vector3::Zero();
      const auto at = [&](std::size_t i) -> const Vector3& {
        return hull.vertices[static_cast<std::size_t>(facet.loop[i])];
      };
      for (std::size_t i = 2; i < facet.loop.size(); ++i)
        area += (at(i - 1) - at(0)).cross(at(i) - at(0)) / 2;
      areas.push_back(area.norm());
      total += area.norm();
    }
    for (std::size_t i = 0; i < areas.size(); ++i) {
      const geometry::Facet& facet = hull.facets[i];
      if (areas[i] < kLeastFacet * total) continue;
      AddFace(solid, facet.normal, facet.offset,
              fmt::format("face toward {}", Toward(facet.normal)));
    }
  }

  void AddHole(const SketchPocket& entry) {
    const Post& post = entry.pocket.post;
    const SketchSolid& solid = sketch_.solids[static_cast<std::size_t>(entry.solid)];
    const bool opens_high =
        (post.mouth || HasNoNiche(post.at_high)) && IsMouth(solid.R_PartLocal, post, true);
    const bool opens_low =
        (post.mouth || HasNoNiche(post.at_low)) && IsMouth(solid.R_PartLocal, post, false);
    const char* noun = post.mouth ? "slot" : "hole";
    std::string what = FormOf(
        post.is_straight || post.at_high.Area() > post.at_low.Area() ? post.at_high : post.at_low,
        noun);
    if (post.mouth && !IsUndercut(post)) {
      Add(Kind::kHole, entry.name, solid.R_PartLocal * Vector3(post.mouth->x(), post.mouth->y(), 0),
          what + fmt::format(", {} mm long", Length(post.Height())));
      return;
    }
    if (!opens_high && !opens_low) return;
    const bool goes_through = opens_high && opens_low;
    what += goes_through ? ", through" : fmt::format(", {} mm deep", Length(post.Height()));
    if (!post.is_straight) what += ", tapered";
    // If a hole has two mouths, the mouth with a chamfer comes first.
    const bool low_first = post.chamfer_low.across > 0 && post.chamfer_high.across == 0;
    for (const bool top : {!low_first, low_first}) {
      if (!(top ? opens_high : opens_low)) continue;
      const Chamfer& chamfer = top ? post.chamfer_high : post.chamfer_low;
      const Vector3 mouth = (top ? 1 : -1) * solid.R_PartLocal.col(2);
      Add(Kind::kHole, entry.name, mouth,
          goes_through ? what + ", mouth toward " + Toward(mouth) : what,
          std::min(chamfer.across, chamfer.along));
    }
  }

  // Returns whether a pocket has an end through which a shaft can come from outside: the end is in
  // the part's outside, or in the floor of wider pockets.
  bool IsMouth(const Matrix3& R, const Post& post, bool top) const {
    const Contour& contour = top ? post.at_high : post.at_low;
    const Vector3 beyond = R * Vector3(contour.center.x(), contour.center.y(),
                                       top ? post.high + margin_ : post.low - margin_);
    const bool goes_on = std::ranges::any_of(sketch_.pockets, [&](const SketchPocket& other) {
      const SketchSolid& solid = sketch_.solids[static_cast<std::size_t>(other.solid)];
      return other.pocket.post.Contains(solid.R_PartLocal.transpose() * beyond);
    });
    if (!sampler_.OfMouth(R, post, top).All()) return false;
    if (!goes_on) return true;
    return sampler_.AroundRim(R, post, top).All() && sampler_.SeesOut(R, post, top);
  }

  // A slot is undercut if it is wider than its mouth, as a T-slot is.
  static bool IsUndercut(const Post& slot) {
    const Vector2 along(-slot.mouth->y(), slot.mouth->x());
    double depth = -1e9;
    for (const Vector2& corner : slot.at_low.corners)
      depth = std::max(depth, slot.mouth->dot(corner));
    double low = 1e9, high = -1e9, mouth_low = 1e9, mouth_high = -1e9;
    const double margin = 1e-3 * slot.at_low.Bounds().sizes().maxCoeff();
    for (const Vector2& corner : slot.at_low.corners) {
      low = std::min(low, along.dot(corner));
      high = std::max(high, along.dot(corner));
      if (slot.mouth->dot(corner) < depth - margin) continue;
      mouth_low = std::min(mouth_low, along.dot(corner));
      mouth_high = std::max(mouth_high, along.dot(corner));
    }
    return high - low > mouth_high - mouth_low + margin;
  }

  // Adds a shaft for each end of a layer with free sides that can go first into a hole as wide as
  // the layer. A hollow layer is a shaft, too, unless a slot opens its sides.
  void AddShafts(std::size_t index) {
    const SketchSolid& solid = sketch_.solids[index];
    const Post& post = *solid.post;
    const bool is_slotted = std::ranges::any_of(sketch_.pockets, [&](const SketchPocket& pocket) {
      return pocket.solid == static_cast<int>(index) && pocket.pocket.post.mouth;
    });
    if (is_slotted || !sampler_.OfSides(solid.R_PartLocal, post).All()) return;
    for (const bool top : {true, false}) {
      if (!sampler_.OfRim(solid.R_PartLocal, post, top).All() || !GoesFirst(solid, top)) continue;
      const Chamfer& chamfer = top ? post.chamfer_high : post.chamfer_low;
      const Vector3 axis = (top ? 1 : -1) * solid.R_PartLocal.col(2);
      Add(Kind::kShaft, solid.name, axis,
          FormOf(post.at_low, "shaft") +
              fmt::format(", {} mm long, tip toward {}", Length(post.Height()), Toward(axis)),
          std::min(chamfer.across, chamfer.along));
    }
  }

  // Returns whether the solids that reach beyond an end of a layer are within its outline, or are
  // wholly beside it.
  bool GoesFirst(const SketchSolid& layer, bool top) const {
    const Post& post = *layer.post;
    const double sign = top ? 1 : -1;
    const double end = sign * (top ? post.high : post.low);
    const std::vector<Vector2> outline = post.at_low.Outline(kShadowSides);
    return std::ranges::none_of(sketch_.solids, [&](const SketchSolid& other) {
      std::vector<Vector2> shadow;
      double reach = -std::numeric_limits<double>::infinity();
      for (const Vector3& corner : other.Corners(kShadowSides)) {
        const Vector3 p = layer.R_PartLocal.transpose() * corner;
        shadow.push_back(p.head<2>());
        reach = std::max(reach, sign * p.z());
      }
      if (&other == &layer || reach <= end + margin_) return false;
      const geometry::Polygon around = geometry::Hull2(shadow);
      const auto is_in = [&](const Vector2& p) { return post.at_low.Contains(p); };
      const auto is_beside = [&](const Vector2& p) {
        return !is_in(p) && post.at_low.DistanceTo(p) > 2 * margin_;
      };
      const bool is_in_line =
          std::ranges::any_of(shadow, is_in) || std::ranges::any_of(outline, [&](const Vector2& p) {
            return geometry::Depth(around, p) > 2 * margin_;
          });
      return is_in_line && std::ranges::any_of(shadow, is_beside);
    });
  }

  PartSketch& sketch_;
  const ExposureSampler sampler_;
  const double margin_;
  std::vector<std::pair<Vector3, double>> planes_;  // normals and offsets of the faces
};

}  // namespace

void AddFeatures(PartSketch& sketch) { FeatureFinder(sketch).Find(); }

}  // namespace assay::mesh_import
