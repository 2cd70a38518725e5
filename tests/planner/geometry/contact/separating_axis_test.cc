#include "planner/geometry/contact/separating_axis.h"

#include <gtest/gtest.h>

#include "planner/geometry/pose.h"
#include "tests/planner/geometry/contact/solids.h"

namespace assay::geometry::separating_axis_test {
namespace {

constexpr double kNoMargin = 1e9;  // no facet separates by more, so that all are searched

// Returns the best axis of all, and checks that the solids have this gap along it.
double BestSeparation(const ContactSolid& a, const Pose& X_WorldA, const ContactSolid& b,
                      const Pose& X_WorldB) {
  const Pose X_AB = X_WorldA.inverse() * X_WorldB;
  const FacetAxis of_a = BestFacet(a, b, X_AB, kNoMargin);
  const FacetAxis of_b = BestFacet(b, a, X_AB.inverse(), kNoMargin);
  const EdgeAxis edges = BestEdges(a, b, X_AB);
  const Vector3 normal_a = X_WorldA.linear() * a.PlaneOf(of_a.facet).normal;
  const Vector3 normal_b = X_WorldB.linear() * b.PlaneOf(of_b.facet).normal;
  EXPECT_NEAR(GapAlong(normal_a, a, X_WorldA, b, X_WorldB), of_a.separation, 1e-9);
  EXPECT_NEAR(GapAlong(-normal_b, a, X_WorldA, b, X_WorldB), of_b.separation, 1e-9);
  if (edges.separation > -1e9) {
    const Vector3 normal = X_WorldA.linear() * edges.normal;
    EXPECT_NEAR(normal.norm(), 1, 1e-12);
    EXPECT_NEAR(GapAlong(normal, a, X_WorldA, b, X_WorldB), edges.separation, 1e-8);
  }
  return std::max({of_a.separation, of_b.separation, edges.separation});
}

// For solids that overlap, the best axis is the least overlap of all directions.
TEST(SeparatingAxis, NoDirectionHasLessOverlap) {
  RandomStream random(301, "least overlap");
  int overlaps = 0;
  for (int i = 0; i < 400; ++i) {
    const ContactSolid a = RandomSolid(random, 4 + i % 30);
    const ContactSolid b =
        i % 3 == 0 ? RegularPrism(3 + i % 20, 0.7, 0.4) : RandomSolid(random, 4 + i % 17);
    const Pose X_WorldA = oracle::RandomPose(random, 0.3);
    const Pose X_WorldB = oracle::RandomPose(random, 0.8);
    SCOPED_TRACE(testing::Message() << "pair " << i << " of seed 301");
    const double best = BestSeparation(a, X_WorldA, b, X_WorldB);
    if (best > 0) continue;
    ++overlaps;
    ASSERT_LE(GreatestGap(random, a, X_WorldA, b, X_WorldB), best + 1e-9);
  }
  EXPECT_GT(overlaps, 150);
}

// Solids are apart exactly if one of the axes separates them.
TEST(SeparatingAxis, SeparatesWhatADirectionSeparates) {
  RandomStream random(302, "separation");
  int apart = 0;
  for (int i = 0; i < 1000; ++i) {
    const ContactSolid a = RandomSolid(random, 4 + i % 12);
    const ContactSolid b = RandomSolid(random, 4 + i % 9);
    const Pose X_WorldB = oracle::RandomPose(random, 1.8);
    if (GreatestGap(random, a, Pose::Identity(), b, X_WorldB) <= 0) continue;
    ++apart;
    ASSERT_GT(BestSeparation(a, Pose::Identity(), b, X_WorldB), 0) << i;
  }
  EXPECT_GT(apart, 150);
}

TEST(SeparatingAxis, TheSearchEndsAtASeparatingFacet) {
  const ContactSolid prism = RegularPrism(64, 0.008, 0.02);
  const ContactSolid box = BoxSolid(0.01, 0.01, 0.01);
  const FacetAxis axis = BestFacet(prism, box, Translation(0.5, 0, 0), 0);
  EXPECT_GT(axis.separation, 0);
}

}  // namespace
}  // namespace assay::geometry::separating_axis_test
