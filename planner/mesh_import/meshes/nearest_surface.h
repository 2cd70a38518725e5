#pragma once

#include <vector>

#include "planner/mesh_import/meshes/triangle_mesh.h"

namespace assay::mesh_import {

// Finds the distance of points from the triangles of a mesh, by a tree of bounding boxes.
class NearestSurface {
 public:
  explicit NearestSurface(
      const TriangleMesh& mesh);  // with at least one triangle; it must outlive this

  struct Nearest {
    double distance = 0;  // metres
    int triangle = 0;     // index in the mesh
  };
  Nearest To(const Vector3& p) const;

 private:
  struct Node {
    Eigen::AlignedBox3d bounds;
    int begin = 0;  // of the triangles in order_, of a leaf
    int end = 0;
    int left = -1;  // -1 for a leaf
    int right = -1;
  };
  int Build(int begin, int end);
  void Search(int node, const Vector3& p, Nearest& nearest) const;

  const TriangleMesh& mesh_;
  std::vector<int> order_;
  std::vector<Vector3> centroids_;
  std::vector<Node> nodes_;
};

}  // namespace assay::mesh_import
