#include "planner/motion/collision/swept_volume.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>

#include "planner/geometry/hull.h"
#include "planner/geometry/solids/mass_properties.h"
#include "tests/oracle/random_pose.h"
#include "tests/planner/motion/arm_scene.h"

namespace assay::motion::swept_volume_test {
namespace {

using geometry::Facet;

double DistanceToSegment(const Vector3& p, const Vector3& a, const Vector3& b) {
  const double share = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (p - a - share * (b - a)).norm();
}

// Computes the distance of a point outside a polyhedron naively. It is the least distance to a
// facet. The distance to a facet is the distance to its plane if the point is above the facet, and
// otherwise the distance to an edge.
double DistanceOutside(const geometry::ConvexHull& hull, const Vector3& p) {
  double least = std::numeric_limits<double>::infinity();
  bool inside = true;
  for (const Facet& facet : hull.facets) {
    const double height = facet.normal.dot(p) - facet.offset;
    inside = inside && height <= 0;
    bool above = true;
    for (std::size_t i = 0; i < facet.loop.size(); ++i) {
      const Vector3& a = hull.vertices[facet.loop[i]];
      const Vector3& b = hull.vertices[facet.loop[(i + 1) % facet.loop.size()]];
      above = above && facet.normal.cross(b - a).dot(p - a) >= 0;
      least = std::min(least, DistanceToSegment(p, a, b));
    }
    if (above) least = std::min(least, std::abs(height));
  }
  return inside ? 0 : least;
}

bool Holds(const RoundedHull& hull, const Vector3& p) {
  if ((p - hull.center()).norm() > hull.ball_radius() + 1e-9) return false;
  return DistanceOutside(hull.core(), p) <= hull.radius() + 1e-9;
}

JointPath RandomPath(const CollisionScene& scene, RandomStream& random, double length) {
  JointPath path = {scene.workcell().home()};
  for (int i = 0; i < 3; ++i) {
    path.push_back(path.back() + length * (RandomPosture(scene.arm(), random) - path.back()));
  }
  return path;
}

Vector3 RandomVertexOf(const Body& body, RandomStream& random) {
  const RoundedHull& hull =
      body.hulls[static_cast<std::size_t>(random.Index(static_cast<int>(body.hulls.size())))];
  const int count = static_cast<int>(hull.vertices().size());
  return hull.vertices()[static_cast<std::size_t>(random.Index(count))];
}

// The variable ASSAY_SWEPT_POSTURES sets a greater number of postures, like 100000.
int PostureCount() {
  const char* count = std::getenv("ASSAY_SWEPT_POSTURES");
  return count == nullptr ? 1000 : std::atoi(count);
}

// Law: the bodies of the arm are inside the volume at every point of the path. Vertices are the
// most critical points.
void ExpectInside(const SweepAccuracy& accuracy) {
  const CollisionScene scene(Clutter(), PegInTheHand());
  RandomStream random(121, "swept");
  const JointPath path = RandomPath(scene, random, 0.4);
  const std::vector<SweptPiece> pieces = SweptVolume(scene, path, accuracy);
  for (int i = 0; i < PostureCount(); ++i) {
    const auto motion = static_cast<std::size_t>(random.Index(static_cast<int>(path.size()) - 1));
    const JointVector q = path[motion] + random.Uniform() * (path[motion + 1] - path[motion]);
    const LinkPoses X_BaseLink = scene.arm().LinkPoses(q);
    for (std::size_t b = 0; b < scene.bodies().size(); ++b) {
      const Body& body = scene.bodies()[b];
      if (body.link == 0) continue;
      const Vector3 p =
          scene.workcell().X_WorldBase() * X_BaseLink[body.link] * RandomVertexOf(body, random);
      const auto holds = [&](const SweptPiece& piece) {
        return piece.body == BodyId(b) && Holds(piece.hull, p);
      };
      ASSERT_TRUE(std::ranges::any_of(pieces, holds)) << body.name << " " << i;
    }
  }
}

TEST(SweptVolume, HoldsEveryPosture) { ExpectInside({}); }
TEST(SweptVolume, HoldsEveryPostureOfCoarseSteps) {
  ExpectInside({.sagitta = 0.05, .added_volume = 0});
}

// Law: no point of a body leaves its chord by more than the bound. If the bound is that of a
// circle, it is not much too large.
TEST(SweptVolume, SagittaIsABound) {
  const CollisionScene scene(Clutter(), PegInTheHand());
  RandomStream random(122, "sagitta");
  for (int i = 0; i < 300; ++i) {
    const JointVector from = RandomPosture(scene.arm(), random);
    const JointVector to = from + 0.1 * (RandomPosture(scene.arm(), random) - from);
    const double share = random.Uniform();
    const LinkPoses start = scene.arm().LinkPoses(from);
    const LinkPoses end = scene.arm().LinkPoses(to);
    const LinkPoses between = scene.arm().LinkPoses(from + share * (to - from));
    for (const Body& body : scene.bodies()) {
      const Vector3 p = RandomVertexOf(body, random);
      const Vector3 chord = (1 - share) * (start[body.link] * p) + share * (end[body.link] * p);
      EXPECT_LE((between[body.link] * p - chord).norm(),
                SagittaBound(body, (to - from).cwiseAbs()) + 1e-12);
    }
  }
}

// Known answer: for a single joint the sagitta bound is delta^2 / (8 rho) with delta = turn * rho.
TEST(SweptVolume, SagittaOfOneJoint) {
  const CollisionScene scene(Clutter(), PegInTheHand());
  JointVector turn = JointVector::Zero();
  turn[0] = 0.2;
  for (const Body& body : scene.bodies()) {
    const double delta = 0.2 * body.reach[0];
    if (body.link == 0) continue;
    EXPECT_NEAR(SagittaBound(body, turn), delta * delta / (8 * body.reach[0]), 1e-15);
  }
}

TEST(SweptVolume, PiecesGrowNoMoreThanAsked) {
  const CollisionScene scene(Clutter(), PegInTheHand());
  RandomStream random(123, "growth");
  const JointPath path = RandomPath(scene, random, 0.15);
  for (const SweptPiece& piece : SweptVolume(scene, path, {.sagitta = 0.01})) {
    EXPECT_LE(piece.hull.radius(), 0.01 + 1e-12);
  }
}

TEST(SweptVolume, MergingSavesPieces) {
  const CollisionScene scene(Clutter(), PegInTheHand());
  RandomStream random(124, "merging");
  const JointPath path = RandomPath(scene, random, 0.15);
  EXPECT_LT(SweptVolume(scene, path, {.added_volume = 0.3}).size(),
            SweptVolume(scene, path, {.added_volume = 0}).size());
}

// The volume of an arm that does not move consists of its bodies.
TEST(SweptVolume, OfNoMotion) {
  const CollisionScene scene(Clutter(), PegInTheHand());
  std::size_t hulls = 0;
  double volume = 0;
  for (const Body& body : scene.bodies()) {
    if (body.link == 0) continue;
    hulls += body.hulls.size();
    for (const RoundedHull& hull : body.hulls) volume += Volume(hull.core());
  }
  double swept = 0;
  const std::vector<SweptPiece> pieces = SweptVolume(scene, {scene.workcell().home()}, {});
  for (const SweptPiece& piece : pieces) {
    EXPECT_EQ(piece.hull.radius(), 0);
    swept += Volume(piece.hull.core());
  }
  EXPECT_EQ(pieces.size(), hulls);
  EXPECT_NEAR(swept, volume, 1e-9);
}

// Law: if the volume is clear of all standing parts, so is every posture. A part that is stated to
// be in the way stands near a body that moves there.
TEST(SweptVolume, WhatIsClearOfAVolumeIsClearOfEveryPostureInIt) {
  const CollisionScene scene(Clutter(), PartsAtTheStart());
  RandomStream random(125, "clear");
  constexpr double kClearance = 0.01;
  int clear = 0;
  int in_the_way = 0;
  for (int i = 0; i < 8; ++i) {
    const JointPath path = {scene.workcell().home(), RandomPostureAtTheTable(scene, 0.01, random)};
    const auto pair = InTheWay(scene, SweptVolume(scene, path, {}), kClearance);
    (pair ? in_the_way : clear) += 1;
    if (pair) {
      EXPECT_EQ(scene.body(pair->first).link, 0);
      EXPECT_GT(scene.body(pair->second).link, 0);
      continue;
    }
    for (int k = 0; k <= 300; ++k) {
      const LinkPoses X_BaseLink = scene.arm().LinkPoses(path[0] + k / 300.0 * (path[1] - path[0]));
      for (const BodyPair& each : scene.pairs()) {
        if (scene.body(each.first).link > 0) continue;
        EXPECT_GE(scene.Separation(each, X_BaseLink, kClearance), kClearance);
      }
    }
  }
  EXPECT_GT(clear, 0);
  EXPECT_GT(in_the_way, 0);
}

}  // namespace
}  // namespace assay::motion::swept_volume_test
