#include "planner/geometry/hull.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <ranges>
#include <tuple>

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

#include "planner/base/check.h"
#include "planner/geometry/box.h"
#include "planner/geometry/outline.h"
#include "planner/geometry/polygon.h"

namespace assay::geometry {
namespace {

// Tolerance relative to the size of the point set. Points that are closer to each other than the
// tolerance count as one point, and points that are closer to a plane or line than the tolerance
// count as points on it. For facets of ordinary shape this merges triangles whose normals differ by
// less than about 1e-7.
constexpr double kTolerance = 1e-7;

// The corners of a facet as indices of points, in order.
struct FacetOutline {
  Vector3 normal;
  std::vector<int> loop;
  double area = 0;
};

// Owns Qhull's reentrant state.
class QhullRun {
 public:
  explicit QhullRun(std::vector<Vector3>& points) {
    static_assert(sizeof(Vector3) == 3 * sizeof(coordT));
    char options[] = "qhull";
    qh_zero(&qh_, stderr);
    const int exit_code =
        qh_new_qhull(&qh_, 3, static_cast<int>(points.size()), points.front().data(),
                     /*ismalloc=*/False, options, /*outfile=*/nullptr, /*errfile=*/stderr);
    ASSAY_CHECK(exit_code == 0, "Qhull: {} points do not span three dimensions", points.size());
  }
  QhullRun(const QhullRun&) = delete;
  QhullRun& operator=(const QhullRun&) = delete;
  ~QhullRun() {
    qh_freeqhull(&qh_, !qh_ALL);
    int long_count = 0;
    int long_bytes = 0;
    qh_memfreeshort(&qh_, &long_count, &long_bytes);
  }

  std::vector<Plane> Planes() const {
    std::vector<Plane> planes;
    for (const facetT* facet = qh_.facet_list; facet != nullptr && facet->next != nullptr;
         facet = facet->next) {
      planes.push_back(
          {Vector3(facet->normal[0], facet->normal[1], facet->normal[2]), -facet->offset});
    }
    return planes;
  }

 private:
  qhT qh_;
};

// Returns the indices of the points that do not repeat an earlier point.
std::vector<int> FirstOccurrences(std::span<const Vector3> points, double tolerance) {
  std::vector<int> kept;
  for (int i = 0; i < static_cast<int>(points.size()); ++i) {
    const auto repeats = [&](int k) { return (points[k] - points[i]).norm() <= tolerance; };
    if (std::ranges::none_of(kept, repeats)) kept.push_back(i);
  }
  return kept;
}

// Removes corners closer than `tolerance` to the line through their neighbours, the flattest first.
void DropCollinear(Polygon& polygon, double tolerance) {
  while (polygon.size() >= 3) {
    const int count = static_cast<int>(polygon.size());
    const auto height = [&](int i) {
      const Vector2 along = polygon[(i + 1) % count] - polygon[(i + count - 1) % count];
      const Vector2 to = polygon[i] - polygon[(i + count - 1) % count];
      return std::abs(along.x() * to.y() - along.y() * to.x()) / along.norm();
    };
    const int flattest = std::ranges::min(std::views::iota(0, count), {}, height);
    if (height(flattest) > tolerance) return;
    polygon.erase(polygon.begin() + flattest);
  }
}

// Returns the convex outline of the points that lie on a plane, beginning with the smallest index.
// It has fewer than three corners if the points do not span the plane.
FacetOutline OutlineOn(const Plane& plane, const std::vector<Vector3>& points, double tolerance) {
  const Vector3 u = plane.normal.unitOrthogonal();
  const Vector3 v = plane.normal.cross(u);
  std::vector<int> on_plane;
  std::vector<Vector2> projected;
  for (int i = 0; i < static_cast<int>(points.size()); ++i) {
    if (plane.normal.dot(points[i]) < plane.height - tolerance) continue;
    on_plane.push_back(i);
    projected.emplace_back(u.dot(points[i]), v.dot(points[i]));
  }
  Polygon corners = Hull2(projected);
  DropCollinear(corners, tolerance);
  FacetOutline outline{plane.normal, {}, Area(corners)};
  for (const Vector2& corner : corners) {
    outline.loop.push_back(on_plane[std::ranges::find(projected, corner) - projected.begin()]);
  }
  std::ranges::rotate(outline.loop, std::ranges::min_element(outline.loop));
  return outline;
}

int SharedCorners(const FacetOutline& a, const FacetOutline& b) {
  const auto in_b = [&](int i) { return std::ranges::find(b.loop, i) != b.loop.end(); };
  return static_cast<int>(std::ranges::count_if(a.loop, in_b));
}

// Returns the outlines of distinct facets, sorted by loop. Two facets of a convex polyhedron share
// at most an edge. Outlines that share more are triangles of one facet or slivers from rounding,
// and only the widest of them is kept.
std::vector<FacetOutline> DistinctOutlines(const std::vector<Plane>& planes,
                                           const std::vector<Vector3>& points, double tolerance) {
  std::vector<FacetOutline> candidates;
  for (const Plane& plane : planes) {
    FacetOutline outline = OutlineOn(plane, points, tolerance);
    if (outline.loop.size() >= 3) candidates.push_back(std::move(outline));
  }
  std::ranges::stable_sort(candidates, std::ranges::greater(), &FacetOutline::area);
  std::vector<FacetOutline> distinct;
  for (FacetOutline& candidate : candidates) {
    const auto same = [&](const FacetOutline& other) {
      return SharedCorners(candidate, other) > 2;
    };
    if (std::ranges::none_of(distinct, same)) distinct.push_back(std::move(candidate));
  }
  std::ranges::sort(distinct, {}, &FacetOutline::loop);
  return distinct;
}

// Returns the facet of a loop, with the plane that fits its corners (Newell's method).
Facet FacetOf(std::vector<int> loop, const std::vector<Vector3>& vertices) {
  Vector3 middle = Vector3::Zero();
  for (int i : loop) middle += vertices[i] / static_cast<double>(loop.size());
  Vector3 normal = Vector3::Zero();
  for (size_t k = 0; k < loop.size(); ++k) {
    const Vector3& next = vertices[loop[(k + 1) % loop.size()]];
    normal += (vertices[loop[k]] - middle).cross(next - middle);
  }
  normal.normalize();
  return {normal, normal.dot(middle), std::move(loop)};
}

// Keeps the points that are corners of an outline, in their order, and renumbers the loops.
ConvexHull Assemble(const std::vector<FacetOutline>& outlines, std::span<const Vector3> points,
                    const std::vector<int>& kept) {
  std::vector<int> number(kept.size(), -1);
  for (const FacetOutline& outline : outlines) {
    for (int i : outline.loop) number[i] = 0;
  }
  ConvexHull hull;
  for (size_t i = 0; i < kept.size(); ++i) {
    if (number[i] < 0) continue;
    number[i] = static_cast<int>(hull.vertices.size());
    hull.vertices.push_back(points[kept[i]]);
  }
  for (const FacetOutline& outline : outlines) {
    std::vector<int> loop;
    for (int i : outline.loop) loop.push_back(number[i]);
    hull.facets.push_back(FacetOf(std::move(loop), hull.vertices));
  }
  return hull;
}

// The key by which FacetsByAxis sorts. Components that differ by rounding count as equal.
std::tuple<int, bool, long, long, long> AxisKey(const Vector3& normal) {
  constexpr double kSame = 1e-6;
  int axis = 0;
  for (int i = 1; i < 3; ++i) {
    if (std::abs(normal[i]) > std::abs(normal[axis]) + kSame) axis = i;
  }
  const auto rounded = [&](int i) { return std::lround(normal[i] / kSame); };
  return {axis, normal[axis] > 0, rounded(0), rounded(1), rounded(2)};
}

// Returns the axes of a box: normals of three sides that are perpendicular to each other. Axes that
// differ from those of the frame only by rounding become exactly these axes. Returns none if the
// facets are not the sides of a box.
std::optional<Matrix3> BoxAxes(const ConvexHull& hull) {
  constexpr double kBoxAligned = 1e-9;
  if (hull.facets.size() != 6 || hull.vertices.size() != 8) return std::nullopt;
  std::vector<const Facet*> facets = FacetsByAxis(hull);
  Matrix3 axes;
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3 first = facets.front()->normal;
    const auto opposite = std::ranges::find_if(
        facets, [&](const Facet* facet) { return (facet->normal + first).norm() < kBoxAligned; });
    if (opposite == facets.end()) return std::nullopt;
    axes.col(axis) = (*opposite)->normal;
    facets.erase(opposite);
    facets.erase(facets.begin());
  }
  if (!(axes.transpose() * axes).isIdentity(kBoxAligned)) return std::nullopt;
  if (axes.determinant() < 0) axes.col(2) = -axes.col(2);
  const Matrix3 whole = axes.array().round();
  return (axes - whole).cwiseAbs().maxCoeff() < kBoxAligned ? whole : axes;
}

}  // namespace

// Qhull gives the planes of the facets. The points on each plane and their order are determined
// here with one tolerance, so that repeated and coplanar points cannot cause gaps or slivers.
// Facets are sorted by their loops, so that their order does not depend on the frame of the points.
ConvexHull HullOf(std::span<const Vector3> points) {
  Eigen::AlignedBox3d bounds;
  for (const Vector3& p : points) bounds.extend(p);
  return HullOf(points, kTolerance * bounds.diagonal().norm());
}

ConvexHull HullOf(std::span<const Vector3> points, double tolerance) {
  ASSAY_CHECK(points.size() >= 4, "{} points do not span three dimensions", points.size());
  Eigen::AlignedBox3d bounds;
  for (const Vector3& p : points) bounds.extend(p);
  const std::vector<int> kept = FirstOccurrences(points, tolerance);
  std::vector<Vector3> centered;
  for (int i : kept) centered.push_back(points[i] - bounds.center());
  ASSAY_CHECK(kept.size() >= 4, "{} points do not span three dimensions", points.size());
  std::vector<Plane> planes = QhullRun(centered).Planes();
  const std::vector<FacetOutline> outlines = DistinctOutlines(planes, centered, tolerance);
  ASSAY_CHECK(outlines.size() >= 4, "{} points do not span three dimensions", points.size());
  return Assemble(outlines, points, kept);
}

bool SpanSpace(std::span<const Vector3> points, double thinnest) {
  if (points.size() < 4) return false;
  Vector3 middle = Vector3::Zero();
  for (const Vector3& p : points) middle += p / static_cast<double>(points.size());
  Matrix3 spread = Matrix3::Zero();
  for (const Vector3& p : points) spread += (p - middle) * (p - middle).transpose();
  const Eigen::SelfAdjointEigenSolver<Matrix3> principal(spread);
  const auto along = [&](const Vector3& p) { return principal.eigenvectors().col(0).dot(p); };
  const auto [low, high] = std::ranges::minmax(points, {}, along);
  return along(high) - along(low) >= thinnest;
}

ConvexHull HullWith(std::vector<Vector3> vertices, std::vector<std::vector<int>> loops) {
  for (std::vector<int>& loop : loops) std::ranges::rotate(loop, std::ranges::min_element(loop));
  std::ranges::sort(loops);
  ConvexHull hull{.vertices = std::move(vertices), .facets = {}};
  for (std::vector<int>& loop : loops) {
    hull.facets.push_back(FacetOf(std::move(loop), hull.vertices));
  }
  return hull;
}

// Bit k of a corner's index is its side along axis k. The normals are exactly the box's axes.
ConvexHull HullOf(const Box& box) {
  const auto corners = box.Corners();
  ConvexHull hull{{corners.begin(), corners.end()}, {}};
  const auto add = [&](int axis, double sign, std::vector<int> loop) {
    const Vector3 normal = sign * box.X_FrameBox.linear().col(axis);
    hull.facets.push_back({normal, normal.dot(corners[loop.front()]), std::move(loop)});
  };
  add(1, -1, {0, 1, 5, 4});
  add(2, -1, {0, 2, 3, 1});
  add(0, -1, {0, 4, 6, 2});
  add(0, 1, {1, 3, 7, 5});
  add(1, 1, {2, 6, 7, 3});
  add(2, 1, {4, 5, 7, 6});
  return hull;
}

std::vector<ConvexHull> HullsOf(std::span<const Box> boxes) {
  std::vector<ConvexHull> hulls;
  for (const Box& box : boxes) hulls.push_back(HullOf(box));
  return hulls;
}

std::optional<Box> AsBox(const ConvexHull& hull) {
  const std::optional<Matrix3> axes = BoxAxes(hull);
  if (!axes) return std::nullopt;
  Eigen::AlignedBox3d bounds;  // along the axes
  for (const Vector3& vertex : hull.vertices) bounds.extend(axes->transpose() * vertex);
  Box box{Pose::Identity(), bounds.sizes() / 2};
  box.X_FrameBox.linear() = *axes;
  box.X_FrameBox.translation() = *axes * bounds.center();
  return box;
}

ConvexHull Transformed(const ConvexHull& hull, const Pose& X_NewFrame) {
  ConvexHull moved = hull;
  for (Vector3& vertex : moved.vertices) vertex = X_NewFrame * vertex;
  for (Facet& facet : moved.facets) {
    facet.normal = X_NewFrame.linear() * facet.normal;
    facet.offset += facet.normal.dot(X_NewFrame.translation());
  }
  return moved;
}

std::vector<ConvexHull> Transformed(std::span<const ConvexHull> hulls, const Pose& X_NewFrame) {
  std::vector<ConvexHull> moved;
  moved.reserve(hulls.size());
  for (const ConvexHull& hull : hulls) moved.push_back(Transformed(hull, X_NewFrame));
  return moved;
}

bool Contains(const ConvexHull& hull, const Vector3& p, double tolerance) {
  return std::ranges::all_of(hull.facets, [&](const Facet& facet) {
    return facet.normal.dot(p) <= facet.offset + tolerance;
  });
}

double GreatestAlong(const ConvexHull& hull, const Vector3& direction) {
  double greatest = -std::numeric_limits<double>::infinity();
  for (const Vector3& vertex : hull.vertices) greatest = std::max(greatest, direction.dot(vertex));
  return greatest;
}

double ThicknessOf(const ConvexHull& hull) {
  double least = std::numeric_limits<double>::infinity();
  for (const Facet& facet : hull.facets) {
    least = std::min(least, facet.offset + GreatestAlong(hull, -facet.normal));
  }
  return least;
}

double LowestPoint(std::span<const ConvexHull> hulls) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const ConvexHull& hull : hulls) {
    lowest = std::min(lowest, -GreatestAlong(hull, -Vector3::UnitZ()));
  }
  return lowest;
}

std::vector<Vector3> VerticesOf(std::span<const ConvexHull> hulls) {
  std::vector<Vector3> vertices;
  for (const ConvexHull& hull : hulls) {
    vertices.insert(vertices.end(), hull.vertices.begin(), hull.vertices.end());
  }
  return vertices;
}

std::vector<Vector3> EdgeDirections(const ConvexHull& hull) {
  constexpr double kParallel = 1e-9;  // sine of the angle
  std::vector<Vector3> directions;
  for (const Facet& facet : hull.facets) {
    for (std::size_t i = 0; i < facet.loop.size(); ++i) {
      const int start = facet.loop[i];
      const int end = facet.loop[(i + 1) % facet.loop.size()];
      if (start > end) continue;  // the edge belongs to another facet, too
      const Vector3 along = (hull.vertices[end] - hull.vertices[start]).normalized();
      const auto is_parallel = [&](const Vector3& known) {
        return known.cross(along).norm() < kParallel;
      };
      if (std::ranges::none_of(directions, is_parallel)) directions.push_back(along);
    }
  }
  return directions;
}

std::vector<const Facet*> FacetsByAxis(const ConvexHull& hull) {
  std::vector<const Facet*> facets;
  for (const Facet& facet : hull.facets) facets.push_back(&facet);
  std::ranges::stable_sort(facets, {}, [](const Facet* facet) { return AxisKey(facet->normal); });
  return facets;
}

Ball BallAround(std::span<const Vector3> points) {
  Eigen::AlignedBox3d bounds;
  for (const Vector3& p : points) bounds.extend(p);
  Ball ball{bounds.center(), 0};
  for (const Vector3& p : points) ball.radius = std::max(ball.radius, (p - ball.center).norm());
  return ball;
}

}  // namespace assay::geometry
