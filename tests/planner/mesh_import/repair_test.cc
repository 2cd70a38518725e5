#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "planner/base/input_files/input_error.h"
#include "planner/base/random.h"
#include "planner/mesh_import/repair/mesh_repair.h"
#include "tests/planner/mesh_import/made_mesh.h"

namespace assay::mesh_import {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string MessageOfRepair(const TriangleMesh& mesh) {
  try {
    Repair(mesh);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

void TurnOver(Triangle& triangle) { std::swap(triangle.corners[1], triangle.corners[2]); }

TEST(MeshRepair, LeavesAGoodMeshAlone) {
  const TriangleMesh made = ChamferedPeg(8, 50, 0.5, 24);
  const RepairedMesh repaired = Repair(made);
  EXPECT_THAT(repaired.repairs, IsEmpty());
  ASSERT_EQ(repaired.bodies.size(), 1u);
  EXPECT_NEAR(repaired.bodies[0].Volume(), made.Volume(), 1e-9);
  EXPECT_EQ(repaired.bodies[0].triangles.size(), made.triangles.size());
}

// The repair gives the same volume, whichever triangles are turned over.
TEST(MeshRepair, OrientsOutward) {
  const TriangleMesh made = Extruded(RectangleOf(25, 25), 9, {CircleOf(8, 24)});
  RandomStream random(11, "turned over");
  for (int trial = 0; trial < 20; ++trial) {
    TriangleMesh turned = made;
    for (Triangle& triangle : turned.triangles) {
      if (random.Index(20) < trial) TurnOver(triangle);
    }
    EXPECT_NEAR(Repair(turned).bodies.at(0).Volume(), made.Volume(), 1e-9) << trial;
  }
}

TEST(MeshRepair, ClosesPlanarOpenings) {
  TriangleMesh open = Extruded(RectangleOf(10, 10), 5);
  const double volume = open.Volume();
  std::erase_if(open.triangles, [&](const Triangle& t) { return open.AreaVector(t).z() > 0; });
  const RepairedMesh repaired = Repair(open);
  EXPECT_NEAR(repaired.bodies.at(0).Volume(), volume, 1e-9);
  EXPECT_THAT(repaired.repairs, Contains(HasSubstr("1 planar openings were closed.")));
}

// Where the whole flat end of a tube is missing, the bore stays open.
TEST(MeshRepair, ClosesTheEndOfATube) {
  TriangleMesh open = Extruded(CircleOf(10, 24), 5, {CircleOf(6, 24)});
  const double volume = open.Volume();
  std::erase_if(open.triangles, [&](const Triangle& t) { return open.AreaVector(t).z() > 1e-9; });
  const RepairedMesh repaired = Repair(open);
  EXPECT_NEAR(repaired.bodies.at(0).Volume(), volume, 1e-9);
  for (const Triangle& triangle : repaired.bodies[0].triangles) {
    const Vector3 middle = repaired.bodies[0].Centroid(triangle);
    EXPECT_GT(middle.head<2>().norm(), 5.9);
  }
}

TEST(MeshRepair, RefusesOtherOpeningsAtATriangle) {
  TriangleMesh open = Extruded(RectangleOf(10, 10), 5);
  // Two neighbours at right angles are missing.
  std::erase_if(open.triangles, [&](const Triangle& t) {
    const Vector3 middle = open.Centroid(t);
    return open.AreaVector(t).z() > 0 || middle.x() > 4.9;
  });
  EXPECT_THAT(MessageOfRepair(open), HasSubstr("triangle "));
  EXPECT_THAT(MessageOfRepair(open), HasSubstr("the opening is not planar"));
}

// A long edge beside short ones leaves slits without area.
TEST(MeshRepair, ClosesSlits) {
  TriangleMesh mesh = Extruded(RectangleOf(10, 10), 5);
  const double volume = mesh.Volume();
  Triangle& first = mesh.triangles.front();
  const int middle = static_cast<int>(mesh.vertices.size());
  const Vector3 half = (mesh.Corner(first, 0) + mesh.Corner(first, 1)) / 2;
  mesh.vertices.push_back(half);
  Triangle second = first;
  first.corners[1] = middle;
  second.corners[0] = middle;
  mesh.triangles.push_back(second);
  const RepairedMesh repaired = Repair(mesh);
  EXPECT_NEAR(repaired.bodies.at(0).Volume(), volume, 1e-9);
}

TEST(MeshRepair, SeparatesBodiesThatTouch) {
  TriangleMesh mesh = Extruded(RectangleOf(10, 10), 5);
  Append(mesh, Extruded(RectangleOf(10, 10), 5), {10, 0, 0});  // shares a face
  Append(mesh, Extruded(RectangleOf(10, 10), 7), {0, 10, 0});  // shares an edge
  const RepairedMesh repaired = Repair(mesh);
  ASSERT_EQ(repaired.bodies.size(), 3u);
  EXPECT_NEAR(repaired.bodies[0].Volume(), 700, 1e-9);
  EXPECT_NEAR(repaired.bodies[1].Volume(), 500, 1e-9);
  EXPECT_NEAR(repaired.bodies[2].Volume(), 500, 1e-9);
}

TEST(MeshRepair, RefusesAHollow) {
  TriangleMesh mesh = Extruded(RectangleOf(10, 10), 10);
  TriangleMesh inside = Extruded(RectangleOf(4, 4), 4);
  for (Triangle& triangle : inside.triangles) TurnOver(triangle);
  Append(mesh, inside, {0, 0, 3});
  EXPECT_THAT(MessageOfRepair(mesh), HasSubstr("closed hollow"));
}

TEST(MeshRepair, RefusesASurfaceWithOneSide) {
  TriangleMesh strip;
  constexpr int kCount = 12;
  for (int i = 0; i < kCount; ++i) {
    const double turn = 2 * std::numbers::pi * i / kCount;
    for (const double across : {-1.0, 1.0}) {
      const double radius = 5 + across * std::cos(turn / 2);
      strip.vertices.emplace_back(radius * std::cos(turn), radius * std::sin(turn),
                                  across * std::sin(turn / 2));
    }
  }
  for (int i = 0; i < kCount; ++i) {
    const int a = 2 * i;
    const int next = 2 * ((i + 1) % kCount);
    const bool crosses = i + 1 == kCount;
    const int c = crosses ? next + 1 : next;
    const int d = crosses ? next : next + 1;
    strip.triangles.push_back({.corners = {a, c, a + 1}, .number = 2 * i + 1});
    strip.triangles.push_back({.corners = {a + 1, c, d}, .number = 2 * i + 2});
  }
  EXPECT_THAT(MessageOfRepair(strip), HasSubstr("only one side"));
}

TEST(MeshRepair, RefusesFlatBodies) {
  TriangleMesh flat = Extruded(RectangleOf(10, 10), 5);
  for (Vector3& vertex : flat.vertices) vertex.z() = vertex.x();
  EXPECT_NE(MessageOfRepair(flat), "no error");
}

}  // namespace
}  // namespace assay::mesh_import
