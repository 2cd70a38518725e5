#include "planner/kinematics/branched_chain.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "bench/workloads/published_arms.h"
#include "planner/base/random.h"
#include "planner/kinematics/arm.h"

namespace assay::kinematics::branched_chain_test {
namespace {

using workloads::NamedChain;

JointVector RandomPosture(RandomStream& random) {
  JointVector q;
  for (double& angle : q) angle = random.Uniform(-M_PI, M_PI);
  return q;
}

// Returns the arm whose base is the flange of the other one.
SerialChain Reversed(const SerialChain& chain) {
  const Pose X_FlangeBase = chain.X_BaseTipAtZero().inverse();
  std::vector<ChainJoint> joints;
  for (int i = chain.size() - 1; i >= 0; --i) {
    ChainJoint joint = chain.joints()[static_cast<std::size_t>(i)];
    joint.axis = Moved(X_FlangeBase, joint.axis);
    joint.axis.direction *= -1;
    joints.push_back(joint);
  }
  return {joints, X_FlangeBase};
}

// Arms with factors: industrial arms, arms with seven joints of which one is locked, and arms that
// stand on their flange.
std::vector<NamedChain> ArmsWithFactors() {
  std::vector<NamedChain> arms = workloads::PublishedArms();
  const std::vector<NamedChain> redundant = workloads::PublishedRedundantArms();
  const SerialChain& iiwa = redundant[0].chain;
  const SerialChain& panda = redundant[1].chain;
  for (const double value : {0.0, 0.7, -1.5}) {
    arms.push_back({"iiwa 7, joint 3 locked", iiwa.Locked(2, value)});
  }
  arms.push_back({"Panda, joint 5 locked", panda.Locked(4, 0)});
  const std::size_t upright = arms.size();
  for (std::size_t i = 0; i < upright; ++i) {
    arms.push_back({arms[i].name + ", reversed", Reversed(arms[i].chain)});
  }
  return arms;
}

std::vector<NamedChain> AllArms() {
  RandomStream random(1, "arms");
  std::vector<NamedChain> arms = ArmsWithFactors();
  for (NamedChain& arm : workloads::RandomArms(random)) arms.push_back(std::move(arm));
  return arms;
}

double LeastSingularValue(const ArmJacobian& jacobian) {
  return Eigen::JacobiSVD<ArmJacobian>(jacobian).singularValues()[5];
}

TEST(BranchedChain, ManyArmsHaveFactors) {
  for (const NamedChain& arm : ArmsWithFactors()) {
    EXPECT_TRUE(BranchedChain(arm.chain).TellsAllApart()) << arm.name;
  }
}

// The Puma has two solvers, which must agree about everything.
TEST(BranchedChain, AgreesWithLeeAndZieglerAboutThePuma) {
  const std::string file = ASSAY_SOURCE_DIR "/models/robots/puma762/puma762.urdf";
  const Arm puma = Arm::FromUrdf(file);
  const BranchedChain chain(SerialChain::FromModel(ReadUrdf(file)));
  EXPECT_TRUE(chain.TellsAllApart());
  EXPECT_TRUE(chain.HasSphericalWrist());
  EXPECT_LT((chain.p_FlangeCenter() - puma.p_FlangeCenter()).norm(), 1e-12);
  RandomStream random(2, "puma");
  for (int i = 0; i < 2000; ++i) {
    const JointVector q = RandomPosture(random);
    EXPECT_EQ(chain.IndicatorsOf(q), puma.IndicatorsOf(q)) << q.transpose();
    EXPECT_LT((chain.JacobianAt(q) - puma.JacobianAt(q)).norm(), 1e-12);
    const Pose X = puma.Forward(q);
    for (const InverseSolution& one : puma.Inverse(X, q)) {
      const auto same = chain.Inverse(X, one.indicators, q);
      ASSERT_TRUE(same);
      EXPECT_LT((chain.Forward(*same).matrix() - X.matrix()).norm(), 4e-9);
    }
  }
}

TEST(BranchedChain, IndicatorsTellTheSolutionsApart) {
  RandomStream random(3, "apart");
  for (const NamedChain& arm : AllArms()) {
    const BranchedChain chain(arm.chain);
    if (!chain.TellsAllApart()) continue;
    for (int i = 0; i < 2000; ++i) {
      const JointVector q = RandomPosture(random);
      if (LeastSingularValue(chain.JacobianAt(q)) < 1e-3) continue;
      const InverseSolutions solutions = chain.Inverse(chain.Forward(q), q);
      for (const InverseSolution& one : solutions) {
        EXPECT_EQ(one.indicators, chain.IndicatorsOf(one.q));
        for (const InverseSolution& other : solutions) {
          EXPECT_EQ(&one == &other, one.indicators == other.indicators)
              << arm.name << ": " << one.q.transpose() << " and " << other.q.transpose();
        }
      }
    }
  }
}

// On a straight way in joint space, the indicators change only where the arm is singular.
TEST(BranchedChain, IndicatorsChangeAtSingularPosturesOnly) {
  constexpr int kSteps = 4000;
  RandomStream random(4, "ways");
  int changes = 0;
  for (const NamedChain& arm : AllArms()) {
    const BranchedChain chain(arm.chain);
    for (int way = 0; way < 5; ++way) {
      const JointVector from = RandomPosture(random);
      const JointVector to = RandomPosture(random);
      JointVector before = from;
      for (int i = 1; i <= kSteps; ++i) {
        const JointVector q = from + static_cast<double>(i) / kSteps * (to - from);
        if (chain.IndicatorsOf(q) != chain.IndicatorsOf(before)) {
          ++changes;
          EXPECT_LT(LeastSingularValue(chain.JacobianAt(q)), 0.01) << arm.name;
        }
        before = q;
      }
    }
  }
  EXPECT_GT(changes, 100);
}

// The Jacobian is the derivative of the forward kinematics, about the centre.
TEST(BranchedChain, TheJacobianIsTheDerivative) {
  constexpr double kStep = 1e-6;
  RandomStream random(5, "derivative");
  for (const NamedChain& arm : AllArms()) {
    const BranchedChain chain(arm.chain);
    for (int i = 0; i < 100; ++i) {
      const JointVector q = RandomPosture(random);
      const ArmJacobian jacobian = chain.JacobianAt(q);
      for (int k = 0; k < 6; ++k) {
        JointVector ahead = q;
        JointVector behind = q;
        ahead[k] += kStep;
        behind[k] -= kStep;
        const Pose X = chain.Forward(ahead);
        const Pose Y = chain.Forward(behind);
        const Vector3 velocity =
            (X * chain.p_FlangeCenter() - Y * chain.p_FlangeCenter()) / (2 * kStep);
        const Eigen::AngleAxisd turn(X.linear() * Y.linear().transpose());
        EXPECT_LT((jacobian.col(k).head<3>() - velocity).norm(), 1e-8) << arm.name << k;
        EXPECT_LT((jacobian.col(k).tail<3>() - turn.axis() * turn.angle() / (2 * kStep)).norm(),
                  1e-8)
            << arm.name << k;
      }
    }
  }
}

}  // namespace
}  // namespace assay::kinematics::branched_chain_test
