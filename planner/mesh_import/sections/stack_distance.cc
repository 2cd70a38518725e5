#include "planner/mesh_import/sections/stack_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "planner/mesh_import/meshes/nearest_surface.h"

namespace assay::mesh_import {
namespace {

constexpr int kCircleSides = 180;
constexpr int kSamplesAlong = 4;   // of a wall, between its ends
constexpr int kSamplesAcross = 4;  // of a side

struct WallRing {
  double height = 0;
  std::vector<Vector2> corners;
};

// Returns the corners of a convex or concave polygon with its sides moved inward.
std::vector<Vector2> MovedInward(const std::vector<Vector2>& corners, double depth) {
  std::vector<Vector2> moved;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vector2& here = corners[i];
    const Vector2 in = (here - corners[(i + corners.size() - 1) % corners.size()]).normalized();
    const Vector2 out = (corners[(i + 1) % corners.size()] - here).normalized();
    const Vector2 normal_in(-in.y(), in.x());
    const Vector2 normal_out(-out.y(), out.x());
    const double share = std::max(1 + normal_in.dot(normal_out), 0.1);
    moved.push_back(here + depth / share * (normal_in + normal_out));
  }
  return moved;
}

std::vector<Vector2> RingCorners(const Contour& contour, double inward) {
  if (!contour.IsCircle()) return MovedInward(contour.corners, inward);
  Contour moved = contour;
  moved.radius -= inward;
  return moved.Outline(kCircleSides);
}

// Returns points of the lower and of the upper contour of a tapered post. Each contour has a point
// in the direction, seen from its center, of every corner of both contours.
std::pair<WallRing, WallRing> TaperRings(const Post& post) {
  std::vector<double> angles;
  for (const Contour* contour : {&post.at_low, &post.at_high}) {
    for (const Vector2& corner : contour->Outline(kCircleSides)) {
      const Vector2 to = corner - contour->center;
      angles.push_back(std::atan2(to.y(), to.x()));
    }
  }
  std::ranges::sort(angles);
  WallRing low{post.low, {}};
  WallRing high{post.high, {}};
  for (const double angle : angles) {
    const Vector2 direction(std::cos(angle), std::sin(angle));
    low.corners.push_back(post.at_low.center + post.at_low.Reach(direction) * direction);
    high.corners.push_back(post.at_high.center + post.at_high.Reach(direction) * direction);
  }
  return {low, high};
}

// Returns the rings between which the walls of a post are straight. The chamfer of a hole widens
// it.
std::vector<WallRing> RingsOf(const Post& post, bool is_hole) {
  if (!post.is_straight) {
    const auto [low, high] = TaperRings(post);
    return {low, high};
  }
  const double sign = is_hole ? -1 : 1;
  std::vector<WallRing> rings;
  rings.push_back({post.low, RingCorners(post.at_low, sign * post.chamfer_low.across)});
  if (post.chamfer_low.along > 0)
    rings.push_back({post.low + post.chamfer_low.along, RingCorners(post.at_low, 0)});
  if (post.chamfer_high.along > 0)
    rings.push_back({post.high - post.chamfer_high.along, RingCorners(post.at_high, 0)});
  rings.push_back({post.high, RingCorners(post.at_high, sign * post.chamfer_high.across)});
  return rings;
}

// Adds the triangles between two rings with equally many corners.
void AddWall(const WallRing& low, const WallRing& high, TriangleMesh& walls) {
  const int first = static_cast<int>(walls.vertices.size());
  const int count = static_cast<int>(std::min(low.corners.size(), high.corners.size()));
  for (int i = 0; i < count; ++i) {
    const auto at = static_cast<std::size_t>(i);
    walls.vertices.emplace_back(low.corners[at].x(), low.corners[at].y(), low.height);
    walls.vertices.emplace_back(high.corners[at].x(), high.corners[at].y(), high.height);
    const int a = first + 2 * i;
    const int b = first + 2 * ((i + 1) % count);
    walls.triangles.push_back({.corners = {a, b, b + 1}});
    walls.triangles.push_back({.corners = {a, b + 1, a + 1}});
  }
}

void AddWalls(const Post& post, bool is_hole, TriangleMesh& walls) {
  const std::vector<WallRing> rings = RingsOf(post, is_hole);
  for (std::size_t i = 1; i < rings.size(); ++i) AddWall(rings[i - 1], rings[i], walls);
}

// Compares one stack with one mesh.
class Comparison {
 public:
  Comparison(const TriangleMesh& mesh, const Stack& stack, double tolerance)
      : mesh_(mesh),
        stack_(stack),
        tolerance_(tolerance),
        surface_(mesh),
        walls_(WallsOf(stack)),
        wall_surface_(walls_) {}

  StackDistance Measure() {
    for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) {
      const Triangle& triangle = mesh_.triangles[i];
      if (mesh_.AreaVector(triangle).norm() <= tolerance_ * tolerance_) continue;
      for (int k = 0; k < 3; ++k) Note(FromStack(mesh_.Corner(triangle, k)), i);
      Note(FromStack(mesh_.Centroid(triangle)), i);
    }
    for (const Post& solid : stack_.solids) SampleWalls(solid, false);
    for (const StackPocket& pocket : stack_.pockets) SampleWalls(pocket.post, true);
    const double volume = mesh_.Volume();
    worst_.volume_share = (stack_.Volume() - volume) / volume;
    return worst_;
  }

 private:
  static TriangleMesh WallsOf(const Stack& stack) {
    TriangleMesh walls;
    for (const Post& solid : stack.solids) AddWalls(solid, false, walls);
    for (const StackPocket& pocket : stack.pockets) AddWalls(pocket.post, true, walls);
    return walls;
  }

  void Note(double distance, std::size_t triangle) {
    if (distance <= worst_.distance) return;
    worst_.distance = distance;
    worst_.triangle = static_cast<int>(triangle);
  }

  // Returns the distance of a point of the mesh from the walls and the ends of the stack.
  double FromStack(const Vector3& p) const {
    double least = wall_surface_.To(p).distance;
    const auto try_ends = [&](const Post& post) {
      for (const bool top : {false, true}) {
        const Contour& contour = top ? post.at_high : post.at_low;
        const double off = std::abs(p.z() - (top ? post.high : post.low));
        if (off < least && contour.Contains(p.head<2>())) least = off;
      }
    };
    for (const Post& solid : stack_.solids) try_ends(solid);
    for (const StackPocket& pocket : stack_.pockets) try_ends(pocket.post);
    return least;
  }

  // A side of a solid in which a slot opens has no surface at the mouth, and neither has the slot.
  bool IsAtMouth(const Vector3& p) const {
    return std::ranges::any_of(stack_.pockets, [&](const StackPocket& pocket) {
      const Post& post = pocket.post;
      if (p.z() < post.low - tolerance_ || p.z() > post.high + tolerance_) return false;
      const Contour& around = stack_.solids[static_cast<std::size_t>(pocket.solid)].at_low;
      const bool in_slot =
          post.at_low.Contains(p.head<2>()) || post.at_low.DistanceTo(p.head<2>()) <= tolerance_;
      return post.mouth && in_slot && around.DistanceTo(p.head<2>()) <= 2 * tolerance_;
    });
  }

  void SampleWalls(const Post& post, bool is_hole) {
    const std::vector<WallRing> rings = RingsOf(post, is_hole);
    for (std::size_t r = 1; r < rings.size(); ++r) {
      const std::size_t count = std::min(rings[r - 1].corners.size(), rings[r].corners.size());
      for (std::size_t i = 0; i < count; ++i) {
        for (int j = 1; j < 2 * kSamplesAlong; j += 2) {
          for (int k = 0; k < (post.at_low.IsCircle() ? 1 : kSamplesAcross); ++k)
            Sample(rings[r - 1], rings[r], i, static_cast<double>(j) / (2 * kSamplesAlong),
                   static_cast<double>(k) / kSamplesAcross);
        }
      }
    }
  }

  void Sample(const WallRing& low, const WallRing& high, std::size_t i, double along,
              double across) {
    const auto on = [&](const WallRing& ring) -> Vector2 {
      const Vector2& a = ring.corners[i];
      const Vector2& b = ring.corners[(i + 1) % ring.corners.size()];
      return a + across * (b - a);
    };
    Vector3 p;
    p << on(low) + along * (on(high) - on(low)), low.height + along * (high.height - low.height);
    if (IsAtMouth(p)) return;
    const NearestSurface::Nearest nearest = surface_.To(p);
    Note(nearest.distance, static_cast<std::size_t>(nearest.triangle));
  }

  const TriangleMesh& mesh_;
  const Stack& stack_;
  const double tolerance_;
  const NearestSurface surface_;
  const TriangleMesh walls_;
  const NearestSurface wall_surface_;
  StackDistance worst_;
};

}  // namespace

StackDistance DistanceBetween(const TriangleMesh& mesh, const Stack& stack, double tolerance) {
  return Comparison(mesh, stack, tolerance).Measure();
}

}  // namespace assay::mesh_import
