#include "planner/motion/joint_trajectory.h"

#include <gtest/gtest.h>

#include "tests/planner/motion/arm_scene.h"

namespace assay::motion {
namespace {

class Trajectory : public ::testing::Test {
 protected:
  JointPath RandomPath(RandomStream& random, int corners) const {
    JointPath path;
    for (int i = 0; i < corners; ++i) path.push_back(RandomPosture(workcell_.arm(), random));
    return path;
  }
  const domain::Workcell& workcell_ = *Clutter().workcell;
  const JointRates rates_ = RatesOf(workcell_);
};

// The mean speeds and accelerations between close times are within the rates, and somewhere one of
// them is used up.
TEST_F(Trajectory, KeepsToTheRates) {
  RandomStream random(91, "rates");
  for (int i = 0; i < 10; ++i) {
    const JointTrajectory trajectory(RandomPath(random, 4), rates_);
    const double step = 1e-3;
    double used = 0;
    for (double time = 0; time < trajectory.duration(); time += step) {
      const JointVector moved = trajectory.At(time + step) - trajectory.At(time);
      const JointVector speed = moved.cwiseAbs() / step;
      const JointVector gained = trajectory.VelocityAt(time + step) - trajectory.VelocityAt(time);
      const JointVector acceleration = gained.cwiseAbs() / step;
      used = std::max({used, speed.cwiseQuotient(rates_.speed).maxCoeff(),
                       acceleration.cwiseQuotient(rates_.acceleration).maxCoeff()});
    }
    EXPECT_LE(used, 1 + 1e-9);
    EXPECT_GE(used, 0.99);
  }
}

// The velocity that is told is the rate at which the joints move.
TEST_F(Trajectory, VelocityIsTheDerivative) {
  RandomStream random(92, "velocity");
  const JointTrajectory trajectory(RandomPath(random, 3), rates_);
  for (int i = 0; i < 200; ++i) {
    const double time = random.Uniform(0, trajectory.duration());
    const double step = 1e-6;
    const JointVector mean = (trajectory.At(time + step) - trajectory.At(time - step)) / (2 * step);
    EXPECT_TRUE(mean.isApprox(trajectory.VelocityAt(time), 1e-4) ||
                (mean - trajectory.VelocityAt(time)).norm() < 1e-5);
  }
}

TEST_F(Trajectory, GoesThroughItsCornersAtRest) {
  RandomStream random(93, "corners");
  const JointPath path = RandomPath(random, 5);
  const JointTrajectory trajectory(path, rates_);
  double time = 0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    EXPECT_TRUE(trajectory.At(time).isApprox(path[i], 1e-9)) << i;
    EXPECT_NEAR(trajectory.VelocityAt(time).norm(), 0, 1e-9);
    if (i < trajectory.moves().size()) time += trajectory.moves()[i].duration();
  }
  EXPECT_NEAR(time, trajectory.duration(), 1e-12);
}

TEST_F(Trajectory, StandsStill) {
  const JointTrajectory trajectory({workcell_.home()}, rates_);
  EXPECT_EQ(trajectory.duration(), 0);
  EXPECT_EQ(trajectory.At(1), workcell_.home());
}

// Known answer: 90 degrees of the waist at 90 deg/s and 90 deg/s^2: a second up and one down.
TEST_F(Trajectory, WaistByAQuarterTurn) {
  JointVector to = JointVector::Zero();
  to[0] = M_PI / 2;
  EXPECT_NEAR(SynchronizedMove(JointVector::Zero(), to, rates_).duration(), 2, 1e-9);
}

}  // namespace
}  // namespace assay::motion
