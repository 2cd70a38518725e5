#include "planner/kinematics/inverse/chain_inverse.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "bench/workloads/published_arms.h"
#include "planner/kinematics/arm.h"
#include "tests/oracle/inverse_search.h"

namespace assay::kinematics::chain_inverse_test {
namespace {

using workloads::NamedChain;
using workloads::RandomTurns;

constexpr double kPi = std::numbers::pi;

// The numbers of poses. Longer runs set the environment variables.
int Count(const char* variable, int usual) {
  const char* count = std::getenv(variable);
  return count ? std::atoi(count) : usual;
}
int Poses() { return Count("ASSAY_INVERSE_POSES", 200); }
int SearchedPoses() { return Count("ASSAY_INVERSE_SEARCHES", 10); }

std::vector<NamedChain> AllArms() {
  RandomStream random(11, "arms");
  std::vector<NamedChain> arms = workloads::PublishedArms();
  for (NamedChain& arm : workloads::RandomArms(random)) arms.push_back(std::move(arm));
  for (const NamedChain& arm : workloads::PublishedRedundantArms()) {
    const RedundantInverse inverse(arm.chain);
    arms.push_back({arm.name + " with a locked joint", inverse.At(0.4).chain()});
  }
  return arms;
}

double ErrorOf(const SerialChain& chain, const ChainVector& q, const Pose& X_BaseTip) {
  return (chain.Forward(q).matrix() - X_BaseTip.matrix()).cwiseAbs().maxCoeff();
}

bool Contains(const std::vector<SixAngles>& solutions, const SixAngles& q, double tolerance) {
  return std::ranges::any_of(solutions, [&](const SixAngles& solution) {
    return oracle::GreatestTurn(solution, q) < tolerance;
  });
}

std::vector<std::string> Kinds(const std::vector<NamedChain>& arms) {
  std::vector<std::string> kinds;
  for (const NamedChain& arm : arms) kinds.push_back(Describe(ClassOf(arm.chain)));
  return kinds;
}

TEST(ArmClass, TellsThePublishedArms) {
  const std::string wrist = "spherical wrist: axes 4, 5 and 6 meet in one point";
  EXPECT_THAT(Kinds(workloads::PublishedArms()),
              testing::ElementsAre(wrist, wrist, wrist, wrist,
                                   "three parallel axes: axes 2, 3 and 4, as on the arms of "
                                   "Universal Robots"));
}

TEST(ArmClass, FindsThreeAxesAtAnyPlace) {
  RandomStream random(1, "classes");
  const std::vector<NamedChain> arms = workloads::RandomArms(random);
  for (std::size_t i = 0; i < 4; ++i) {
    const ArmClass meet = ClassOf(arms[2 * i].chain);
    EXPECT_EQ(meet.kind, ArmKind::kConcurrent);
    EXPECT_EQ(meet.first, static_cast<int>(i));
    const ArmClass parallel = ClassOf(arms[2 * i + 1].chain);
    EXPECT_EQ(parallel.kind, ArmKind::kParallel);
    EXPECT_EQ(parallel.first, static_cast<int>(i));
  }
  EXPECT_EQ(ClassOf(arms[8].chain).pairs, 3);
  EXPECT_EQ(ClassOf(arms[10].chain).kind, ArmKind::kGeneral);
  EXPECT_EQ(ClassOf(arms[10].chain).pairs, 0);
}

TEST(ArmClass, IsThatOfTheDrawingForADisturbedArm) {
  RandomStream random(7, "disturbed");
  for (const NamedChain& arm : workloads::PublishedArms()) {
    const ArmClass exact = ClassOf(arm.chain);
    const NamedChain disturbed = Disturbed(arm, 1e-4, random);
    const ArmClass near = ClassOf(disturbed.chain);
    EXPECT_TRUE(exact.IsExact());
    EXPECT_FALSE(near.IsExact());
    EXPECT_EQ(near.kind, exact.kind);
    EXPECT_EQ(near.first, exact.first);
    EXPECT_LT(near.deviation, 1e-3);
    EXPECT_TRUE(ClassOf(Idealized(disturbed.chain, near)).IsExact());
    EXPECT_THAT(Describe(near), testing::HasSubstr(", to within "));
  }
}

// Solves the poses of random postures. Returns how many postures are no solution for their own
// pose.
int CountMissed(const NamedChain& arm) {
  const ChainInverse inverse(arm.chain);
  RandomStream random(2, arm.name);
  int missed = 0;
  for (int i = 0; i < Poses(); ++i) {
    const SixAngles q = RandomTurns(random, 6);
    const Pose X = arm.chain.Forward(q);
    const std::vector<SixAngles> solutions = inverse.Solve(X);
    // At a singular posture, a small error of the pose is a great one of the joint values.
    const bool is_singular =
        std::abs(Eigen::Matrix<double, 6, 6>(arm.chain.Jacobian(q)).determinant()) < 1e-8;
    if (!Contains(solutions, q, is_singular ? 1e-2 : 1e-5)) ++missed;
    EXPECT_LE(solutions.size(), 16u);
    for (const SixAngles& solution : solutions) {
      EXPECT_LT(ErrorOf(arm.chain, solution, X), 1e-9) << arm.name << ", pose " << i;
      EXPECT_GT(solution.minCoeff(), -kPi);
      EXPECT_LE(solution.maxCoeff(), kPi);
    }
  }
  return missed;
}

// A search may miss two solutions that are nearly the same. A closed form misses none.
TEST(ChainInverse, EverySolutionReachesThePoseAndTheKnownOneIsAmongThem) {
  for (const NamedChain& arm : AllArms()) {
    const bool is_general = ClassOf(arm.chain).kind == ArmKind::kGeneral;
    EXPECT_LE(CountMissed(arm), is_general ? Poses() / 1000 : 0) << arm.name;
  }
}

// Tools often point along an axis of the world, or nearly so. Equations of a closed form may then
// be nearly the same.
TEST(ChainInverse, FindsTheKnownSolutionBesideMultiplesOfThirtyDegrees) {
  for (const NamedChain& arm : AllArms()) {
    if (ClassOf(arm.chain).kind == ArmKind::kGeneral) continue;
    const ChainInverse inverse(arm.chain);
    RandomStream random(6, arm.name);
    for (int i = 0; i < 4 * Poses(); ++i) {
      const double off = std::pow(10, random.Uniform(-12, -3));
      SixAngles q = RandomTurns(random, 6);
      for (double& angle : q) angle = kPi / 6 * std::round(6 / kPi * angle) + off * angle;
      const Eigen::Matrix<double, 6, 6> J = arm.chain.Jacobian(q);
      if (std::abs(J.determinant()) < 1e-3) continue;
      EXPECT_TRUE(Contains(inverse.Solve(arm.chain.Forward(q)), q, 1e-5))
          << arm.name << ": " << q.transpose();
    }
  }
}

TEST(ChainInverse, SolvesDisturbedArmsAsTheyAre) {
  RandomStream random(12, "disturbed");
  for (const NamedChain& arm : workloads::PublishedArms()) {
    for (const double most : {1e-6, 1e-4}) {
      const NamedChain disturbed = Disturbed(arm, most, random);
      EXPECT_LE(CountMissed(disturbed), Poses() / 500) << disturbed.name;
    }
  }
}

TEST(ChainInverse, FindsAllThatADenseSearchFinds) {
  for (const NamedChain& arm : AllArms()) {
    const ChainInverse inverse(arm.chain);
    RandomStream random(3, arm.name);
    for (int i = 0; i < SearchedPoses(); ++i) {
      const Pose X = arm.chain.Forward(RandomTurns(random, 6));
      const std::vector<SixAngles> solutions = inverse.Solve(X);
      for (const SixAngles& q : oracle::SearchInverse(arm.chain, X.matrix(), 150, random)) {
        EXPECT_TRUE(Contains(solutions, q, 1e-4))
            << arm.name << ", pose " << i << ": " << q.transpose();
      }
    }
  }
}

TEST(ChainInverse, EqualsThePumasOwnFormula) {
  const std::string file = ASSAY_SOURCE_DIR "/models/robots/puma762/puma762.urdf";
  const Arm puma = Arm::FromUrdf(file);
  const ChainInverse inverse(SerialChain::FromModel(ReadUrdf(file)));
  RandomStream random(4, "puma");
  for (int i = 0; i < Poses(); ++i) {
    const JointVector q = RandomTurns(random, 6);
    const Pose X = puma.Forward(q);
    EXPECT_LT(ErrorOf(inverse.chain(), q, X), 1e-12);
    const std::vector<SixAngles> solutions = inverse.Solve(X);
    EXPECT_EQ(solutions.size(), puma.Inverse(X).size());
    for (const InverseSolution& solution : puma.Inverse(X)) {
      EXPECT_TRUE(Contains(solutions, solution.q, 1e-6)) << i;
    }
  }
}

// With axes 4 and 6 in line, joint 4 is free.
TEST(ChainInverse, TakesTheFreeJointOfASingularWristFromTheReference) {
  for (const std::size_t arm : {0u, 1u, 2u, 3u}) {
    const NamedChain puma = workloads::PublishedArms()[arm];
    const ChainInverse inverse(puma.chain);
    SixAngles q;
    q << 0.3, -0.7, 0.4, 0.9, 0, -0.2;
    SixAngles reference = SixAngles::Zero();
    reference[3] = 1.25;
    const Pose X = puma.chain.Forward(q);
    const std::vector<SixAngles> solutions = inverse.Solve(X, reference);
    SixAngles expected = q;
    expected[3] = 1.25;
    expected[5] = 0.9 - 0.2 - 1.25;
    // The axes of the IRB and of KUKA have the same sense, so that the sum of the angles is fixed.
    EXPECT_TRUE(Contains(solutions, expected, 1e-6)) << puma.name;
    for (const SixAngles& solution : solutions) EXPECT_LT(ErrorOf(puma.chain, solution, X), 1e-9);
  }
}

// With the wrist centre on axis 1 and no offset of the shoulder, joint 1 is free.
TEST(ChainInverse, TakesTheFreeJointOfASingularShoulderFromTheReference) {
  const SerialChain chain = workloads::PublishedArms()[2].chain;  // IRB 120
  const ChainInverse inverse(chain);
  // The wrist centre is at (70, 302) mm from the elbow, which leans by 90 degrees minus q2.
  SixAngles q = SixAngles::Zero();
  const auto radial = [&](double elbow) {
    q << 0.5, -1.2, elbow, 0.3, 0.8, 0.1;
    const Pose X = chain.Forward(q);
    const Vector3 wrist = X * Vector3(0, 0, -0.072);
    return wrist.x() * std::cos(0.5) + wrist.y() * std::sin(0.5);
  };
  double low = -3;
  while (radial(low) * radial(low + 0.1) > 0) low += 0.1;
  double high = low + 0.1;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (radial(low) * radial(middle) <= 0 ? high : low) = middle;
  }
  radial(low);
  const Pose X = chain.Forward(q);
  SixAngles reference = SixAngles::Zero();
  reference[0] = -2;
  const std::vector<SixAngles> solutions = inverse.Solve(X, reference);
  ASSERT_FALSE(solutions.empty());
  for (const SixAngles& solution : solutions) EXPECT_LT(ErrorOf(chain, solution, X), 1e-9);
}

TEST(ChainInverse, FindsTheStretchedArmOnceAndNothingBeyondIt) {
  const SerialChain chain = workloads::PublishedArms()[1].chain;  // Puma 762
  const ChainInverse inverse(chain);
  SixAngles q;
  q << 0.4, 0.3, kPi / 2, 0.5, 0.6, 0.7;
  const Pose stretched = chain.Forward(q);
  EXPECT_TRUE(Contains(inverse.Solve(stretched), q, 1e-4));
  EXPECT_EQ(inverse.Solve(stretched).size(), 4u);  // two of the shoulder, two of the wrist
  Pose beyond = stretched;
  beyond.translation() *= 1.01;
  EXPECT_TRUE(inverse.Solve(beyond).empty());
}

TEST(ChainInverse, IsRefusedBesideSingularPosesOnlyByRounding) {
  for (const NamedChain& arm : workloads::PublishedArms()) {
    const ChainInverse inverse(arm.chain);
    RandomStream random(5, arm.name);
    for (const double angle : {1e-3, 1e-5, 1e-7, 1e-9, 1e-11}) {
      for (int joint = 1; joint < 5; ++joint) {
        SixAngles q = RandomTurns(random, 6);
        q[joint] = angle;
        const Pose X = arm.chain.Forward(q);
        EXPECT_FALSE(inverse.Solve(X, q).empty()) << arm.name << ' ' << joint << ' ' << angle;
      }
    }
  }
}

TEST(RedundantInverse, FindsTheKnownSolutionAtItsValueOfTheLockedJoint) {
  for (const NamedChain& arm : workloads::PublishedRedundantArms()) {
    const RedundantInverse inverse(arm.chain);
    EXPECT_EQ(inverse.At(0.3).arm_class().kind, ArmKind::kConcurrent) << arm.name;
    RandomStream random(6, arm.name);
    for (int i = 0; i < 50; ++i) {
      const ChainVector q = RandomTurns(random, 7);
      const Pose X = arm.chain.Forward(q);
      bool found = false;
      for (const ChainVector& solution : inverse.Solve(X, q[inverse.locked_joint()])) {
        EXPECT_LT(ErrorOf(arm.chain, solution, X), 1e-9) << arm.name;
        found = found || (solution - q).cwiseAbs().maxCoeff() < 1e-5;
      }
      EXPECT_TRUE(found) << arm.name << ": " << q.transpose();
    }
  }
}

TEST(WithinLimits, GivesAllWholeTurnsBetweenTheLimits) {
  SerialChain chain = workloads::PublishedArms()[0].chain;
  std::vector<ChainJoint> joints = chain.joints();
  joints[0].limits = {-2 * kPi, 2 * kPi, 1, 1};
  joints[1].limits = {0.5, 1, 1, 1};
  chain = SerialChain(joints, chain.X_BaseTipAtZero());
  ChainVector q = ChainVector::Zero(6);
  q[0] = 1;
  EXPECT_TRUE(WithinLimits(chain, q).empty());
  q[1] = 0.7 - 2 * kPi;
  const std::vector<ChainVector> found = WithinLimits(chain, q);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_NEAR(found[0][0], 1 - 2 * kPi, 1e-12);
  EXPECT_NEAR(found[1][0], 1, 1e-12);
  EXPECT_NEAR(found[0][1], 0.7, 1e-12);
}

}  // namespace
}  // namespace assay::kinematics::chain_inverse_test
