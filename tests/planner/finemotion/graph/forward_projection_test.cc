#include "planner/finemotion/graph/forward_projection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "bench/workloads/projections.h"
#include "planner/finemotion/contacts/meeting.h"
#include "tests/planner/geometry/corners.h"

namespace assay::finemotion::forward_projection_test {
namespace {

using workloads::ProjectionAndContact;
using workloads::ProjectionModel;
using workloads::RandomProjection;
using workloads::StartShape;

constexpr std::uint64_t kSeed = 21;
constexpr double kRounding = 1e-11;
constexpr int kDirections = 32;

Eigen::VectorXd RandomVector(Eigen::Index size, RandomStream& random) {
  Eigen::VectorXd v(size);
  for (double& entry : v) entry = random.Uniform(-1, 1);
  return v;
}

Eigen::MatrixXd RandomDirections(Eigen::Index dimension, RandomStream& random) {
  Eigen::MatrixXd directions(dimension, kDirections);
  for (auto column : directions.colwise()) column = RandomVector(dimension, random).normalized();
  return directions;
}

template <class Region>
Eigen::VectorXd Supports(const Region& region, const Eigen::MatrixXd& directions) {
  Eigen::VectorXd supports(directions.cols());
  for (Eigen::Index i = 0; i < directions.cols(); ++i) {
    supports[i] = region.Support(directions.col(i));
  }
  return supports;
}

// Returns a factor of a generator. It is an end of its range as often as a value in between.
double RandomFactor(RandomStream& random) { return std::clamp(random.Uniform(-2, 2), -1.0, 1.0); }

Eigen::VectorXd Sample(const geometry::Zonotope& region, RandomStream& random) {
  Eigen::VectorXd z = region.center;
  for (const auto generator : region.generators.colwise()) z += RandomFactor(random) * generator;
  return z;
}

struct Motion {
  Eigen::VectorXd start;
  Eigen::VectorXd velocity;
};

Motion SampleMotion(const ForwardProjection& projection, RandomStream& random) {
  return {Sample(projection.start, random), Sample(projection.velocity, random)};
}

ProjectionAndContact RandomMoving(RandomStream& random) {
  ProjectionModel model;
  model.tolerances = random.Index(11);
  model.limits = random.Index(5);
  model.start = random.Index(2) == 0 ? StartShape::kBox : StartShape::kZonotope;
  model.velocity_errors = random.Index(5);
  model.time = random.Uniform(0.1, 3);
  return RandomProjection(model, random);
}

TEST(ForwardProjection, HoldsAMillionSampledMotions) {
  constexpr int kSamples = 10000;
  RandomStream random(kSeed, "motions");
  for (int trial = 0; trial < 100; ++trial) {
    const ForwardProjection projection = RandomMoving(random).projection;
    const Eigen::MatrixXd directions = RandomDirections(projection.start.center.size(), random);
    const Eigen::VectorXd supports = Supports(projection, directions);
    for (int i = 0; i < kSamples; ++i) {
      const Motion motion = SampleMotion(projection, random);
      const double s = projection.time * (RandomFactor(random) + 1) / 2;
      const Eigen::VectorXd reached = motion.start + s * motion.velocity;
      const double outside = (directions.transpose() * reached - supports).maxCoeff();
      ASSERT_LE(outside, kRounding) << "trial " << trial << ", motion " << i;
    }
  }
}

// A contact that contains a point of a motion is met.
TEST(ForwardProjection, MeetsEveryContactThroughASampledMotion) {
  RandomStream random(kSeed, "reached");
  for (int trial = 0; trial < 100000; ++trial) {
    ProjectionAndContact given = RandomMoving(random);
    const Motion motion = SampleMotion(given.projection, random);
    const double s = given.projection.time * (RandomFactor(random) + 1) / 2;
    const Eigen::VectorXd reached = motion.start + s * motion.velocity;
    given.contact.offset = -given.contact.row.dot(reached);
    for (HalfSpace& limit : given.contact.limits) limit.b = limit.a.dot(reached);
    ASSERT_TRUE(Meet(given.projection, given.contact).meets) << "trial " << trial;
  }
}

TEST(ForwardProjection, SupportIsThatOfItsFarthestPointAndGrowsWithTime) {
  RandomStream random(kSeed, "support");
  for (int trial = 0; trial < 500; ++trial) {
    ForwardProjection projection = RandomMoving(random).projection;
    const Eigen::VectorXd a = RandomVector(projection.start.center.size(), random);
    EXPECT_NEAR(projection.Support(a), a.dot(projection.Farthest(a)), kRounding);
    const double longer = projection.Support(a);
    projection.time /= 2;
    EXPECT_LE(projection.Support(a), longer);
    projection.time = 0;
    EXPECT_EQ(projection.Support(a), projection.start.Support(a));
  }
}

// Returns a motion towards the contact for every error.
ProjectionAndContact RandomApproaching(RandomStream& random) {
  ProjectionAndContact given = RandomMoving(random);
  given.projection.time *= 5;
  geometry::Zonotope& velocity = given.projection.velocity;
  if (given.contact.row.dot(velocity.center) > 0) velocity.center *= -1;
  const double speed = -given.contact.row.dot(velocity.center);
  const double error = velocity.Support(given.contact.row) + speed;
  if (error > 0.8 * speed) velocity = Scaled(velocity, 0.8 * speed / error);
  return given;
}

TEST(RegionAtContact, HoldsWhereSampledMotionsHitTheSurface) {
  RandomStream random(kSeed, "hits");
  int hits = 0;
  for (int trial = 0; trial < 500; ++trial) {
    const auto [projection, contact] = RandomApproaching(random);
    const geometry::Zonotope region = RegionAtContact(projection, contact);
    const Eigen::MatrixXd directions = RandomDirections(region.center.size(), random);
    const Eigen::VectorXd supports = Supports(region, directions);
    const double scale = supports.cwiseAbs().maxCoeff();
    for (int i = 0; i < 1000; ++i) {
      const Motion motion = SampleMotion(projection, random);
      const double s = contact.Gap(motion.start) / -contact.row.dot(motion.velocity);
      if (s < 0 || s > projection.time) continue;
      const Eigen::VectorXd hit = motion.start + s * motion.velocity;
      const double outside = (directions.transpose() * hit - supports).maxCoeff();
      ASSERT_LE(outside, kRounding * scale) << "trial " << trial << ", motion " << i;
      ++hits;
    }
  }
  EXPECT_GT(hits, 50000);
}

TEST(RegionAtContact, LiesInTheSurface) {
  RandomStream random(kSeed, "surface");
  for (int trial = 0; trial < 200; ++trial) {
    const auto [projection, contact] = RandomApproaching(random);
    const geometry::Zonotope region = RegionAtContact(projection, contact);
    const double scale = region.generators.cwiseAbs().sum();
    EXPECT_NEAR(region.Support(contact.row), -contact.offset, kRounding * scale);
    EXPECT_NEAR(-region.Support(-contact.row), -contact.offset, kRounding * scale);
  }
}

// Without errors of the velocity, each corner of the start is carried to the surface.
TEST(RegionAtContact, IsTightInTheStart) {
  RandomStream random(kSeed, "tight");
  for (int trial = 0; trial < 50; ++trial) {
    auto [projection, contact] = RandomApproaching(random);
    projection.velocity = Scaled(projection.velocity, 0);
    projection.start.generators.conservativeResize(Eigen::NoChange, 6);
    const geometry::Zonotope region = RegionAtContact(projection, contact);
    const Eigen::VectorXd& v = projection.velocity.center;
    const Eigen::VectorXd a = RandomVector(region.center.size(), random);
    double farthest = -std::numeric_limits<double>::infinity();
    for (const Eigen::VectorXd& corner : Corners(projection.start)) {
      const Eigen::VectorXd hit = corner - contact.Gap(corner) / contact.row.dot(v) * v;
      farthest = std::max(farthest, a.dot(hit));
    }
    EXPECT_NEAR(region.Support(a), farthest, 1e-9 * std::max(1.0, std::abs(farthest)));
    EXPECT_EQ(region.generators.cols(), 6) << "an error that is none";
  }
}

// A cube falls on the floor. Its height is forgotten, and the wind carries it while it falls.
TEST(RegionAtContact, OfAFallingCube) {
  PrimitiveContact floor;
  floor.row = Eigen::Vector3d(0, 0, 1);
  ForwardProjection falling;
  falling.start = geometry::Zonotope::Box(Eigen::Vector3d(-1, -2, 3), Eigen::Vector3d(1, 2, 5));
  falling.velocity = {Eigen::Vector3d(1, 0, -1), Eigen::Vector3d(0, 0.25, 0)};
  falling.time = 10;
  const geometry::Zonotope region = RegionAtContact(falling, floor);
  EXPECT_EQ(region.generators.cols(), 4);
  EXPECT_DOUBLE_EQ(region.Support(Eigen::Vector3d(1, 0, 0)), 6);
  EXPECT_DOUBLE_EQ(region.Support(Eigen::Vector3d(-1, 0, 0)), -2);
  EXPECT_DOUBLE_EQ(region.Support(Eigen::Vector3d(0, 1, 0)), 2 + 5 * 0.25);
  falling.time = 4;  // the top of the cube does not reach the floor
  EXPECT_DOUBLE_EQ(RegionAtContact(falling, floor).Support(Eigen::Vector3d(0, 1, 0)), 3);
  falling.velocity = {Eigen::Vector3d(0, 0, -1), Eigen::MatrixXd(3, 0)};
  EXPECT_EQ(RegionAtContact(falling, floor).generators.cols(), 2);
}

TEST(RegionAtContactDeathTest, EveryMotionMustApproach) {
  PrimitiveContact floor;
  floor.row = Eigen::Vector3d(0, 0, 1);
  ForwardProjection sliding;
  sliding.start = geometry::Zonotope::Box(Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(1, 1, 2));
  sliding.velocity = {Eigen::Vector3d(1, 0, -1), Eigen::Vector3d(0, 0, 1.5)};
  sliding.time = 1;
  EXPECT_DEATH(RegionAtContact(sliding, floor), "does not approach");
}

}  // namespace
}  // namespace assay::finemotion::forward_projection_test
