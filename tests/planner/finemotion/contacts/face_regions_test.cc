#include "planner/finemotion/contacts/face_regions.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "bench/workloads/pegs.h"
#include "tests/oracle/random_pose.h"

namespace assay::finemotion::face_regions_test {
namespace {

constexpr std::uint64_t kSeed = 74;
constexpr double kRounding = 1e-9;
constexpr double kClear = 1e-6;  // metres, least distance of sampled points from an outline

using Outline = std::vector<Vector3>;

double AreaOf(const Outline& outline, const Vector3& normal) {
  Vector3 sum = Vector3::Zero();
  for (std::size_t i = 0; i < outline.size(); ++i) {
    sum += outline[i].cross(outline[(i + 1) % outline.size()]);
  }
  return sum.dot(normal) / 2;
}

Outline OutlineOf(const FaceRegion& region) {
  Outline outline;
  for (const RegionSide& side : region) outline.push_back(side.start);
  return outline;
}

// Returns the depth of a point inside a convex outline in its plane; negative outside.
double DepthIn(const Outline& outline, const Vector3& normal, const Vector3& p) {
  double depth = 1;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vector3 along = (outline[(i + 1) % outline.size()] - outline[i]).normalized();
    depth = std::min(depth, normal.cross(along).dot(p - outline[i]));
  }
  return depth;
}

double DistanceToSegment(const Vector3& p, const Vector3& a, const Vector3& b) {
  const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (p - a - t * (b - a)).norm();
}

// Returns two to four boxes of a coarse grid, flush or overlapping, in any orientation.
Polyhedron RandomBlocks(RandomStream& random) {
  const Pose attitude = oracle::RandomPose(random, 0.1);
  std::vector<ConvexPiece> pieces;
  const int count = 2 + random.Index(3);
  for (int i = 0; i < count; ++i) {
    Vector3 low;
    Vector3 high;
    for (int k = 0; k < 3; ++k) {
      low[k] = 0.01 * random.Index(3);
      high[k] = low[k] + 0.01 * (1 + random.Index(3));
    }
    ConvexPiece piece = workloads::BoxPiece(low, high);
    for (Vector3& corner : piece.corners) corner = attitude * corner;
    pieces.push_back(piece);
  }
  return OutsideOf(pieces);
}

Vector3 PointAbout(const OuterFace& face, RandomStream& random) {
  Vector3 low = face.region[0][0];
  Vector3 high = low;
  for (const Outline& outline : face.region) {
    for (const Vector3& corner : outline) {
      low = low.cwiseMin(corner);
      high = high.cwiseMax(corner);
    }
  }
  const Vector3 margin = Vector3::Constant(0.002);
  Vector3 p;
  for (int k = 0; k < 3; ++k) p[k] = random.Uniform(low[k] - margin[k], high[k] + margin[k]);
  return p - (face.normal.dot(p) - face.height) * face.normal;
}

template <class Use>
void ForRandomFaces(const Use& use) {
  RandomStream random(kSeed, "blocks");
  for (int trial = 0; trial < 60; ++trial) {
    const Polyhedron shape = RandomBlocks(random);
    for (const OuterFace& face : shape.faces) {
      SCOPED_TRACE(trial);
      use(face, random);
      if (testing::Test::HasFailure()) return;
    }
  }
}

TEST(ConvexRegions, CoverTheFaceOnceAndNothingElse) {
  ForRandomFaces([](const OuterFace& face, RandomStream& random) {
    const std::vector<FaceRegion> regions = ConvexRegions(face);
    double area = 0;
    for (const Outline& outline : face.region) area += AreaOf(outline, face.normal);
    double covered = 0;
    for (const FaceRegion& region : regions) covered += AreaOf(OutlineOf(region), face.normal);
    EXPECT_NEAR(covered, area, 1e-6 * area);
    for (int i = 0; i < 30; ++i) {
      const Vector3 p = PointAbout(face, random);
      double depth = -1;
      for (const Outline& outline : face.region) {
        depth = std::max(depth, DepthIn(outline, face.normal, p));
      }
      int in = 0;
      bool on_a_side = false;
      for (const FaceRegion& region : regions) {
        double excess = -1;
        for (const RegionSide& side : region) excess = std::max(excess, side.Excess(p));
        in += excess <= 0 ? 1 : 0;
        on_a_side |= std::abs(excess) < kClear;
      }
      if (std::abs(depth) < kClear || on_a_side) continue;
      EXPECT_EQ(in, depth > 0 ? 1 : 0);
    }
  });
}

TEST(ConvexRegions, AreConvexAndInTheFacesPlane) {
  ForRandomFaces([](const OuterFace& face, RandomStream&) {
    for (const FaceRegion& region : ConvexRegions(face)) {
      ASSERT_GE(region.size(), 3U);
      for (std::size_t i = 0; i < region.size(); ++i) {
        const RegionSide& side = region[i];
        EXPECT_NEAR(side.outward.norm(), 1, kRounding);
        EXPECT_NEAR(side.outward.dot(face.normal), 0, kRounding);
        EXPECT_NEAR(face.normal.dot(side.start), face.height, kRounding);
        EXPECT_LT((side.end - region[(i + 1) % region.size()].start).norm(), kRounding);
        EXPECT_NEAR(side.Excess(side.end), 0, kRounding);
        for (const RegionSide& other : region) EXPECT_LT(side.Excess(other.start), kRounding);
      }
    }
  });
}

TEST(ConvexRegions, AFaceWithoutAConcaveCornerIsOne) {
  const Polyhedron flush = OutsideOf({workloads::BoxPiece({0, 0, 0}, {0.01, 0.02, 0.01}),
                                      workloads::BoxPiece({0.01, 0, 0}, {0.03, 0.02, 0.01})});
  ASSERT_EQ(flush.faces.size(), 6U);
  for (const OuterFace& face : flush.faces) EXPECT_EQ(ConvexRegions(face).size(), 1U);
}

TEST(ConvexRegions, TheTopAroundASquareHoleIsFour) {
  const Polyhedron hole = workloads::SquareHoleShape(0.02, 0.04, 0.07);
  EXPECT_EQ(ConvexRegions(hole.faces[0]).size(), 4U);
}

TEST(DistanceToRegion, IsThatOfTheNearestPoint) {
  ForRandomFaces([](const OuterFace& face, RandomStream& random) {
    for (const FaceRegion& region : ConvexRegions(face)) {
      const Outline outline = OutlineOf(region);
      for (int i = 0; i < 5; ++i) {
        const Vector3 p = PointAbout(face, random);
        double nearest = 1;
        for (std::size_t k = 0; k < outline.size(); ++k) {
          nearest = std::min(nearest,
                             DistanceToSegment(p, outline[k], outline[(k + 1) % outline.size()]));
        }
        if (DepthIn(outline, face.normal, p) > 0) nearest = 0;
        EXPECT_NEAR(DistanceTo(region, p), nearest, kRounding);
      }
    }
  });
}

}  // namespace
}  // namespace assay::finemotion::face_regions_test
