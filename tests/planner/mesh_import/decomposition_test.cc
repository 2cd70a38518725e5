#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/base/random.h"
#include "planner/geometry/hull.h"
#include "planner/mesh_import/decomposition/convex_decomposition.h"
#include "planner/mesh_import/decomposition/piece_distance.h"
#include "planner/mesh_import/repair/mesh_repair.h"
#include "tests/planner/mesh_import/made_mesh.h"

namespace assay::mesh_import {
namespace {

TriangleMesh BodyOf(const TriangleMesh& mesh) { return Repair(mesh).bodies.at(0); }

// An L is two boxes, and a plus is three.
TEST(ConvexDecomposition, PolyhedraAreDecomposedExactly) {
  const Curve l = {{0, 0}, {30, 0}, {30, 10}, {10, 10}, {10, 30}, {0, 30}};
  const Curve plus = {{10, 0},  {20, 0},  {20, 10}, {30, 10}, {30, 20}, {20, 20},
                      {20, 30}, {10, 30}, {10, 20}, {0, 20},  {0, 10},  {10, 10}};
  for (const auto& [curve, pieces] : {std::pair(l, 2u), {plus, 3u}}) {
    const Decomposition found = Decompose(BodyOf(Extruded(curve, 8)), {.depth = 0.01});
    EXPECT_EQ(found.pieces.size(), pieces);
    EXPECT_NEAR(found.volume_share, 0, 1e-6);
    EXPECT_LT(found.distance, 1e-6);
  }
}

// All pieces together cover the body, and its surface is not deep in them.
TEST(ConvexDecomposition, CoversARing) {
  const TriangleMesh ring = BodyOf(Extruded(CircleOf(20, 24), 8, {CircleOf(14, 24)}));
  const Decomposition found = Decompose(ring, {.depth = 0.5});
  EXPECT_GT(found.pieces.size(), 5u);
  EXPECT_LE(found.pieces.size(), 32u);
  EXPECT_LT(found.distance, 0.6);
  RandomStream random(2, "ring");
  int inside = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const Vector3 p(random.Uniform(-20, 20), random.Uniform(-20, 20), random.Uniform(0, 8));
    if (!IsInside(ring, p)) continue;
    ++inside;
    double depth = -1;
    for (const geometry::ConvexHull& piece : found.pieces)
      depth = std::max(depth, DepthIn(piece, p));
    EXPECT_GT(depth, -1e-6);
  }
  EXPECT_GT(inside, 500);
}

// The faces of cuts are inside of the body, also where they have the coordinates of its corners.
TEST(ConvexDecomposition, RingsWithRegularCoordinates) {
  const TriangleMesh ring = BodyOf(Extruded(RectangleOf(40, 40), 20, {RectangleOf(20, 20)}));
  const Decomposition found = Decompose(ring, {.depth = 0.5});
  EXPECT_LE(found.pieces.size(), 8u);
  EXPECT_NEAR(found.volume_share, 0, 1e-6);
  EXPECT_LT(found.distance, 1e-6);
}

TEST(ConvexDecomposition, FlatPointsHaveNoHull) {
  const std::vector<Vector3> flat = {{0, 0, 0}, {1, 0, 1}, {0, 1, 1}, {1, 1, 2}, {0.5, 0.5, 1}};
  EXPECT_FALSE(HullOfExtremes(flat, 100));
  const std::vector<Vector3> line = {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}};
  EXPECT_FALSE(HullOfExtremes(line, 100));
  EXPECT_FALSE(HullOfExtremes(std::vector<Vector3>(5, Vector3(1, 2, 3)), 100));
}

}  // namespace
}  // namespace assay::mesh_import
