#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "planner/finemotion/contacts/extent.h"
#include "planner/finemotion/contacts/face_regions.h"
#include "planner/finemotion/contacts/primitive_contact.h"

namespace assay::finemotion {

// A part's outer features in its own axes, and how the model's tolerances displace them.
struct ToleratedPart {
  // How a feature moves for one metre of each tolerance, a column for each; or how far along a
  // direction.
  using Shift = Eigen::Matrix3Xd;
  using ShiftAlong = Eigen::VectorXd;

  // An edge and what the tolerances do to it.
  struct Edge {
    Vector3 start = Vector3::Zero();
    Vector3 direction = Vector3::Zero();
    double length = 0;
    std::array<Vector3, 2> into{};
    std::array<Vector3, 2> normals{};      // of the faces
    Shift shift;                           // of the line, across its direction
    std::array<ShiftAlong, 2> end_shifts;  // of start and end, along it

    Vector3 Bisector() const { return (normals[0] + normals[1]).normalized(); }
    Shift EndShift(std::size_t which) const {
      return shift + direction * end_shifts[which].transpose();
    }
  };

  struct Vertex {
    Vector3 p = Vector3::Zero();
    std::vector<Vector3> leaving;  // directions of its edges
    Shift shift;
  };

  struct Region {
    FaceRegion sides;
    std::vector<ShiftAlong> shifts;  // of each, outward
  };

  struct Face {
    Vector3 normal = Vector3::Zero();
    double height = 0;
    ShiftAlong shift;  // outward
    std::vector<Region> regions;
    Extent extent;
  };

  double sign = 1;  // of (d, w) in the motion relative to the other part: 1 moving, -1 stationary
  std::vector<Face> faces;
  std::vector<Edge> edges;
  std::vector<Vertex> vertices;
  Extent extent;

  ToleratedPart(const Polyhedron& shape, ModelTolerance::Of of,
                const std::vector<ModelTolerance>& tolerances);
};

}  // namespace assay::finemotion
