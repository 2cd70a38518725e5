#include "sim/execution/control/straight_line.h"

#include <gtest/gtest.h>

#include "planner/base/random.h"
#include "planner/geometry/pose.h"
#include "tests/sim/execution/figure15.h"

namespace assay::execution::straight_line_test {
namespace {

constexpr std::uint64_t kSeed = 32;

class StraightLine : public testing::Test {
 protected:
  static const domain::Workcell& workcell() {
    static const domain::Problem problem = Figure15();
    return *problem.workcell;
  }
  const JointRates rates_ = motion::RatesOf(workcell());

  // Returns the end of a random line of the tool from home. It goes up to 20 cm sideways or down,
  // and up to 5 cm upward.
  Vector3 DrawEnd(RandomStream& random) const {
    const Vector3 home = ToolAt(workcell(), workcell().home()).translation();
    return home + Vector3(random.Uniform(-0.1, 0.1), random.Uniform(-0.2, 0.2),
                          random.Uniform(-0.2, 0.05));
  }
};

double DistanceFromLine(const Vector3& p, const Vector3& a, const Vector3& b) {
  const Vector3 along = (b - a).normalized();
  return ((p - a) - along * along.dot(p - a)).norm();
}

TEST_F(StraightLine, StaysOnTheLineAndKeepsTheOrientation) {
  RandomStream random(kSeed, "line");
  const Pose start = ToolAt(workcell(), workcell().home());
  for (int i = 0; i < 50; ++i) {
    const Vector3 end = DrawEnd(random);
    const LineResult line = FollowLine(workcell(), workcell().home(), end);
    ASSERT_TRUE(line.path) << "line " << i << " to " << end.transpose();
    const JointTrajectory timed = WithTimes(*line.path, kFreePace, rates_);
    for (int k = 0; k <= 300; ++k) {
      const kinematics::JointState state = timed.At(k * timed.duration() / 300);
      const Pose X_WorldTool = ToolAt(workcell(), state.q);
      ASSERT_LT(DistanceFromLine(X_WorldTool.translation(), start.translation(), end), 2e-6);
      ASSERT_LT(geometry::AngleBetween(X_WorldTool.linear(), start.linear()), 2e-5);
    }
  }
}

TEST_F(StraightLine, KeepsTheRatesOfTheJoints) {
  RandomStream random(kSeed, "rates");
  for (int i = 0; i < 50; ++i) {
    const LineResult line = FollowLine(workcell(), workcell().home(), DrawEnd(random));
    ASSERT_TRUE(line.path);
    const JointTrajectory trajectory = WithTimes(*line.path, kFreePace, rates_);
    const double dt = trajectory.duration() / 500;
    for (int k = 0; k < 500; ++k) {
      const JointVector a = trajectory.At(k * dt).qd;
      const JointVector b = trajectory.At((k + 1) * dt).qd;
      ASSERT_TRUE((b.cwiseAbs().array() <= 1.01 * rates_.speed.array()).all());
      ASSERT_TRUE(((b - a).cwiseAbs().array() <= 1.1 * dt * rates_.acceleration.array()).all());
    }
  }
}

TEST_F(StraightLine, KeepsTheLimitsAndTheConfiguration) {
  RandomStream random(kSeed, "configuration");
  const kinematics::Arm& arm = workcell().arm();
  for (int i = 0; i < 50; ++i) {
    const LineResult line = FollowLine(workcell(), workcell().home(), DrawEnd(random));
    ASSERT_TRUE(line.path);
    for (const JointVector& q : line.path->q) {
      ASSERT_TRUE(arm.InRange(q));
      ASSERT_EQ(arm.IndicatorsOf(q), arm.IndicatorsOf(workcell().home()));
    }
  }
}

TEST_F(StraightLine, IsSlowOverItsFinalLength) {
  const Vector3 start = ToolAt(workcell(), workcell().home()).translation();
  const Vector3 end = start - Vector3(0, 0, 0.15);
  const LineResult line = FollowLine(workcell(), workcell().home(), end);
  const Pace pace{.speed = 0.3, .final_speed = 0.01, .final_length = 0.02};
  const JointTrajectory timed = WithTimes(*line.path, pace, rates_);
  const double dt = 1e-3;
  double fastest = 0;
  for (double t = 0; t < timed.duration(); t += dt) {
    const Vector3 p = ToolAt(workcell(), timed.At(t).q).translation();
    const Vector3 next = ToolAt(workcell(), timed.At(t + dt).q).translation();
    const double speed = (next - p).norm() / dt;
    fastest = std::max(fastest, speed);
    if ((p - end).norm() < pace.final_length) {
      EXPECT_LE(speed, 1.01 * pace.final_speed);
    }
  }
  EXPECT_GT(fastest, 0.2);
  EXPECT_LE(fastest, 1.01 * pace.speed);
}

TEST_F(StraightLine, TellsWhereItLeavesTheReach) {
  const Vector3 start = ToolAt(workcell(), workcell().home()).translation();
  const LineResult line = FollowLine(workcell(), workcell().home(), start + Vector3(2, 0, 0));
  EXPECT_FALSE(line.path);
  EXPECT_GT(line.stuck_at.x(), start.x());
  EXPECT_LT(line.stuck_at.x(), start.x() + 2);
  EXPECT_LT(DistanceFromLine(line.stuck_at, start, start + Vector3(2, 0, 0)), 1e-9);
}

TEST_F(StraightLine, OfNoLengthTakesNoTime) {
  const Vector3 start = ToolAt(workcell(), workcell().home()).translation();
  const LineResult line = FollowLine(workcell(), workcell().home(), start);
  ASSERT_TRUE(line.path);
  EXPECT_EQ(WithTimes(*line.path, kFreePace, rates_).duration(), 0);
}

}  // namespace
}  // namespace assay::execution::straight_line_test
