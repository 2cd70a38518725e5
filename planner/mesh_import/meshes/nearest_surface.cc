#include "planner/mesh_import/meshes/nearest_surface.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "planner/base/check.h"

namespace assay::mesh_import {
namespace {

constexpr int kLeafTriangles = 8;

double DistanceToSegment(const Vector3& p, const Vector3& a, const Vector3& b) {
  const Vector3 along = b - a;
  const double length = along.squaredNorm();
  const double share = length > 0 ? std::clamp((p - a).dot(along) / length, 0.0, 1.0) : 0;
  return (p - a - share * along).norm();
}

double DistanceToTriangle(const Vector3& p, const Vector3& a, const Vector3& b, const Vector3& c) {
  const Vector3 normal = (b - a).cross(c - a);
  const bool is_above = normal.squaredNorm() > 0 && normal.dot((b - a).cross(p - a)) >= 0 &&
                        normal.dot((c - b).cross(p - b)) >= 0 &&
                        normal.dot((a - c).cross(p - c)) >= 0;
  if (is_above) return std::abs(normal.normalized().dot(p - a));
  return std::min(
      {DistanceToSegment(p, a, b), DistanceToSegment(p, b, c), DistanceToSegment(p, c, a)});
}

}  // namespace

NearestSurface::NearestSurface(const TriangleMesh& mesh) : mesh_(mesh) {
  ASSAY_CHECK(!mesh.triangles.empty());
  order_.resize(mesh.triangles.size());
  std::iota(order_.begin(), order_.end(), 0);
  for (const Triangle& triangle : mesh.triangles) centroids_.push_back(mesh.Centroid(triangle));
  Build(0, static_cast<int>(order_.size()));
}

int NearestSurface::Build(int begin, int end) {
  Node node{.bounds = {}, .begin = begin, .end = end};
  Eigen::AlignedBox3d centers;
  for (int i = begin; i < end; ++i) {
    const int index = order_[static_cast<std::size_t>(i)];
    const Triangle& triangle = mesh_.triangles[static_cast<std::size_t>(index)];
    for (int k = 0; k < 3; ++k) node.bounds.extend(mesh_.Corner(triangle, k));
    centers.extend(centroids_[static_cast<std::size_t>(index)]);
  }
  const int own = static_cast<int>(nodes_.size());
  nodes_.push_back(node);
  if (end - begin <= kLeafTriangles) return own;
  Eigen::Index axis = 0;
  centers.sizes().maxCoeff(&axis);
  const int middle = (begin + end) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                   [&](int a, int b) {
                     const double at_a = centroids_[static_cast<std::size_t>(a)][axis];
                     const double at_b = centroids_[static_cast<std::size_t>(b)][axis];
                     return at_a != at_b ? at_a < at_b : a < b;
                   });
  const int left = Build(begin, middle);
  const int right = Build(middle, end);
  nodes_[static_cast<std::size_t>(own)].left = left;
  nodes_[static_cast<std::size_t>(own)].right = right;
  return own;
}

NearestSurface::Nearest NearestSurface::To(const Vector3& p) const {
  Nearest nearest{.distance = std::numeric_limits<double>::infinity(), .triangle = 0};
  Search(0, p, nearest);
  return nearest;
}

void NearestSurface::Search(int index, const Vector3& p, Nearest& nearest) const {
  const Node& node = nodes_[static_cast<std::size_t>(index)];
  if (node.left < 0) {
    for (int i = node.begin; i < node.end; ++i) {
      const int at = order_[static_cast<std::size_t>(i)];
      const Triangle& triangle = mesh_.triangles[static_cast<std::size_t>(at)];
      const double distance = DistanceToTriangle(
          p, mesh_.Corner(triangle, 0), mesh_.Corner(triangle, 1), mesh_.Corner(triangle, 2));
      if (distance < nearest.distance) nearest = {distance, at};
    }
    return;
  }
  const auto gap = [&](int child) {
    return nodes_[static_cast<std::size_t>(child)].bounds.exteriorDistance(p);
  };
  const bool left_first = gap(node.left) <= gap(node.right);
  for (const int child :
       {left_first ? node.left : node.right, left_first ? node.right : node.left}) {
    if (gap(child) < nearest.distance) Search(child, p, nearest);
  }
}

}  // namespace assay::mesh_import
