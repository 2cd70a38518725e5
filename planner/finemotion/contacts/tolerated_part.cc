#include "planner/finemotion/contacts/tolerated_part.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "planner/base/check.h"
#include "planner/numeric/orthogonal_decomposition.h"

namespace assay::finemotion {

namespace {

using Index = std::size_t;
using Edge = ToleratedPart::Edge;
using Face = ToleratedPart::Face;
using Region = ToleratedPart::Region;
using Shift = ToleratedPart::Shift;
using Vertex = ToleratedPart::Vertex;

// Returns the unit direction that leads from the edge into face edge.faces[which], perpendicular to
// the edge. It can be computed from the normals, since each face of a convex edge lies behind the
// other one's plane.
Vector3 IntoFace(const Polyhedron& shape, const OuterEdge& edge, Index which) {
  const Vector3& own = shape.faces[static_cast<Index>(edge.faces[which])].normal;
  const Vector3& other = shape.faces[static_cast<Index>(edge.faces[1 - which])].normal;
  return (other.dot(own) * own - other).normalized();
}

// Computes how the tolerances displace a part's features.
class Shifts {
 public:
  Shifts(const Polyhedron& shape, ModelTolerance::Of of,
         const std::vector<ModelTolerance>& tolerances)
      : shape_(shape), tolerances_(tolerances), of_(of) {
    for (const OuterFace& face : shape.faces) {
      regions_.push_back(tolerances.empty() ? std::vector<FaceRegion>() : ConvexRegions(face));
    }
    for (const ModelTolerance& tolerance : tolerances) {
      if (tolerance.of != of) continue;
      for (const int face : tolerance.faces) {
        ASSAY_CHECK(face >= 0 && static_cast<Index>(face) < shape.faces.size(), "{}: no face {}",
                    tolerance.name, face);
      }
    }
  }

  // Returns the shift of a corner, or of a point of an edge or face.
  Shift At(const Vector3& p) const {
    return Of(tolerances_.empty() ? std::vector<int>() : FacesThrough(p));
  }

  // Returns the shift of the point, line or plane where these faces' planes meet. It is the least
  // motion that keeps the feature in all of the planes. If more than three planes meet, their
  // displacements may separate them. The shift then keeps the feature nearest to all of them.
  Shift Of(const std::vector<int>& faces) const {
    Shift shift = Shift::Zero(3, std::ssize(tolerances_));
    if (tolerances_.empty()) return shift;
    Eigen::MatrixXd normals(faces.size(), 3);
    Eigen::MatrixXd outward = Eigen::MatrixXd::Zero(normals.rows(), shift.cols());
    for (Eigen::Index row = 0; row < normals.rows(); ++row) {
      const int face = faces[static_cast<Index>(row)];
      normals.row(row) = shape_.faces[static_cast<Index>(face)].normal;
      for (Eigen::Index column = 0; column < shift.cols(); ++column) {
        const ModelTolerance& tolerance = tolerances_[static_cast<Index>(column)];
        if (tolerance.of != of_) continue;
        outward(row, column) = std::ranges::count(tolerance.faces, face) > 0 ? 1 : 0;
      }
    }
    return numeric::ShortestLeastSquares(normals, outward, kSameDirection);
  }

 private:
  std::vector<int> FacesThrough(const Vector3& p) const {
    std::vector<int> faces;
    for (Index i = 0; i < shape_.faces.size(); ++i) {
      const OuterFace& face = shape_.faces[i];
      if (std::abs(face.normal.dot(p) - face.height) > kSamePoint) continue;
      const auto touches = [&](const FaceRegion& region) {
        return DistanceTo(region, p) < kSamePoint;
      };
      if (std::ranges::any_of(regions_[i], touches)) faces.push_back(static_cast<int>(i));
    }
    return faces;
  }

  const Polyhedron& shape_;
  const std::vector<ModelTolerance>& tolerances_;
  ModelTolerance::Of of_;
  std::vector<std::vector<FaceRegion>> regions_;
};

Face MakeFace(const OuterFace& face, int index, const Shifts& shifts) {
  Face made{.normal = face.normal, .height = face.height, .shift = {}, .regions = {}, .extent = {}};
  made.shift = shifts.Of({index}).transpose() * face.normal;
  for (FaceRegion& sides : ConvexRegions(face)) {
    Region region{std::move(sides), {}};
    for (const RegionSide& side : region.sides) {
      region.shifts.emplace_back(shifts.At(side.middle()).transpose() * side.outward);
      if (!face.is_round) made.extent.Add(side.start);
    }
    made.regions.push_back(std::move(region));
  }
  return made;
}

Edge MakeEdge(const OuterEdge& edge, const Polyhedron& shape, const Shifts& shifts) {
  Edge made{.start = edge.start,
            .direction = edge.direction(),
            .length = (edge.end - edge.start).norm(),
            .is_round = edge.is_round,
            .shift = shifts.Of({edge.faces[0], edge.faces[1]}),
            .end_shifts = {}};
  for (const Index which : {0U, 1U}) {
    made.into[which] = IntoFace(shape, edge, which);
    made.normals[which] = shape.faces[static_cast<Index>(edge.faces[which])].normal;
    const Vector3& end = which == 0 ? edge.start : edge.end;
    made.end_shifts[which] = shifts.At(end).transpose() * made.direction;
  }
  return made;
}

Vertex MakeVertex(const OuterVertex& vertex, const Polyhedron& shape, const Shifts& shifts) {
  Vertex made{
      .p = vertex.p, .leaving = {}, .is_round = vertex.is_round, .shift = shifts.At(vertex.p)};
  for (const int index : vertex.edges) {
    const OuterEdge& edge = shape.edges[static_cast<Index>(index)];
    const bool from_start =
        (edge.start - vertex.p).squaredNorm() < (edge.end - vertex.p).squaredNorm();
    made.leaving.push_back(from_start ? edge.direction() : Vector3(-edge.direction()));
  }
  return made;
}

}  // namespace

ToleratedPart::ToleratedPart(const Polyhedron& shape, ModelTolerance::Of of,
                             const std::vector<ModelTolerance>& tolerances)
    : sign(of == ModelTolerance::Of::kMovingFaces ? 1 : -1) {
  const Shifts shifts(shape, of, tolerances);
  for (Index i = 0; i < shape.faces.size(); ++i) {
    faces.push_back(MakeFace(shape.faces[i], static_cast<int>(i), shifts));
    if (shape.faces[i].is_round) continue;
    extent.Add(faces.back().extent.low);
    extent.Add(faces.back().extent.high);
  }
  for (const OuterEdge& edge : shape.edges) edges.push_back(MakeEdge(edge, shape, shifts));
  for (const OuterVertex& vertex : shape.vertices)
    vertices.push_back(MakeVertex(vertex, shape, shifts));
}

}  // namespace assay::finemotion
