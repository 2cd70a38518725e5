#include "planner/kinematics/dynamics/servo_tuning.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "bench/workloads/reachable_poses.h"
#include "planner/base/random.h"
#include "planner/kinematics/dynamics/arm_dynamics.h"

namespace assay::kinematics::servo_tuning_test {
namespace {

using workloads::RandomJoints;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

constexpr std::uint64_t kSeed = 31;

class TunedServosOf : public testing::TestWithParam<const char*> {
 protected:
  Arm arm = Arm::FromUrdf(
      fmt::format("{}/models/robots/{}/{}.urdf", ASSAY_SOURCE_DIR, GetParam(), GetParam()),
      {.locked = std::string(GetParam()) == "iiwa7" ? LockedJoints{{"a3", 0}} : LockedJoints()});
  Gripper gripper =
      Gripper::FromUrdf(ASSAY_SOURCE_DIR "/models/grippers/parallel-jaw/gripper.urdf");
  ArmServos servos = TunedServos(LoadsOf(arm, gripper));
  RandomStream random{kSeed, "tuned servos"};

  // Returns the inertia that the servos move, with the motors.
  Matrix6 InertiaAt(const JointVector& q) const {
    const ArmDynamics weightless(arm, gripper, Vector3::Zero());
    Matrix6 inertia;
    for (int j = 0; j < 6; ++j) {
      inertia.col(j) = weightless.Torques({.q = q, .qdd = JointVector::Unit(j)});
      inertia(j, j) += servos[static_cast<std::size_t>(j)].armature;
    }
    return inertia;
  }
};

TEST_P(TunedServosOf, NothingVibratesFasterThan200RadiansPerSecond) {
  Matrix6 stiffness = Matrix6::Zero();
  for (int j = 0; j < 6; ++j) stiffness(j, j) = servos[static_cast<std::size_t>(j)].stiffness;
  double fastest = 0;
  for (int i = 0; i < 200; ++i) {
    const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix6> modes(
        stiffness, InertiaAt(RandomJoints(2.5, random)));
    fastest = std::max(fastest, std::sqrt(modes.eigenvalues().maxCoeff()));
  }
  EXPECT_LE(fastest, 200.001) << "seed " << kSeed;
  EXPECT_GT(fastest, 100) << "seed " << kSeed;
}

// The displacement is that of an arm whose joints yield to the torques of the force.
TEST_P(TunedServosOf, TheToolYieldsLittle) {
  const ArmDynamics weightless(arm, gripper, Vector3::Zero());
  for (int i = 0; i < 200; ++i) {
    const JointVector q = RandomJoints(2.5, random);
    const auto tool_at = [&](const JointVector& at) -> Vector3 {
      return arm.Forward(at) * gripper.X_FlangeTool().translation();
    };
    const Vector3 force = Vector3(random.Uniform(-1, 1), random.Uniform(-1, 1), 1).normalized();
    Vector3 moved = Vector3::Zero();
    for (int j = 0; j < 6; ++j) {
      constexpr double h = 1e-6;
      const Vector3 column =
          (tool_at(q + h * JointVector::Unit(j)) - tool_at(q - h * JointVector::Unit(j))) / (2 * h);
      moved += column * column.dot(force) / servos[static_cast<std::size_t>(j)].stiffness;
    }
    EXPECT_LT(moved.norm(), 6 * 1.4e-6) << "metres for one newton; case " << i;
  }
}

TEST_P(TunedServosOf, NoJointOscillates) {
  for (int i = 0; i < 200; ++i) {
    const Matrix6 inertia = InertiaAt(RandomJoints(2.5, random));
    for (int j = 0; j < 6; ++j) {
      const auto& [armature, stiffness, damping] = servos[static_cast<std::size_t>(j)];
      EXPECT_GE(damping, 0.98 * 2 * std::sqrt(stiffness * inertia(j, j)));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Arms, TunedServosOf,
                         testing::Values("puma762", "puma560", "ur5e", "irb120", "iiwa7"));

}  // namespace
}  // namespace assay::kinematics::servo_tuning_test
