#include "planner/mesh_import/parts/exposure.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace assay::mesh_import {
namespace {

constexpr double kOutside = 1e-5;  // distance of a sample from a surface, as a share of the size
constexpr int kSamples = 9;        // of a surface, along each of its directions
constexpr int kRimSides = 48;
// A part file has no narrower faces, in metres.
constexpr double kNarrowestRim = 2e-5;

// Returns points on an end of a post, in its frame.
std::vector<Vector2> PointsOfEnd(const Post& post, bool top) {
  const Contour& contour = top ? post.at_high : post.at_low;
  const Eigen::AlignedBox2d bounds = contour.Bounds();
  std::vector<Vector2> points;
  for (int i = 0; i < kSamples; ++i) {
    for (int j = 0; j < kSamples; ++j) {
      const Vector2 share((i + 0.5) / kSamples, (j + 0.5) / kSamples);
      const Vector2 at = bounds.min() + share.cwiseProduct(bounds.sizes());
      if (contour.Contains(at)) points.push_back(at);
    }
  }
  return points;
}

Vector2 OutwardOf(const Vector2& a, const Vector2& b) {
  return Vector2((b - a).y(), (a - b).x()).normalized();
}

// Returns the corners of a contour. The sides of the polygon around a circle touch it in their
// middles.
std::vector<Vector2> OutlineAround(Contour contour) {
  contour.radius /= std::cos(std::numbers::pi / kRimSides);
  return contour.Outline(kRimSides);
}

}  // namespace

ExposureSampler::ExposureSampler(const PartSketch& sketch)
    : sketch_(sketch), margin_(kOutside * sketch.size) {}

Exposure ExposureSampler::OfEnd(const Matrix3& R, const Post& post, bool top) const {
  const double sign = top ? 1 : -1;
  const double height = top ? post.high : post.low;
  Exposure exposure;
  for (const Vector2& at : PointsOfEnd(post, top)) {
    const auto point = [&](double above) -> Vector3 {
      return R * Vector3(at.x(), at.y(), height + sign * above);
    };
    if (sketch_.Contains(point(-margin_))) exposure.Count(!sketch_.Contains(point(margin_)));
  }
  return exposure;
}

Exposure ExposureSampler::OfMouth(const Matrix3& R, const Post& post, bool top) const {
  const double height = top ? post.high : post.low;
  const Contour& contour = top ? post.at_high : post.at_low;
  Exposure exposure;
  for (const Vector2& at : PointsOfEnd(post, top)) {
    if (contour.DistanceTo(at) <= margin_) continue;
    const auto is_free = [&](double above) {
      return !sketch_.Contains(R * Vector3(at.x(), at.y(), height + above));
    };
    exposure.Count(is_free(margin_) && is_free(-margin_));
  }
  return exposure;
}

Exposure ExposureSampler::OfRim(const Matrix3& R, const Post& post, bool top) const {
  return BesideRim(R, post, top, -std::max(kNarrowestRim, 2 * margin_));
}

Exposure ExposureSampler::AroundRim(const Matrix3& R, const Post& post, bool top) const {
  return BesideRim(R, post, top, std::max(kNarrowestRim, 2 * margin_));
}

Exposure ExposureSampler::BesideRim(const Matrix3& R, const Post& post, bool top,
                                    double outward) const {
  const double sign = top ? 1 : -1;
  const double height = top ? post.high : post.low;
  const std::vector<Vector2> outline = (top ? post.at_high : post.at_low).Outline(kRimSides);
  Exposure exposure;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vector2& a = outline[i];
    const Vector2& b = outline[(i + 1) % outline.size()];
    for (int j = 0; j < kSamples; ++j) {
      const Vector2 at = a + (j + 0.5) / kSamples * (b - a) + outward * OutwardOf(a, b);
      const auto point = [&](double above) -> Vector3 {
        return R * Vector3(at.x(), at.y(), height + sign * above);
      };
      if (sketch_.Contains(point(-margin_))) exposure.Count(!sketch_.Contains(point(margin_)));
    }
  }
  return exposure;
}

Exposure ExposureSampler::OfSide(const Matrix3& R, const Post& post, const Vector2& a,
                                 const Vector2& b) const {
  const Vector2 outward = OutwardOf(a, b);
  Exposure exposure;
  for (int i = 0; i < kSamples; ++i) {
    for (int j = 0; j < kSamples; ++j) {
      const Vector2 at = a + (i + 0.5) / kSamples * (b - a);
      const double height = post.low + (j + 0.5) / kSamples * post.Height();
      const auto point = [&](double out) -> Vector3 {
        const Vector2 p = at + out * outward;
        return R * Vector3(p.x(), p.y(), height);
      };
      if (sketch_.Contains(point(-2 * margin_)))
        exposure.Count(!sketch_.Contains(point(2 * margin_)));
    }
  }
  return exposure;
}

Exposure ExposureSampler::OfSides(const Matrix3& R, const Post& post) const {
  const std::vector<Vector2> outline = OutlineAround(post.at_low);
  Exposure exposure;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Exposure side = OfSide(R, post, outline[i], outline[(i + 1) % outline.size()]);
    exposure.points += side.points;
    exposure.exposed += side.exposed;
  }
  return exposure;
}

bool ExposureSampler::SeesOut(const Matrix3& R, const Post& post, bool top) const {
  const double sign = top ? 1 : -1;
  const std::vector<double> heights = HeightsBeyond(R, top ? post.high : post.low, sign);
  return std::ranges::none_of(PointsOfEnd(post, top), [&](const Vector2& at) {
    return std::ranges::any_of(heights, [&](double height) {
      return sketch_.Contains(R * Vector3(at.x(), at.y(), height));
    });
  });
}

// Between two neighbouring heights no solid and no pocket along the axis begins or ends. For solids
// along other axes the heights are not far apart.
std::vector<double> ExposureSampler::HeightsBeyond(const Matrix3& R, double end,
                                                   double sign) const {
  constexpr int kLevels = 32;
  std::vector<double> levels = {end};
  const auto add = [&](double height) {
    if (sign * (height - end) > margin_) levels.push_back(height);
  };
  for (const SketchSolid& solid : sketch_.solids) {
    for (const Vector3& corner : solid.Corners(kRimSides)) add(R.col(2).dot(corner));
  }
  for (const SketchPocket& pocket : sketch_.pockets) {
    const SketchSolid& solid = sketch_.solids[static_cast<std::size_t>(pocket.solid)];
    if (std::abs(solid.R_PartLocal.col(2).dot(R.col(2))) < 1 - 1e-9) continue;
    const double along = solid.R_PartLocal.col(2).dot(R.col(2));
    add(along * pocket.pocket.post.low);
    add(along * pocket.pocket.post.high);
  }
  const double farthest =
      *std::ranges::max_element(levels, {}, [&](double height) { return sign * height; });
  for (int i = 1; i < kLevels; ++i) add(end + i * (farthest - end) / kLevels);
  std::ranges::sort(levels);
  std::vector<double> heights;
  for (std::size_t i = 1; i < levels.size(); ++i) {
    if (levels[i] - levels[i - 1] > margin_) heights.push_back((levels[i] + levels[i - 1]) / 2);
  }
  return heights;
}

}  // namespace assay::mesh_import
