#pragma once

#include <span>
#include <vector>

#include "planner/mesh_import/meshes/triangle_mesh.h"

namespace assay::mesh_import {

// An edge of one triangle, between the vertices low < high.
struct EdgeUse {
  int low = 0;
  int high = 0;
  int triangle = 0;
  int opposite = 0;         // the third vertex of the triangle
  bool is_forward = false;  // whether the triangle runs from low to high
};

// Returns the edges of all triangles, sorted so that the uses of one edge are neighbours, in the
// order of the triangles.
std::vector<EdgeUse> EdgeUsesOf(const TriangleMesh& mesh);

// Calls `visit` with the uses of each edge.
template <class Visit>
void ForEachEdge(std::span<const EdgeUse> uses, const Visit& visit) {
  for (std::size_t begin = 0; begin < uses.size();) {
    std::size_t end = begin + 1;
    while (end < uses.size() && uses[end].low == uses[begin].low &&
           uses[end].high == uses[begin].high)
      ++end;
    visit(uses.subspan(begin, end - begin));
    begin = end;
  }
}

// Returns how much more often an edge is run forward than backward; 0 where a mesh is closed.
int Excess(std::span<const EdgeUse> uses);

}  // namespace assay::mesh_import
