#include "sim/exec/joint_trajectory.h"

#include <gtest/gtest.h>

#include "planner/base/random.h"

namespace assay::exec {
namespace {

constexpr std::uint64_t kSeed = 31;

JointVector Draw(RandomStream& random, double low, double high) {
  JointVector v;
  for (int j = 0; j < v.size(); ++j) v[j] = random.Uniform(low, high);
  return v;
}

struct Case {
  JointVector from, to;
  JointRates rates;
  JointTrajectory move;
};

Case Draw(RandomStream& random) {
  const JointVector from = Draw(random, -3, 3);
  const JointVector to = Draw(random, -3, 3);
  const JointRates rates{Draw(random, 0.2, 3), Draw(random, 0.5, 6)};
  return {from, to, rates, SynchronizedMove(from, to, rates)};
}

TEST(SynchronizedMove, GoesFromRestToRest) {
  RandomStream random(kSeed, "ends");
  for (int i = 0; i < 200; ++i) {
    const Case c = Draw(random);
    EXPECT_TRUE(c.move.At(0).q.isApprox(c.from, 1e-12));
    EXPECT_TRUE(c.move.At(c.move.duration()).q.isApprox(c.to, 1e-12));
    EXPECT_EQ(c.move.At(0).qd.norm(), 0);
    EXPECT_EQ(c.move.At(c.move.duration()).qd.norm(), 0);
  }
}

TEST(SynchronizedMove, KeepsTheRatesAndReachesOneOfThem) {
  RandomStream random(kSeed, "rates");
  for (int i = 0; i < 100; ++i) {
    const Case c = Draw(random);
    const double dt = c.move.duration() / 1000;
    double speed = 0;  // greatest, as a share of what is allowed
    double acceleration = 0;
    for (int k = 0; k < 1000; ++k) {
      const JointState a = c.move.At(k * dt);
      const JointState b = c.move.At((k + 1) * dt);
      speed = std::max(speed, (b.qd.cwiseAbs().cwiseQuotient(c.rates.speed)).maxCoeff());
      acceleration =
          std::max(acceleration,
                   ((b.qd - a.qd).cwiseAbs() / dt).cwiseQuotient(c.rates.acceleration).maxCoeff());
    }
    EXPECT_LE(speed, 1 + 1e-9) << "case " << i;
    EXPECT_LE(acceleration, 1 + 1e-9) << "case " << i;
    EXPECT_GT(acceleration, 1 - 1e-6) << "case " << i;
  }
}

// All joints go the same share of their way at every time.
TEST(SynchronizedMove, IsAStraightLineInJointSpace) {
  RandomStream random(kSeed, "line");
  for (int i = 0; i < 100; ++i) {
    const Case c = Draw(random);
    const JointVector gone = c.move.At(random.Uniform() * c.move.duration()).q - c.from;
    const JointVector way = c.to - c.from;
    const double share = gone.dot(way) / way.squaredNorm();
    EXPECT_LT((gone - share * way).norm(), 1e-12);
  }
}

TEST(SynchronizedMove, ToTheSamePlaceTakesNoTime) {
  const JointVector q = JointVector::Constant(0.3);
  const JointTrajectory move = SynchronizedMove(q, q, {});
  EXPECT_EQ(move.duration(), 0);
  EXPECT_EQ(move.At(0).q, q);
}

TEST(JointTrajectory, VelocityIsTheDerivativeOfPosition) {
  RandomStream random(kSeed, "derivative");
  for (int i = 0; i < 100; ++i) {
    const JointTrajectory trajectory({{0, {Draw(random, -1, 1), Draw(random, -1, 1)}},
                                      {0.4, {Draw(random, -1, 1), Draw(random, -1, 1)}},
                                      {1, {Draw(random, -1, 1), Draw(random, -1, 1)}}});
    const double t = random.Uniform(0.01, 0.99);
    const double h = 1e-6;
    const JointVector slope = (trajectory.At(t + h).q - trajectory.At(t - h).q) / (2 * h);
    EXPECT_LT((slope - trajectory.At(t).qd).norm(), 1e-4);
  }
}

}  // namespace
}  // namespace assay::exec
