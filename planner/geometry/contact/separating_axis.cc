#include "planner/geometry/contact/separating_axis.h"

#include <Eigen/Core>

namespace assay::geometry {
namespace {

constexpr double kParallel = 1e-6;  // sine of the angle between edges that count as parallel

double SeparationAlong(const Plane& plane, const ContactSolid& other, const Pose& X_OfOther) {
  const Vector3 n = X_OfOther.linear().transpose() * plane.normal;
  const ContactSolid::Rows& p = other.vertices;
  const double lowest = (n.x() * p.col(0) + n.y() * p.col(1) + n.z() * p.col(2)).minCoeff();
  return lowest + plane.Above(X_OfOther.translation());
}

// The components of the normals of one solid's facets along the edges of the other. Facets have
// rows, and edges have columns.
struct Components {
  Eigen::MatrixXd of_a;
  Eigen::MatrixXd of_b;
};

// Returns whether the ranges of the normals of two edges cross: the ends of each arc are on both
// sides of the other, and the arcs are not on opposite sides of the sphere.
bool ArcsCross(const Components& components, const ContactSolid& a, int edge_of_a,
               const ContactSolid& b, int edge_of_b) {
  const double left_a = components.of_a(a.edges[edge_of_a].left, edge_of_b);
  const double right_a = components.of_a(a.edges[edge_of_a].right, edge_of_b);
  if (left_a * right_a >= 0) return false;
  const double left_b = components.of_b(b.edges[edge_of_b].left, edge_of_a);
  const double right_b = components.of_b(b.edges[edge_of_b].right, edge_of_a);
  return left_b * right_b < 0 && left_b * right_a < 0;
}

}  // namespace

FacetAxis BestFacet(const ContactSolid& of, const ContactSolid& other, const Pose& X_OfOther,
                    double enough) {
  const Vector3 middle = X_OfOther * other.middle;
  Eigen::VectorXd heights = of.normals * middle;  // bounds of the separations
  for (Eigen::Index f = 0; f < heights.size(); ++f) heights[f] -= of.hull.facets[f].offset;
  Eigen::Index highest = 0;
  heights.maxCoeff(&highest);
  const int first = static_cast<int>(highest);  // mostly the best
  FacetAxis best{SeparationAlong(of.PlaneOf(first), other, X_OfOther), first};
  for (int f = 0; f < heights.size() && best.separation <= enough; ++f) {
    if (f == first || heights[f] <= best.separation) continue;
    const double separation = SeparationAlong(of.PlaneOf(f), other, X_OfOther);
    if (separation > best.separation) best = {separation, f};
  }
  return best;
}

EdgeAxis BestEdges(const ContactSolid& a, const ContactSolid& b, const Pose& X_AB) {
  const ContactSolid::Rows along_b = b.directions * X_AB.linear().transpose();
  const Components components{
      .of_a = a.normals * along_b.transpose(),
      .of_b = b.normals * X_AB.linear().transpose() * a.directions.transpose()};
  EdgeAxis best;
  for (int j = 0; j < static_cast<int>(b.edges.size()); ++j) {
    const Vector3 point_b = X_AB * b.hull.vertices[b.edges[j].start];
    for (int i = 0; i < static_cast<int>(a.edges.size()); ++i) {
      if (!ArcsCross(components, a, i, b, j)) continue;
      Vector3 normal = Vector3(a.directions.row(i)).cross(Vector3(along_b.row(j)));
      const double sine = normal.norm();
      if (sine < kParallel) continue;
      const auto& [start, end, left, right] = a.edges[i];
      const Vector3 outward = a.normals.row(left) + a.normals.row(right);
      normal /= normal.dot(outward) > 0 ? sine : -sine;
      const double separation = normal.dot(point_b - a.hull.vertices[start]);
      if (separation > best.separation) best = {separation, normal, i, j};
    }
  }
  return best;
}

}  // namespace assay::geometry
