#include "planner/geometry/contact/contact_solid.h"

#include <gtest/gtest.h>

#include "tests/planner/geometry/contact/solids.h"

namespace assay::geometry::contact_solid_test {
namespace {

// Euler's formula counts the edges of a convex polyhedron.
TEST(ContactSolid, HasEveryEdgeOnce) {
  RandomStream random(311, "edges");
  for (int i = 0; i < 100; ++i) {
    const ContactSolid solid =
        i % 2 == 0 ? RandomSolid(random, 4 + i) : RegularPrism(3 + i, 0.3, 0.1);
    EXPECT_EQ(solid.edges.size(), solid.hull.vertices.size() + solid.hull.facets.size() - 2);
  }
}

// At an edge, the surface turns from the left facet to the right one about the edge's direction.
TEST(ContactSolid, HasTheFacetsOfAnEdgeOnItsSides) {
  RandomStream random(312, "sides");
  for (int i = 0; i < 50; ++i) {
    const ContactSolid solid = RandomSolid(random, 4 + i);
    for (std::size_t e = 0; e < solid.edges.size(); ++e) {
      const auto& [start, end, left, right] = solid.edges[e];
      const Vector3 turn = solid.PlaneOf(left).normal.cross(solid.PlaneOf(right).normal);
      EXPECT_LT((turn.normalized() - solid.directions.row(e).transpose()).norm(), 1e-6);
      for (const int facet : {left, right}) {
        EXPECT_NEAR(solid.PlaneOf(facet).Above(solid.hull.vertices[start]), 0, 1e-9);
        EXPECT_NEAR(solid.PlaneOf(facet).Above(solid.hull.vertices[end]), 0, 1e-9);
      }
    }
  }
}

TEST(ContactSolid, HasItsMiddleInside) {
  RandomStream random(313, "middle");
  for (int i = 0; i < 50; ++i) {
    const ContactSolid solid = RandomSolid(random, 4 + i);
    EXPECT_LT(Outside(solid, Pose::Identity(), solid.middle), 0);
  }
}

// The borders of a box's facet are the planes of the four facets around it.
TEST(ContactSolid, HasBordersThatEncloseEachFacet) {
  const ContactSolid box = BoxSolid(1, 2, 3);
  for (std::size_t f = 0; f < 6; ++f) {
    ASSERT_EQ(box.borders[f].size(), 4u);
    for (const Plane& border : box.borders[f]) {
      for (const int vertex : box.hull.facets[f].loop) {
        EXPECT_LE(border.Above(box.hull.vertices[vertex]), 1e-12);
      }
      EXPECT_NEAR(border.height, std::abs(border.normal.dot(Vector3(1, 2, 3))), 1e-12);
    }
  }
}

}  // namespace
}  // namespace assay::geometry::contact_solid_test
