#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "planner/geometry/box.h"
#include "planner/geometry/solids/mass_properties.h"
#include "planner/plan/certificates/condition_table.h"
#include "planner/uncertainty/preconditions/certify.h"
#include "tests/planner/plan/actions.h"
#include "tests/planner/uncertainty/action_lists.h"

namespace assay::uncertainty::hand_clearance_test {
namespace {

// Returns the corners of hand and fingers, world frame, at the grasp of the peg and above it.
std::vector<Vector3> HandCorners(const domain::Problem& problem, const Pose& X_WorldTool,
                                 double width) {
  const kinematics::Gripper& gripper = problem.workcell->gripper();
  std::vector<geometry::Box> boxes = gripper.HandBoxes();
  for (const double opening : {width, gripper.max_opening()}) {
    for (const geometry::Box& box : gripper.FingerBoxes(opening)) boxes.push_back(box);
  }
  std::vector<Vector3> corners;
  for (const double back : {0.0, problem.workcell->rules().approach_distance}) {
    for (const geometry::Box& box : boxes) {
      for (const Vector3& corner : box.Corners()) {
        corners.push_back(X_WorldTool * (corner - back * Vector3::UnitZ()));
      }
    }
  }
  return corners;
}

// The pickup of the peg of figure 15 with the block beside the hand. Only the block's x and y have
// errors.
class BesideTheHand : public ::testing::Test {
 protected:
  BesideTheHand() {
    for (domain::Part& part : problem_.parts) part.error = {};
    problem_.gripper_error = {};
    // Takes the normal of a vertical side of the block.
    const geometry::Matrix3 axes = problem_.part(block_).X_WorldPart.linear();
    for (int i = 0; i < 3 && !normal_; ++i) {
      if (std::abs(axes(2, i)) < 1e-9) normal_ = axes.col(i);
    }
  }

  // Returns the least margin of "hand clear" if the block's side is `gap` metres from the hand.
  double Margin(double gap, double error) {
    domain::Part& block = problem_.parts[block_.index()];
    const Pose X_WorldTool = problem_.part(peg_).X_WorldPart * hold_.X_PartTool;
    double hand = -std::numeric_limits<double>::infinity();
    for (const Vector3& corner : HandCorners(problem_, X_WorldTool, hold_.width)) {
      hand = std::max(hand, normal_->dot(corner));
    }
    double side = std::numeric_limits<double>::infinity();
    for (const Vector3& v : block.model->corners()) {
      side = std::min(side, normal_->dot(block.X_WorldPart * v));
    }
    const Vector3 along = normal_->cross(Vector3::UnitZ());
    const Vector3 off = X_WorldTool.translation() - block.X_WorldPart * block.model->mass().center;
    block.X_WorldPart.translation() += (hand + gap - side) * *normal_ + along.dot(off) * along;
    block.error.x = {-error, error};
    block.error.y = {-error, error};

    UncertainWorld world(problem_, Propagation::kSound);
    const plan::Action pickup =
        plan::Pickup(peg_, hold_, {"initial", problem_.part(peg_).X_WorldPart});
    double margin = std::numeric_limits<double>::infinity();
    for (const auto& claim : CertifyStep(world, pickup, {}).certificate.preconditions) {
      if (claim.condition == plan::condition::kHandClear) margin = std::min(margin, claim.margin);
    }
    return margin;
  }

  domain::Problem problem_ = LoadScenario("spar-fig15");
  const PartId peg_ = PartNamed(problem_, "peg");
  const PartId block_ = PartNamed(problem_, "block");
  const plan::Hold hold_ = HoldsAtStart(problem_, peg_).at(0);
  std::optional<Vector3> normal_;
};

// An error of e in x and in y moves the side by e (|n_x| + |n_y|) along its normal n.
TEST_F(BesideTheHand, MarginIsTheGapLessTheError) {
  ASSERT_TRUE(normal_);
  const double error = 0.002;
  const double reach = error * normal_->cwiseAbs().sum();
  for (const double gap : {-0.001, 0.5 * reach, 0.99 * reach}) {
    EXPECT_NEAR(Margin(gap, error), gap - reach, 1e-6) << gap;
  }
}

// No precondition is made for a body that no error brings near the hand.
TEST_F(BesideTheHand, FarOffNothingIsRequired) {
  ASSERT_TRUE(normal_);
  const double reach = 0.002 * normal_->cwiseAbs().sum();
  EXPECT_EQ(Margin(1.01 * reach, 0.002), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace assay::uncertainty::hand_clearance_test
