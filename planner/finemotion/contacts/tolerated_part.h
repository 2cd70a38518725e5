#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "planner/finemotion/contacts/extent.h"
#include "planner/finemotion/contacts/face_regions.h"
#include "planner/finemotion/contacts/primitive_contact.h"

namespace assay::finemotion {

// A part's outer features in its own axes, and how the model's tolerances displace each of them.
struct ToleratedPart {
  // The displacement of a feature for one metre of each tolerance: a column for each tolerance
  // (Shift), or the distance along a given direction (ShiftAlong).
  using Shift = Eigen::Matrix3Xd;
  using ShiftAlong = Eigen::VectorXd;

  // An edge, and how the tolerances displace it.
  struct Edge {
    Vector3 start = Vector3::Zero();
    Vector3 direction = Vector3::Zero();
    double length = 0;
    std::array<Vector3, 2> into{};
    std::array<Vector3, 2> normals{};      // outward normals of the edge's two faces
    bool is_round = false;                 // no contact of its own (Polyhedron)
    Shift shift;                           // shift of the edge's line, across its direction
    std::array<ShiftAlong, 2> end_shifts;  // shifts of start and end, along the edge

    Vector3 Bisector() const { return (normals[0] + normals[1]).normalized(); }
    Shift EndShift(std::size_t which) const {
      return shift + direction * end_shifts[which].transpose();
    }
  };

  struct Vertex {
    Vector3 p = Vector3::Zero();
    std::vector<Vector3> leaving;  // directions of the edges that leave the vertex
    bool is_round = false;         // no contact of its own (Polyhedron)
    Shift shift;
  };

  struct Region {
    FaceRegion sides;
    std::vector<ShiftAlong> shifts;  // shift of each side, outward
  };

  struct Face {
    Vector3 normal = Vector3::Zero();
    double height = 0;
    ShiftAlong shift;  // shift of the plane, outward
    std::vector<Region> regions;
    Extent extent;
  };

  // The sign of d and w in this part's motion relative to the other part: 1 for the moving part, -1
  // for the stationary one.
  double sign = 1;
  std::vector<Face> faces;
  std::vector<Edge> edges;
  std::vector<Vertex> vertices;
  Extent extent;

  ToleratedPart(const Polyhedron& shape, ModelTolerance::Of of,
                const std::vector<ModelTolerance>& tolerances);
};

}  // namespace assay::finemotion
