#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "planner/geometry/pose.h"
#include "planner/plan/certificates/condition_table.h"
#include "planner/uncertainty/preconditions/certify.h"
#include "tests/oracle/certified_expressions.h"
#include "tests/planner/plan/actions.h"
#include "tests/planner/uncertainty/action_lists.h"

// Computes the worked example of Spar ("Derivation of Uncertainty-Reduction Goals") by CertifyStep.
// As in the paper the gripper opens 4 inches, and the block is 3 inches wide. The block stands on
// its end with its axes along the world's. The gripper comes from above with its y axis along the
// world's x axis, 1 inch along y from the block's origin.
namespace assay::uncertainty::worked_example_test {
namespace {

using ::testing::Each;
using ::testing::Field;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr PartId kBlock(0);

domain::Problem WorkedExample() {
  domain::Problem problem = LoadScenario("spar-example");
  problem.parts[kBlock.index()].X_WorldPart = geometry::Translation(24 * kInch, 4 * kInch, 0);
  return problem;
}

plan::Action PickupOf(const domain::Problem& problem) {
  const Pose X_PartTool = geometry::PoseFromColumns(
      Vector3::UnitY(), Vector3::UnitX(), -Vector3::UnitZ(), Vector3(1.5, 1.0, 6) * kInch);
  return plan::Pickup(kBlock, {"across x", X_PartTool, 3 * kInch},
                      {"on-end", problem.part(kBlock).X_WorldPart});
}

CertifiedStep CertifyPaper(const domain::Problem& problem, algebra::BoundingMethod highest) {
  UncertainWorld world(problem, Propagation::kPaper);
  return CertifyStep(world, PickupOf(problem), {.highest = highest});
}

// The values are those of table 2 with its erratum (the leading constant, and angles in degrees).
TEST(WorkedExample, TermwiseBoundsOfTheFourPreconditions) {
  const auto step = CertifyPaper(WorkedExample(), algebra::BoundingMethod::kTermwise);
  const auto& claims = step.certificate.preconditions;
  ASSERT_THAT(claims, SizeIs(4));
  EXPECT_THAT(claims, Each(Field(&plan::CertifiedPrecondition::condition,
                                 plan::Condition(plan::condition::kBetweenFingers))));
  EXPECT_THAT(claims, Each(Field(&plan::CertifiedPrecondition::method, "termwise")));
  // The bounds are INF y(P1^-1 C1), INF y(P1^-1 C2), SUP y(P2^-1 C1) and SUP y(P2^-1 C2), in
  // inches.
  std::vector<double> inches;
  for (const auto& claim : claims) inches.push_back(claim.bound / kInch);
  std::ranges::sort(inches);
  EXPECT_NEAR(inches[0], -3.2931, 5.1e-5);
  EXPECT_NEAR(inches[1], -0.2931, 5.1e-5);
  EXPECT_NEAR(inches[2], 0.2931, 5.1e-5);
  EXPECT_NEAR(inches[3], 3.279301, 1e-6);
  EXPECT_THAT(step.unproved, IsEmpty());
}

TEST(WorkedExample, TheExpressionOfTheCertificateHasTheTrueMinimum) {
  const auto step = CertifyPaper(WorkedExample(), algebra::BoundingMethod::kTermwise);
  algebra::ExpressionPool pool;
  const std::vector<Expression> expressions = oracle::CertifiedExpressions(step.certificate, pool);
  const auto& claims = step.certificate.preconditions;
  const auto greatest = std::ranges::max_element(claims, {}, &plan::CertifiedPrecondition::bound);
  const Expression& e = expressions[greatest - claims.begin()];
  const auto refined = algebra::BoundBelow(e, algebra::DeclaredBox(pool), {.gap = 1e-9});
  EXPECT_NEAR(refined.value / kInch, 3.279336, 1e-6);
}

struct Failing {
  double theta = 5.5;  // degrees
  double dx = 0.11;    // inches
};

bool Proved(const Failing& errors, algebra::BoundingMethod highest) {
  domain::Problem problem = WorkedExample();
  domain::PoseError& error = problem.parts[kBlock.index()].error;
  error.theta = {-errors.theta * kDegree, errors.theta * kDegree};
  error.x = {-errors.dx * kInch, errors.dx * kInch};
  return CertifyPaper(problem, highest).unproved.empty();
}

TEST(WorkedExample, StopsBeingProvable) {
  for (const auto highest :
       {algebra::BoundingMethod::kTermwise, algebra::BoundingMethod::kBranchAndBound}) {
    EXPECT_TRUE(Proved({.theta = 22.8}, highest));
    EXPECT_FALSE(Proved({.theta = 22.9}, highest));
    EXPECT_TRUE(Proved({.dx = 0.403}, highest));
    EXPECT_FALSE(Proved({.dx = 0.404}, highest));
  }
}

Interval Inches(double half) { return {-half * kInch, half * kInch}; }
void ExpectNear(const Interval& actual, const Interval& expected) {
  EXPECT_NEAR(actual.low, expected.low, 1e-9);
  EXPECT_NEAR(actual.high, expected.high, 1e-9);
}

// T'_d is the error of the object's origin in the axes of the hand. Its y and its rotation come
// from the hand alone.
TEST(WorkedExample, AfterPickupThePublishedSet) {
  const auto after =
      CertifyPaper(WorkedExample(), algebra::BoundingMethod::kTermwise).certificate.after;
  ASSERT_THAT(after, SizeIs(1));
  EXPECT_TRUE(after[0].in_hand);
  ExpectNear(after[0].x, Inches(0.111));
  ExpectNear(after[0].y, Inches(0.001));
  ExpectNear(after[0].z, Inches(0.111));
  ExpectNear(after[0].theta, {-0.001 * kDegree, 0.001 * kDegree});
  EXPECT_EQ(after[0].twist, (Interval{0, 0}));
}

// The displacement is R_T R_G [t' - (R' - I) R_G^t t_G]. The yaw is -tg for a tool that points
// down, and the height is that of the table.
TEST(WorkedExample, AfterPutdownThePublishedSet) {
  domain::Problem problem = WorkedExample();
  problem.gripper_error = Symmetric(0.001 * kInch, 2 * kDegree);
  const plan::Action pickup = PickupOf(problem);
  const Pose X_Target = geometry::Translation(0.5, 0.1, 0) * geometry::RotationZ(0.7);
  UncertainWorld world(problem, Propagation::kPaper);
  CertifyStep(world, pickup, {});
  const auto after =
      CertifyStep(world, plan::Putdown(kBlock, pickup.hold, {"on-end", X_Target}), {})
          .certificate.after;
  ASSERT_THAT(after, SizeIs(1));
  ExpectNear(after[0].theta, {-2 * kDegree, 2 * kDegree});
  ExpectNear(after[0].z, Inches(0.11));
  // Computes the extremes over the corners of the error box, and over the angle in small steps.
  const geometry::Matrix3 R_G = pickup.hold.X_PartTool.linear();
  const Vector3 t_G = pickup.hold.X_PartTool.translation();
  Vector3 most = Vector3::Zero();
  for (int corner = 0; corner < 4; ++corner) {
    for (int step = -200; step <= 200; ++step) {
      const Vector3 t((corner & 1 ? 0.111 : -0.111) * kInch, (corner & 2 ? 0.001 : -0.001) * kInch,
                      0);
      const geometry::Matrix3 R = geometry::RotationZ(step * 0.01 * kDegree).linear();
      const Vector3 d = X_Target.linear() * R_G *
                        (t - (R - geometry::Matrix3::Identity()) * R_G.transpose() * t_G);
      most = most.cwiseMax(d);
    }
  }
  EXPECT_NEAR(after[0].x.high, most.x(), 1e-6);
  EXPECT_NEAR(after[0].y.high, most.y(), 1e-6);
  EXPECT_GE(after[0].x.high, most.x() - 1e-12);
  EXPECT_GE(after[0].y.high, most.y() - 1e-12);
}

}  // namespace
}  // namespace assay::uncertainty::worked_example_test
