#include "planner/finemotion/forward_projections/forward_projection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "bench/workloads/projections.h"
#include "planner/finemotion/forward_projections/meeting.h"
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

}  // namespace
}  // namespace assay::finemotion::forward_projection_test
