#include "planner/geometry/solids/point_distance.h"

#include <gtest/gtest.h>

#include "planner/geometry/hull.h"
#include "tests/oracle/box_pair.h"
#include "tests/oracle/random_pose.h"

namespace assay::geometry::point_distance_test {
namespace {

constexpr std::uint64_t kSeed = 12;

TEST(PointDistance, OfBoxesHasTheClosedForm) {
  RandomStream random(kSeed, "point distance");
  int outside = 0;
  for (int i = 0; i < 2000; ++i) {
    const Box box = oracle::RandomBox(random, 0.5, 0.05, 0.5);
    const Vector3 p = oracle::RandomVector(random, 1);
    const double distance = DistanceTo(HullOf(box), p);
    EXPECT_NEAR(distance, oracle::PointBoxDistance(p, box), 1e-12) << "seed " << kSeed;
    outside += distance > 0 ? 1 : 0;
  }
  EXPECT_GT(outside, 500);
}

}  // namespace
}  // namespace assay::geometry::point_distance_test
