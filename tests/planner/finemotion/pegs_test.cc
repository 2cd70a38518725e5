#include "bench/workloads/pegs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "planner/finemotion/contact_graph/critical_points.h"
#include "planner/finemotion/contacts/contact_finder.h"
#include "planner/geometry/pose.h"

namespace assay::finemotion::pegs_test {
namespace {

constexpr double kHalf = 0.019;
constexpr double kPlay = 0.25e-3;

class Pegs : public ::testing::TestWithParam<int> {
 protected:
  Passage MakePassage(double play) const {
    return workloads::PegInHole({.sides = GetParam(), .half = kHalf, .length = 0.07}, play);
  }
};

TEST_P(Pegs, APegIsAPrism) {
  const auto n = static_cast<std::size_t>(GetParam());
  const Polyhedron peg = MakePassage(kPlay).moving;
  EXPECT_EQ(peg.faces.size(), n + 2);
  EXPECT_EQ(peg.edges.size(), 3 * n);
  EXPECT_EQ(peg.vertices.size(), 2 * n);
}

// The walls of the hole are outside the sides of the peg by the play. The hole has a convex edge at
// the rim of each wall, beside the edges on the outside of the block.
TEST_P(Pegs, AHoleIsWiderByThePlay) {
  const auto n = static_cast<std::size_t>(GetParam());
  const Polyhedron block = MakePassage(kPlay).stationary;
  const auto is_wall = [](const OuterFace& face) {
    return std::abs(face.normal.z()) < 0.5 && face.height < 0;
  };
  EXPECT_EQ(std::ranges::count_if(block.faces, is_wall), GetParam());
  for (const OuterFace& face : block.faces) {
    if (!is_wall(face)) continue;
    EXPECT_NEAR(face.height, -(kHalf + kPlay), 1e-9);
  }
  EXPECT_EQ(block.edges.size(), 2 * n + 3 * n);  // the rims above and below, and the outside
  EXPECT_EQ(block.vertices.size(), 2 * n);
}

// Over the hole, the distance of each side of the peg from its wall is the play.
TEST_P(Pegs, FitsWithItsPlay) {
  const Passage passage = MakePassage(kPlay);
  Pose in = passage.X_StationaryEntry;
  in.translation() += 0.01 * passage.mating;
  int sides = 0;
  for (const PrimitiveContact& contact :
       ContactFinder(passage.moving, passage.stationary).Near(in, {.reach = 0.001, .turn = 0})) {
    if (contact.kind != ContactKind::kVertexFace) continue;
    EXPECT_NEAR(contact.offset, kPlay, 1e-9);
    ++sides;
  }
  EXPECT_EQ(sides, 2 * GetParam());  // each lower corner touches two walls
}

// Without play the sides of the peg slide on the walls as soon as it is in.
TEST_P(Pegs, TouchesAllWallsWithoutPlay) {
  const Passage passage = MakePassage(0);
  const auto points = CriticalPoints(passage.moving, passage.stationary,
                                     geometry::Translation(0, 0, -0.03), 0.04 * passage.mating);
  ASSERT_FALSE(points.empty());
  EXPECT_NEAR(points.front().travel, 0.01, 1e-9);
  const auto is_side = [&](const TouchingFaces& touching) {
    const auto& face = passage.moving.faces[static_cast<std::size_t>(touching.moving)];
    return std::abs(face.normal.z()) < 0.5;
  };
  EXPECT_EQ(std::ranges::count_if(points.front().after, is_side), GetParam());
}

INSTANTIATE_TEST_SUITE_P(Sides, Pegs, ::testing::Values(4, 6, 8, 12, 16));

// Both generators make the same piece.
TEST(Pieces, ABoxIsASquarePrism) {
  const Polyhedron prism =
      OutsideOf({workloads::PrismPiece({.sides = 4, .half = kHalf, .length = 0.07})});
  const Polyhedron box = workloads::BoxShape({-kHalf, -kHalf, 0}, {kHalf, kHalf, 0.07});
  ASSERT_EQ(prism.vertices.size(), box.vertices.size());
  for (const OuterVertex& corner : box.vertices) {
    EXPECT_TRUE(std::ranges::any_of(prism.vertices, [&](const OuterVertex& other) {
      return (other.p - corner.p).norm() < 1e-9;
    }));
  }
}

}  // namespace
}  // namespace assay::finemotion::pegs_test
