#include "planner/kinematics/arm.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>

#include "bench/workloads/reachable_poses.h"
#include "planner/base/random.h"
#include "planner/geometry/pose.h"
#include "tests/oracle/forward_kinematics.h"
#include "tests/planner/kinematics/puma.h"

namespace assay::kinematics::arm_test {
namespace {

using workloads::RandomJoints;

constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180;
constexpr double kTight = 1e-12;  // metres, pose error of a product of a dozen rotations
constexpr double kPoseTolerance = 1e-9;

// Returns the Puma with an offset a3 between elbow and axis 4, like that of the Puma 560.
Arm ArmWithElbowOffset(double a3) {
  return Arm::FromUrdf(WriteUrdf("elbow_offset.urdf",
                                 PumaWith("<origin xyz=\"0 0 0.600\"/>",
                                          "<origin xyz=\"" + std::to_string(a3) + " 0 0.600\"/>")));
}

JointVector Degrees(double q1, double q2, double q3, double q4, double q5, double q6) {
  JointVector q;
  q << q1, q2, q3, q4, q5, q6;
  return q * kDegree;
}

double PoseError(const Pose& a, const Eigen::Matrix4d& b) {
  return (a.matrix() - b).cwiseAbs().maxCoeff();
}

// Returns the largest difference of two joint vectors, without whole turns.
double TurnError(const JointVector& a, const JointVector& b) {
  double largest = 0;
  for (int i = 0; i < 6; ++i) {
    largest = std::max(largest, std::abs(std::remainder(a[i] - b[i], 2 * kPi)));
  }
  return largest;
}

double NearestTurnError(const InverseSolutions& solutions, const JointVector& q) {
  double nearest = 10;
  for (const InverseSolution& s : solutions) nearest = std::min(nearest, TurnError(s.q, q));
  return nearest;
}

// Returns how far q is from the nearest singularity. It is the least of three numbers: a length in
// metres for the shoulder, a length in metres for the elbow, and the sine of an angle for the
// wrist.
double DistanceToSingularity(const Arm& arm, const JointVector& q) {
  const ArmGeometry& g = *arm.geometry();
  const double q23 = q[1] + q[2];
  const double reach = g.d4 * std::sin(q23) + g.a3 * std::cos(q23) + g.a2 * std::cos(q[1]);
  const double across = g.d4 * std::cos(q[2]) - g.a3 * std::sin(q[2]);
  return std::min({std::abs(reach), std::abs(across), std::abs(std::sin(q[4]))});
}

TEST(Forward, KnownPoses) {
  Eigen::Matrix4d expected = Eigen::Matrix4d::Identity();
  expected.topRightCorner<3, 1>() = Vector3(0.650, 0.190, 0.725);
  EXPECT_LT(PoseError(Puma().Forward(JointVector::Zero()), expected), kTight);
  expected.topRightCorner<3, 1>() = Vector3(0, 0.190, 1.375);
  EXPECT_LT(PoseError(Puma().Forward(Degrees(0, -90, 90, 0, 0, 0)), expected), kTight);
}

TEST(Forward, AgreesWithTableAndUrdf) {
  RandomStream random(1, "forward");
  for (const Arm& arm : {Puma(), ArmWithElbowOffset(-0.0203)}) {
    for (int i = 0; i < 10000; ++i) {
      const JointVector q = RandomJoints(5, random);
      const Pose X = arm.Forward(q);
      ASSERT_LT(PoseError(X, oracle::ForwardByTable(*arm.geometry(), q)), kTight) << q.transpose();
      ASSERT_LT(PoseError(X, oracle::ForwardByUrdf(arm.model(), q)), kTight) << q.transpose();
      ASSERT_LT(PoseError(arm.LinkPoses(q).back(), X.matrix()), kTight) << q.transpose();
    }
  }
}

// Expects eight different solutions that include the generating joint vector. Every solution must
// reproduce the pose and have its own indicators.
void ExpectCompleteInverse(const Arm& arm, const JointVector& q) {
  const Pose X = arm.Forward(q);
  const InverseSolutions solutions = arm.Inverse(X);
  ASSERT_EQ(solutions.size(), 8u) << q.transpose();
  std::set<int> seen;
  for (const InverseSolution& s : solutions) {
    ASSERT_LT(PoseError(X, oracle::ForwardByTable(*arm.geometry(), s.q)), kPoseTolerance)
        << q.transpose();
    ASSERT_EQ(s.indicators, arm.IndicatorsOf(s.q)) << q.transpose() << '\n' << s.q.transpose();
    ASSERT_LE(s.q.maxCoeff(), kPi);
    ASSERT_GE(s.q.minCoeff(), -kPi);
    seen.insert(static_cast<int>(s.indicators.shoulder) * 4 +
                static_cast<int>(s.indicators.elbow) * 2 + static_cast<int>(s.indicators.wrist));
    if (s.indicators == arm.IndicatorsOf(q)) {
      ASSERT_LT(TurnError(s.q, q), 1e-6) << q.transpose();
    }
  }
  ASSERT_EQ(seen.size(), 8u) << q.transpose();
}

// The Jacobian must agree with that of a chain of rigid links, each of which turns about its own
// axis.
TEST(Jacobian, IsThatOfTheLinks) {
  RandomStream random(1, "jacobian");
  for (const Arm& arm : {Puma(), ArmWithElbowOffset(-0.0203)}) {
    for (int i = 0; i < 1000; ++i) {
      const JointVector q = RandomJoints(5, random);
      const std::array<Pose, 7> X_BaseLink = arm.LinkPoses(q);
      const Vector3 center = X_BaseLink[6] * Vector3(0, 0, -arm.geometry()->d6);
      const ArmJacobian jacobian = arm.JacobianAt(q);
      for (int k = 0; k < 6; ++k) {
        const Pose& X_BaseJoint = X_BaseLink[k + 1];
        const Vector3 axis = X_BaseJoint.linear() * arm.model().joints[k].axis;
        const Vector3 velocity = axis.cross(center - X_BaseJoint.translation());
        EXPECT_LT((jacobian.col(k).tail<3>() - axis).norm(), kTight) << k;
        EXPECT_LT((jacobian.col(k).head<3>() - velocity).norm(), kTight) << k;
      }
    }
  }
}

TEST(Inverse, CompleteOnRandomPoses) {
  RandomStream random(2, "inverse");
  for (int drawn = 0; drawn < 100000;) {
    const JointVector q = RandomJoints(kPi, random);
    if (DistanceToSingularity(Puma(), q) < 1e-6) continue;
    ASSERT_NO_FATAL_FAILURE(ExpectCompleteInverse(Puma(), q)) << "draw " << drawn;
    ++drawn;
  }
}

TEST(Inverse, CompleteWithElbowOffset) {
  RandomStream random(3, "inverse with elbow offset");
  for (const double a3 : {-0.0203, 0.05}) {
    const Arm arm = ArmWithElbowOffset(a3);
    for (int drawn = 0; drawn < 5000;) {
      const JointVector q = RandomJoints(kPi, random);
      if (DistanceToSingularity(arm, q) < 1e-6) continue;
      ASSERT_NO_FATAL_FAILURE(ExpectCompleteInverse(arm, q)) << "draw " << drawn;
      ++drawn;
    }
  }
}

TEST(Inverse, NoneBeyondReach) {
  RandomStream random(4, "beyond reach");
  const double reach = std::hypot(1.25, 0.19);  // greatest reach of the wrist centre, metres
  for (int i = 0; i < 1000; ++i) {
    Pose X = Puma().Forward(RandomJoints(kPi, random));
    const Vector3 hand = 0.125 * X.linear().col(2);
    X.translation() = (X.translation() - hand).normalized() * (reach + 1e-6) + hand;
    EXPECT_TRUE(Puma().Inverse(X).empty());
  }
}

TEST(Inverse, NoneNearAxisOne) {
  RandomStream random(5, "near axis 1");
  for (int i = 0; i < 1000; ++i) {
    Pose X = Puma().Forward(RandomJoints(kPi, random));
    const double angle = random.Uniform(-kPi, kPi);
    const double radius = random.Uniform(0, 0.190 - 1e-6);
    X.translation() = Vector3(radius * std::cos(angle), radius * std::sin(angle), 0.8) +
                      0.125 * X.linear().col(2);
    EXPECT_TRUE(Puma().Inverse(X).empty());
  }
}

void ExpectAllReproduce(const Arm& arm, const InverseSolutions& solutions, const Pose& X) {
  EXPECT_FALSE(solutions.empty());
  for (const InverseSolution& s : solutions) {
    EXPECT_LT(PoseError(X, oracle::ForwardByTable(*arm.geometry(), s.q)), kPoseTolerance)
        << s.q.transpose();
  }
}

TEST(Singular, WristKeepsReference) {
  RandomStream random(6, "wrist singular");
  for (int i = 0; i < 1000; ++i) {
    JointVector q = RandomJoints(kPi, random);
    q[4] = 0;
    const Pose X = Puma().Forward(q);
    const JointVector reference = RandomJoints(kPi, random);
    const InverseSolutions solutions = Puma().Inverse(X, reference);
    ExpectAllReproduce(Puma(), solutions, X);
    for (const InverseSolution& s : solutions) {
      // Solutions of the other branches have a bent wrist.
      if (std::abs(std::sin(s.q[4])) > 1e-9) continue;
      const double expected = reference[3] + (s.indicators.wrist == Wrist::kFlip ? kPi : 0);
      EXPECT_NEAR(std::remainder(s.q[3] - expected, 2 * kPi), 0, 1e-9);
    }
    EXPECT_LT(NearestTurnError(Puma().Inverse(X, q), q), 1e-6) << q.transpose();
  }
}

TEST(Singular, NearWristStaysExact) {
  RandomStream random(7, "near wrist singular");
  for (double bend = 1e-4; bend > 1e-16; bend /= 3) {
    JointVector q = RandomJoints(kPi, random);
    q[4] = bend;
    const Pose X = Puma().Forward(q);
    ExpectAllReproduce(Puma(), Puma().Inverse(X), X);
  }
}

TEST(Singular, ElbowStretchedAndFolded) {
  RandomStream random(8, "elbow singular");
  for (const double elbow : {kPi / 2, -kPi / 2}) {
    for (int i = 0; i < 1000; ++i) {
      JointVector q = RandomJoints(kPi, random);
      q[2] = elbow;
      if (std::abs(std::sin(q[4])) < 0.01) continue;  // a second singularity loses more digits
      const Pose X = Puma().Forward(q);
      const InverseSolutions solutions = Puma().Inverse(X, q);
      ExpectAllReproduce(Puma(), solutions, X);
      // The square root at the border of the reach leaves half of the digits.
      EXPECT_LT(NearestTurnError(solutions, q), 1e-5) << q.transpose();
    }
  }
}

// Returns the pose with the wrist centre at p and the hand along x.
Pose PoseWithWristCentre(const Vector3& p) {
  Pose X = geometry::RotationY(kPi / 2);
  X.translation() = p + 0.125 * X.linear().col(2);
  return X;
}

TEST(Singular, OuterBorderOfTheReachGivesFour) {
  const Pose X = PoseWithWristCentre({1.25 + 2e-14, 0.190, 0});
  const InverseSolutions solutions = Puma().Inverse(X);
  EXPECT_EQ(solutions.size(), 4u);
  ExpectAllReproduce(Puma(), solutions, X);
}

TEST(Singular, InnerBorderOfTheReachGivesFour) {
  const Pose X = PoseWithWristCentre({0, 0.190 - 5e-14, 0.8});
  const InverseSolutions solutions = Puma().Inverse(X);
  EXPECT_EQ(solutions.size(), 4u);
  ExpectAllReproduce(Puma(), solutions, X);
}

TEST(Singular, ShoulderWristCentreNearestToAxisOne) {
  RandomStream random(9, "shoulder singular");
  const ArmGeometry& g = *Puma().geometry();
  for (int i = 0; i < 1000; ++i) {
    JointVector q = RandomJoints(kPi, random);
    // The wrist centre lies on axis 1 if d4 s23 + a2 c2 = 0.
    if (std::abs(g.a2 * std::cos(q[1]) / g.d4) > 1) continue;
    q[2] = std::asin(-g.a2 * std::cos(q[1]) / g.d4) - q[1];
    if (std::abs(std::sin(q[4])) < 0.01) continue;  // a second singularity loses more digits
    const Pose X = Puma().Forward(q);
    const InverseSolutions solutions = Puma().Inverse(X, q);
    ExpectAllReproduce(Puma(), solutions, X);
    EXPECT_LT(NearestTurnError(solutions, q), 1e-5) << q.transpose();
  }
}

TEST(Singular, WristCentreOnAxisOneWithoutOffsetKeepsReference) {
  const Arm arm = Arm::FromUrdf(
      WriteUrdf("no_offset.urdf", PumaWith("xyz=\"0.650 0.190 0\"", "xyz=\"0.650 0 0\"")));
  const Pose X = Pose(Eigen::Translation3d(0, 0, 1.0)) * Eigen::AngleAxisd(1, Vector3::UnitX());
  Pose X_BaseFlange = X;
  X_BaseFlange.translation() += 0.125 * X.linear().col(2);
  const JointVector reference = Degrees(33, 0, 0, 0, 0, 0);
  const InverseSolutions solutions = arm.Inverse(X_BaseFlange, reference);
  ExpectAllReproduce(arm, solutions, X_BaseFlange);
  for (const InverseSolution& s : solutions) EXPECT_NEAR(s.q[0], 33 * kDegree, 1e-12);
}

TEST(Singular, WristCentreOnAxisTwo) {
  const Arm arm = Arm::FromUrdf(
      WriteUrdf("equal_lengths.urdf", PumaWith("xyz=\"0 0 0.600\"", "xyz=\"0 0 0.650\"")));
  const JointVector q = Degrees(20, -40, -90, 10, 30, 50);
  const Pose X = arm.Forward(q);
  const InverseSolutions solutions = arm.Inverse(X, q);
  ExpectAllReproduce(arm, solutions, X);
}

// The solution for given indicators is one of all solutions. This holds at singular poses, where
// two solutions may be equal, and out of reach, where there are none.
TEST(Inverse, OneAskedForByItsIndicatorsIsOneOfAll) {
  RandomStream random(8, "one of all");
  constexpr std::array kPlaces = {0.0, 0.5, 1.0};
  for (int i = 0; i < 5000; ++i) {
    JointVector q = RandomJoints(kPi, random);
    if (i % 3 == 1) q[4] = 0;
    if (i % 3 == 2) q[2] = std::atan2(Puma().geometry()->a3, Puma().geometry()->d4);
    Pose X = Puma().Forward(q);
    X.translation() *= 1 + kPlaces[static_cast<std::size_t>(random.Index(3))];
    const JointVector reference = RandomJoints(kPi, random);
    const InverseSolutions all = Puma().Inverse(X, reference);
    for (const Shoulder shoulder : {Shoulder::kRight, Shoulder::kLeft}) {
      for (const Elbow elbow : {Elbow::kAbove, Elbow::kBelow}) {
        for (const Wrist wrist : {Wrist::kNoFlip, Wrist::kFlip}) {
          const Indicators indicators = {shoulder, elbow, wrist};
          const auto known = std::ranges::find(all, indicators, &InverseSolution::indicators);
          const auto one = Puma().Inverse(X, indicators, reference);
          ASSERT_EQ(one.has_value(), known != all.end());
          if (one) {
            EXPECT_EQ(*one, known->q);
          }
        }
      }
    }
  }
}

TEST(Turns, NearestInRangeIsNearestRepresentative) {
  RandomStream random(10, "turns");
  int found = 0;
  for (int i = 0; i < 20000; ++i) {
    const JointVector q = RandomJoints(12, random);
    const JointVector reference = RandomJoints(6, random);
    const std::vector<JointVector> all = Puma().Representatives(q);
    const std::optional<JointVector> nearest = Puma().NearestInRange(q, reference);
    ASSERT_EQ(all.empty(), !nearest) << q.transpose();
    if (!nearest) continue;
    ++found;
    EXPECT_TRUE(Puma().InRange(*nearest));
    EXPECT_LT(TurnError(*nearest, q), 1e-9);
    for (const JointVector& other : all) {
      ASSERT_TRUE(Puma().InRange(other));
      ASSERT_LT(TurnError(other, q), 1e-9);
      ASSERT_TRUE(((*nearest - reference).cwiseAbs().array() <=
                   (other - reference).cwiseAbs().array() + 1e-9)
                      .all());
    }
  }
  EXPECT_GT(found, 1000);
}

TEST(Turns, JointsFourAndSixHaveTwoRepresentatives) {
  const JointVector q = Degrees(0, -90, 90, 100, 45, -100);
  const std::vector<JointVector> all = Puma().Representatives(q);
  ASSERT_EQ(all.size(), 4u);
  EXPECT_LT((all[0] - Degrees(0, -90, 90, -260, 45, -100)).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT((all[1] - Degrees(0, -90, 90, -260, 45, 260)).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT((all[2] - Degrees(0, -90, 90, 100, 45, -100)).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT((all[3] - Degrees(0, -90, 90, 100, 45, 260)).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(Turns, ShoulderBelowMinusHalfTurnIsInRange) {
  const JointVector q = Degrees(0, 170, 0, 0, 0, 0);
  EXPECT_FALSE(Puma().InRange(q));
  const std::optional<JointVector> nearest = Puma().NearestInRange(q, JointVector::Zero());
  ASSERT_TRUE(nearest);
  EXPECT_NEAR((*nearest)[1], -190 * kDegree, 1e-9);
}

TEST(Limits, BordersBelongToTheRange) {
  for (int i = 0; i < 6; ++i) {
    const JointLimits& limits = Puma().limits()[static_cast<std::size_t>(i)];
    JointVector q = Degrees(0, -90, 90, 0, 0, 0);
    q[i] = limits.upper;
    EXPECT_TRUE(Puma().InRange(q));
    q[i] = limits.upper + 1e-6;
    EXPECT_FALSE(Puma().InRange(q));
    q[i] = limits.lower;
    EXPECT_TRUE(Puma().InRange(q));
    q[i] = limits.lower - 1e-6;
    EXPECT_FALSE(Puma().InRange(q));
  }
}

TEST(Limits, NoRepresentativeInTheGap) {
  EXPECT_FALSE(Puma().NearestInRange(Degrees(0, 90, 0, 0, 0, 0), JointVector::Zero()));
  EXPECT_TRUE(Puma().Representatives(Degrees(0, 90, 0, 0, 0, 0)).empty());
}

// Arms that miss Lee and Ziegler's convention are solved as chains.
TEST(Inverse, OfOtherArmsIsThatOfChains) {
  const std::array<std::pair<std::string, std::string>, 4> changes = {
      {{"<child link=\"upper_arm\"/>\n    <origin xyz=\"0 0 0\"/>",
        "<child link=\"upper_arm\"/>\n    <origin xyz=\"0.1 0 0\"/>"},
       {"<origin xyz=\"0.650 0.190 0\"/>\n    <axis xyz=\"0 1 0\"/>",
        "<origin xyz=\"0.650 0.190 0\"/>\n    <axis xyz=\"0 -1 0\"/>"},
       {"<origin xyz=\"0.650 0.190 0\"/>\n    <axis xyz=\"0 1 0\"/>",
        "<origin xyz=\"0.650 0.190 0\"/>\n    <axis xyz=\"1 0 0\"/>"},
       {"<origin xyz=\"0 0 0.125\"/>", "<origin xyz=\"0.01 0 0.125\" rpy=\"0 0 1\"/>"}}};
  RandomStream random(9, "other arms");
  for (const auto& [from, to] : changes) {
    const Arm arm = Arm::FromUrdf(WriteUrdf("other_arm.urdf", PumaWith(from, to)));
    EXPECT_EQ(arm.geometry(), nullptr) << to;
    for (int i = 0; i < 300; ++i) {
      const JointVector q = RandomJoints(kPi, random);
      const Pose X = arm.LinkPoses(q).back();
      ASSERT_LT(PoseError(X, arm.Forward(q).matrix()), kTight) << to;
      const InverseSolutions solutions = arm.Inverse(X, q);
      EXPECT_LT(NearestTurnError(solutions, q), 1e-6) << to << q.transpose();
      for (const InverseSolution& s : solutions) {
        EXPECT_LT(PoseError(X, arm.LinkPoses(s.q).back().matrix()), 2 * kPoseTolerance) << to;
        EXPECT_EQ(s.indicators, arm.IndicatorsOf(s.q));
      }
    }
  }
}

}  // namespace
}  // namespace assay::kinematics::arm_test
