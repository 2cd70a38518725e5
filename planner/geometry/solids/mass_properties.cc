#include "planner/geometry/solids/mass_properties.h"

#include "planner/base/check.h"
#include "planner/geometry/hull.h"
#include "planner/geometry/solids/convex_cut.h"

namespace assay::geometry {
namespace {

// Volume and its first two moments about a point.
struct Moments {
  double volume = 0;
  Vector3 first = Vector3::Zero();
  Matrix3 second = Matrix3::Zero();

  // Adds the tetrahedron between the point and a triangle.
  void Add(const Vector3& a, const Vector3& b, const Vector3& c) {
    const double own = a.dot(b.cross(c)) / 6;
    const Vector3 sum = a + b + c;
    volume += own;
    first += own / 4 * sum;
    second += own / 20 *
              (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
  }

  void Add(const ConvexHull& solid, const Vector3& about) {
    for (const Facet& facet : solid.facets) {
      const auto at = [&](std::size_t i) -> Vector3 {
        return solid.vertices[facet.loop[i]] - about;
      };
      for (std::size_t i = 2; i < facet.loop.size(); ++i) Add(at(0), at(i - 1), at(i));
    }
  }
};

}  // namespace

double Volume(const ConvexHull& solid) {
  Moments moments;
  moments.Add(solid, solid.vertices.front());
  return moments.volume;
}

MassProperties MassOf(std::span<const ConvexHull> solids, double density) {
  ASSAY_CHECK(density > 0);
  if (solids.empty()) return {};
  const Vector3 about = solids.front().vertices.front();
  Moments moments;
  for (const ConvexHull& piece : Disjoint(solids)) moments.Add(piece, about);
  MassProperties mass;
  mass.mass = density * moments.volume;
  const Vector3 center = moments.first / moments.volume;
  mass.center = about + center;
  const Matrix3 spread = density * (moments.second - moments.volume * center * center.transpose());
  mass.inertia = spread.trace() * Matrix3::Identity() - spread;
  return mass;
}

}  // namespace assay::geometry
