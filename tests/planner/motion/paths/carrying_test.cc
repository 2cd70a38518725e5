#include "planner/motion/paths/carrying.h"

#include <gtest/gtest.h>

#include "planner/base/random.h"
#include "planner/motion/paths/straight_line.h"
#include "planner/plan/certificates/carrying.h"
#include "tests/planner/motion/arm_scene.h"

namespace assay::motion::carrying_test {
namespace {

constexpr std::uint64_t kSeed = 27;
constexpr double kInstant = 1e-3;  // seconds

const domain::Workcell& Cell() { return *Clutter().workcell; }

JointTrajectory Move(const JointVector& turn) {
  return SynchronizedMove(Cell().home(), Cell().home() + turn, RatesOf(Cell()));
}

JointVector Draw(RandomStream& random) {
  JointVector turn;
  for (double& joint : turn) joint = random.Uniform(-0.8, 0.8);
  return turn;
}

// Computes the acceleration by differences along the trajectory, away from jumps of the
// accelerations of its joints.
double GreatestAcceleration(const JointTrajectory& way, const Vector3& p_ToolCenter) {
  double greatest = 0;
  const auto at = [&](double t) { return ToolAt(Cell(), way.At(t).q) * p_ToolCenter; };
  for (std::size_t i = 0; i + 1 < way.knots().size(); ++i) {
    for (double t = way.knots()[i].time + kInstant; t < way.knots()[i + 1].time - kInstant;
         t += kInstant) {
      const Vector3 second = at(t + kInstant) - 2 * at(t) + at(t - kInstant);
      greatest = std::max(greatest, second.norm() / (kInstant * kInstant));
    }
  }
  return greatest;
}

TEST(Carrying, SparesThePartMoreThanItsAcceleration) {
  RandomStream random(kSeed, "carrying");
  const Vector3 center(0.02, 0, 0.05);
  for (int i = 0; i < 20; ++i) {
    const JointTrajectory asked = Move(Draw(random));
    const JointTrajectory way = Carrying(asked, Cell(), center);
    EXPECT_LE(GreatestAcceleration(way, center), 1.01 * plan::kCarryingAcceleration)
        << "seed " << kSeed << ", case " << i;
    EXPECT_GE(way.duration(), asked.duration());
    EXPECT_EQ(way.At(way.duration()).q, asked.At(asked.duration()).q);
  }
}

// Joint 1 alone turns the hand about the vertical, so only its rate matters.
TEST(Carrying, GentleMovesKeepTheirPace) {
  JointVector turn = JointVector::Zero();
  turn[0] = 1e-3;
  JointRates slow = RatesOf(Cell());
  slow.acceleration /= 10;
  const JointTrajectory asked = SynchronizedMove(Cell().home(), Cell().home() + turn, slow);
  EXPECT_EQ(Carrying(asked, Cell(), Vector3::Zero()).duration(), asked.duration());
}

}  // namespace
}  // namespace assay::motion::carrying_test
