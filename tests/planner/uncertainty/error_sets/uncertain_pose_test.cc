#include "planner/uncertainty/error_sets/uncertain_pose.h"
#include "planner/algebra/expression/evaluation.h"

#include <gtest/gtest.h>

#include "planner/geometry/pose.h"
#include "tests/oracle/random_pose.h"

namespace assay::uncertainty::uncertain_pose_test {
namespace {

void ExpectSame(const Transform& symbolic, const Pose& numeric) {
  for (int row = 0; row < 3; ++row) {
    const auto at = [](const Expression& e) {
      return algebra::Evaluate(e, std::span<const double>());
    };
    for (int column = 0; column < 3; ++column) {
      EXPECT_NEAR(at(symbolic.rotation[row][column]), numeric.linear()(row, column), 1e-12);
    }
    EXPECT_NEAR(at(symbolic.translation[row]), numeric.translation()[row], 1e-12);
  }
}

Pose HandError(const Vector3& d, double theta) {
  return geometry::Translation(d) * geometry::RotationZ(theta);
}

TEST(UncertainPose, RightAnglesAreExact) {
  const Transform t = AsTransform(geometry::RotationZ(1.5707963267948966));
  EXPECT_TRUE(t.rotation[0][0].IsConstant(0));
  EXPECT_TRUE(t.rotation[1][0].IsConstant(1));
  EXPECT_TRUE(t.rotation[0][1].IsConstant(-1));
}

// The published transforms are T_dM = Trans RotZ, T_(O+d) = Tr_dO Tr_O R_dO R_O, and T_M T'_d
// T_G^-1.
TEST(UncertainPose, ComposesAsPublished) {
  RandomStream random(4, "poses");
  for (int i = 0; i < 50; ++i) {
    const Pose X = oracle::RandomPose(random, 1);
    const Vector3 d = oracle::RandomVector(random, 0.1);
    const double theta = random.Uniform(-1, 1);
    ExpectSame(AsTransform(X), X);
    ExpectSame(ManipulatorError{d.x(), d.y(), d.z(), theta}.AsTransform(), HandError(d, theta));
    Pose turned = Pose::Identity();
    turned.linear() = X.linear();
    ExpectSame(PossiblePose(X, {{d.x(), d.y(), d.z()}, theta}),
               geometry::Translation(d) * geometry::Translation(X.translation()) *
                   geometry::RotationZ(theta) * turned);
    const Pose grasp = oracle::RandomPose(random, 1), error = oracle::RandomPose(random, 0.1);
    ExpectSame(PossibleHeldPose(X, AsTransform(error), grasp), X * error * grasp.inverse());
  }
}

TEST(UncertainPose, TheHeldErrorIsAboutTheCommandedHandInPaperModeAndAboutTheTrueOneInSoundMode) {
  RandomStream random(5, "grasps");
  for (int i = 0; i < 50; ++i) {
    const Vector3 d = oracle::RandomVector(random, 0.1), h = oracle::RandomVector(random, 0.1);
    const double theta = random.Uniform(-1, 1), twist = random.Uniform(-1, 1);
    const ManipulatorError draw{d.x(), d.y(), d.z(), theta};
    ExpectSame(PossibleGrasp({.x = h.x(), .z = h.z()}, draw, Propagation::kPaper),
               HandError(d + Vector3(h.x(), 0, h.z()), theta));
    const double skew = random.Uniform(-1, 1), tip = random.Uniform(-1, 1);
    const HeldError held = {
        .x = h.x(), .z = h.z(), .twist = twist, .y = h.y(), .skew = skew, .tip = tip};
    ExpectSame(PossibleGrasp(held, draw, Propagation::kSound),
               HandError(d, theta) * geometry::Translation(h) * geometry::RotationZ(skew) *
                   geometry::RotationX(tip) * geometry::RotationY(twist));
  }
}

}  // namespace
}  // namespace assay::uncertainty::uncertain_pose_test
