#include "planner/mesh_import/parts/resting_pose.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "planner/geometry/hull.h"
#include "planner/mesh_import/decomposition/convex_decomposition.h"

namespace assay::mesh_import {
namespace {

constexpr double kLeastTilt = 2 * std::numbers::pi / 180;
constexpr int kHullPoints = 400;
// A polygon with so many sides tips from each of them at less than kLeastTilt. A round part thus
// rests on no side, as if it were round.
constexpr int kSidesOfCircle = 120;

// Returns points whose hull is the part's.
std::vector<Vector3> OutermostPoints(const ImportedPart& part) {
  std::vector<Vector3> points;
  for (const SketchSolid& solid : part.sketch.solids) {
    const std::vector<Vector3> corners = solid.Corners(kSidesOfCircle);
    points.insert(points.end(), corners.begin(), corners.end());
  }
  return points;
}

Vector3 CenterOf(const ImportedPart& part) {
  Vector3 sum = Vector3::Zero();
  for (const BodyAccount& body : part.bodies) sum += body.shape.volume * body.shape.centroid;
  return part.sketch.R_FilePart.transpose() * sum / part.Volume();
}

// Returns by how much the part can be tilted about the edges of a face. The result is negative if
// the part falls over.
double TiltOf(const geometry::ConvexHull& hull, const geometry::Facet& facet,
              const Vector3& center) {
  const double height = facet.offset - facet.normal.dot(center);
  double tilt = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < facet.loop.size(); ++i) {
    const Vector3& a = hull.vertices[static_cast<std::size_t>(facet.loop[i])];
    const Vector3& b =
        hull.vertices[static_cast<std::size_t>(facet.loop[(i + 1) % facet.loop.size()])];
    const Vector3 inward = facet.normal.cross(Vector3(b - a)).normalized();
    tilt = std::min(tilt, std::atan2(inward.dot(center - a), height));
  }
  return tilt;
}

}  // namespace

std::vector<RestingPose> RestingPosesOf(const ImportedPart& part) {
  std::vector<RestingPose> poses;
  const std::optional<geometry::ConvexHull> hull =
      HullOfExtremes(OutermostPoints(part), kHullPoints);
  if (!hull) return poses;
  const Vector3 center = CenterOf(part);
  for (const geometry::Facet& facet : hull->facets) {
    const double tilt = TiltOf(*hull, facet, center);
    if (tilt >= kLeastTilt) poses.push_back({.down = facet.normal, .tilt = tilt});
  }
  std::ranges::stable_sort(poses, std::ranges::greater(),
                           [](const RestingPose& pose) { return std::round(pose.tilt * 1e6); });
  return poses;
}

Vector3 ExtentsOf(const ImportedPart& part) {
  Eigen::AlignedBox3d bounds;
  for (const Vector3& p : OutermostPoints(part)) bounds.extend(p);
  return bounds.sizes();
}

geometry::Pose OnTable(const ImportedPart& part, const Vector3& down, const Vector2& at) {
  geometry::Pose X_WorldPart = geometry::Pose::Identity();
  X_WorldPart.linear() =
      Eigen::Quaterniond::FromTwoVectors(down, -Vector3::UnitZ()).toRotationMatrix();
  Eigen::AlignedBox3d bounds;
  for (const Vector3& point : OutermostPoints(part)) bounds.extend(X_WorldPart.linear() * point);
  const Vector3 middle = bounds.center();
  X_WorldPart.translation() << at.x() - middle.x(), at.y() - middle.y(), -bounds.min().z();
  return X_WorldPart;
}

}  // namespace assay::mesh_import
