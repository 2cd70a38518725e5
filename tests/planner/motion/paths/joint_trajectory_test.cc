#include "planner/motion/paths/joint_trajectory.h"

#include <gtest/gtest.h>

#include "planner/base/random.h"
#include "tests/planner/motion/arm_scene.h"

namespace assay::motion::joint_trajectory_test {
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
    double speed = 0;  // greatest share of the allowed speed
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

// At every time all joints have gone the same share of their way.
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

class AlongAPath : public ::testing::Test {
 protected:
  JointPath RandomPath(RandomStream& random, int corners) const {
    JointPath path;
    for (int i = 0; i < corners; ++i) path.push_back(RandomPosture(workcell_.arm(), random));
    return path;
  }
  const domain::Workcell& workcell_ = *Clutter().workcell;
  const JointRates rates_ = RatesOf(workcell_);
};

// The mean speeds and accelerations over short times are within the rates. Somewhere one of the
// rates is reached.
TEST_F(AlongAPath, KeepsToTheRates) {
  RandomStream random(91, "rates");
  for (int i = 0; i < 10; ++i) {
    const JointTrajectory trajectory = AlongPath(RandomPath(random, 4), rates_);
    const double step = 1e-3;
    double used = 0;
    for (double time = 0; time < trajectory.duration(); time += step) {
      const JointState now = trajectory.At(time);
      const JointState next = trajectory.At(time + step);
      const JointVector speed = (next.q - now.q).cwiseAbs() / step;
      const JointVector acceleration = (next.qd - now.qd).cwiseAbs() / step;
      used = std::max({used, speed.cwiseQuotient(rates_.speed).maxCoeff(),
                       acceleration.cwiseQuotient(rates_.acceleration).maxCoeff()});
    }
    EXPECT_LE(used, 1 + 1e-9);
    EXPECT_GE(used, 0.99);
  }
}

TEST_F(AlongAPath, GoesThroughItsCornersAtRest) {
  RandomStream random(93, "corners");
  const JointPath path = RandomPath(random, 5);
  const JointTrajectory trajectory = AlongPath(path, rates_);
  double time = 0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (i > 0) time += MoveDuration(path[i - 1], path[i], rates_);
    EXPECT_TRUE(trajectory.At(time).q.isApprox(path[i], 1e-9)) << i;
    EXPECT_NEAR(trajectory.At(time).qd.norm(), 0, 1e-9);
  }
  EXPECT_NEAR(time, trajectory.duration(), 1e-12);
}

TEST_F(AlongAPath, StandsStill) {
  const JointTrajectory trajectory = AlongPath({workcell_.home()}, rates_);
  EXPECT_EQ(trajectory.duration(), 0);
  EXPECT_EQ(trajectory.At(1).q, workcell_.home());
}

// Known answer: a turn of the waist by 90 degrees at 90 deg/s and 90 deg/s^2 takes a second to
// speed up and a second to slow down.
TEST_F(AlongAPath, WaistByAQuarterTurn) {
  JointVector to = JointVector::Zero();
  to[0] = M_PI / 2;
  EXPECT_NEAR(SynchronizedMove(JointVector::Zero(), to, rates_).duration(), 2, 1e-9);
}

}  // namespace
}  // namespace assay::motion::joint_trajectory_test
