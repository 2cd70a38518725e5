#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "planner/base/random.h"
#include "planner/geometry/ring.h"
#include "planner/mesh_import/meshes/nearest_surface.h"
#include "planner/mesh_import/meshes/plane_cut.h"
#include "planner/mesh_import/repair/weld.h"
#include "tests/planner/mesh_import/made_mesh.h"

namespace assay::mesh_import {
namespace {

TriangleMesh Welded(TriangleMesh mesh) {
  Weld(mesh, 1e-6);
  return mesh;
}

// Both parts of a cut are closed, and their volumes add up to the whole.
TEST(PlaneCut, PartsAddUp) {
  const std::vector<TriangleMesh> meshes = {
      Welded(ChamferedPeg(8, 50, 0.5, 40)),
      Welded(Extruded(RectangleOf(25, 25), 9, {CircleOf(8, 36), RectangleOf(2, 2, {10.5, 10.5})})),
      Welded(FootWithStem(RectangleOf(30, 20), RectangleOf(10, 10), 10, 40))};
  RandomStream random(3, "cuts");
  for (int trial = 0; trial < 300; ++trial) {
    const TriangleMesh& mesh = meshes[static_cast<std::size_t>(trial) % meshes.size()];
    // Some planes hold facets.
    const Vector3 normal = trial % 4 == 0 ? Vector3(Vector3::Unit(random.Index(3)))
                                          : Vector3(random.Uniform(-1, 1), random.Uniform(-1, 1),
                                                    random.Uniform(-1, 1))
                                                .normalized();
    const Vector3& through = mesh.vertices[static_cast<std::size_t>(
        random.Index(static_cast<int>(mesh.vertices.size())))];
    const auto [below, above] =
        CutBy(mesh, {.normal = normal, .height = normal.dot(through), .tolerance = 1e-6});
    EXPECT_NEAR(below.Volume() + above.Volume(), mesh.Volume(), 1e-3) << trial;
    EXPECT_GE(below.Volume(), -1e-3);
    EXPECT_GE(above.Volume(), -1e-3);
    for (const TriangleMesh* part : {&below, &above}) {
      Vector3 closing = Vector3::Zero();  // the area vectors of a closed surface cancel
      for (const Triangle& triangle : part->triangles) closing += part->AreaVector(triangle);
      EXPECT_LT(closing.norm(), 1e-2) << trial;
    }
  }
}

TEST(PlaneCut, SectionKeepsTheInsideToItsLeft) {
  const TriangleMesh mesh = Welded(Extruded(RectangleOf(25, 25), 9, {RectangleOf(10, 8)}));
  const Section section =
      SectionOf(mesh, {.normal = Vector3::UnitZ(), .height = 4, .tolerance = 0});
  ASSERT_EQ(section.loops.size(), 2u);
  std::vector<double> areas;
  for (const geometry::Loop& loop : section.loops) {
    std::vector<Vector2> curve;
    for (const int i : loop) curve.push_back(section.points[static_cast<std::size_t>(i)].head<2>());
    areas.push_back(geometry::SignedArea(curve));
  }
  std::ranges::sort(areas);
  EXPECT_NEAR(areas[0], -80, 1e-9);
  EXPECT_NEAR(areas[1], 625, 1e-9);
}

// The tree finds the same distance as a search through all triangles. For a box this distance is
// also known.
TEST(NearestSurface, KnowsTheDistanceOfABox) {
  const TriangleMesh mesh = Extruded(RectangleOf(4, 6), 10);
  const NearestSurface surface(mesh);
  RandomStream random(5, "nearest");
  const Eigen::AlignedBox3d box(Vector3(-2, -3, 0), Vector3(2, 3, 10));
  for (int trial = 0; trial < 500; ++trial) {
    const Vector3 p(random.Uniform(-5, 5), random.Uniform(-6, 6), random.Uniform(-3, 13));
    const double inside = std::min((p - box.min()).minCoeff(), (box.max() - p).minCoeff());
    const double expected = box.contains(p) ? inside : box.exteriorDistance(p);
    EXPECT_NEAR(surface.To(p).distance, expected, 1e-12);
  }
}

}  // namespace
}  // namespace assay::mesh_import
