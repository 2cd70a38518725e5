#include "sim/check/measurements/observed_error.h"

#include <gtest/gtest.h>

#include "planner/domain/parts/part_file.h"
#include "planner/geometry/pose.h"
#include "tests/sim/execution/figure15.h"

namespace assay::check::observed_error_test {
namespace {

using domain::PartId;
using geometry::Pose;
using geometry::Vector3;

class ObservedErrorTest : public testing::Test {
 protected:
  ObservedErrorTest()
      : problem_(execution::Figure15()),
        plan_(execution::TwoActions(problem_)),
        peg_(execution::PartNamed(problem_, "peg")) {
    snapshot_.parts.resize(2);
  }
  execution::TrueAndBelieved& Peg() { return snapshot_.parts[peg_.index()]; }
  double Named(const std::vector<ObservedError>& errors, const std::string& name) const {
    for (const ObservedError& error : errors) {
      if (error.name == name + " of peg") return error.observed;
    }
    ADD_FAILURE() << name;
    return 0;
  }

  domain::Problem problem_;
  plan::Plan plan_;
  PartId peg_;
  execution::Snapshot snapshot_;
};

TEST_F(ObservedErrorTest, AtRestItIsDisplacedInTheWorldAndTurnedAboutTheVertical) {
  const Pose believed = problem_.part(peg_).X_WorldPart;
  Pose truth = geometry::RotationZ(0.03) * believed;
  truth.translation() = believed.translation() + Vector3(0.001, -0.002, 0.003);
  Peg() = {truth, believed};
  const plan::Action& pickup = plan_.step(plan::StepId(1)).action;
  const auto errors = ObservedErrors(
      problem_, pickup, {.part = peg_, .x = {}, .y = {}, .z = {}, .theta = {}}, snapshot_);
  EXPECT_EQ(errors.size(), 4u);
  EXPECT_NEAR(Named(errors, "x"), 0.001, 1e-12);
  EXPECT_NEAR(Named(errors, "y"), -0.002, 1e-12);
  EXPECT_NEAR(Named(errors, "z"), 0.003, 1e-12);
  EXPECT_NEAR(Named(errors, "theta"), 0.03, 1e-12);
}

// X_ToolGrasp = Tr(x, y, z) Rz(theta) Rx(tip) Ry(twist), in the frame of the hand's believed pose.
TEST_F(ObservedErrorTest, InTheHandItIsOfTheGraspedPoint) {
  const plan::Action& pickup = plan_.step(plan::StepId(1)).action;
  const Pose X_PartTool = pickup.hold.X_PartTool;
  Pose X_ToolGrasp = Pose::Identity();
  X_ToolGrasp.linear() =
      (Eigen::AngleAxisd(0.02, Vector3::UnitZ()) * Eigen::AngleAxisd(-0.03, Vector3::UnitX()) *
       Eigen::AngleAxisd(0.05, Vector3::UnitY()))
          .toRotationMatrix();
  X_ToolGrasp.translation() = Vector3(0.001, 0.002, -0.004);
  snapshot_.tool.believed = geometry::Translation(0.5, 0.1, 0.4) * geometry::RotationZ(1);
  snapshot_.tool.truth = Pose::Identity();  // the true tool pose does not matter
  Peg().truth = snapshot_.tool.believed * X_ToolGrasp * X_PartTool.inverse();
  const auto errors = ObservedErrors(
      problem_, pickup, {.part = peg_, .in_hand = true, .x = {}, .y = {}, .z = {}, .theta = {}},
      snapshot_);
  EXPECT_EQ(errors.size(), 6u);
  EXPECT_NEAR(Named(errors, "x"), 0.001, 1e-12);
  EXPECT_NEAR(Named(errors, "y"), 0.002, 1e-12);
  EXPECT_NEAR(Named(errors, "z"), -0.004, 1e-12);
  EXPECT_NEAR(Named(errors, "theta"), 0.02, 1e-12);
  EXPECT_NEAR(Named(errors, "tip"), -0.03, 1e-12);
  EXPECT_NEAR(Named(errors, "twist"), 0.05, 1e-12);
}

// The origin of the peg is on its body, whose least extent is 3 inches. The other part's origin is
// 30 mm above a corner's edge and 40 mm beside it.
TEST_F(ObservedErrorTest, TheLeverIsTheDistanceOfTheOriginFromTheBody) {
  const Lever of_peg = LeverOf(*problem_.part(peg_).model);
  EXPECT_EQ(of_peg.length, 0);
  EXPECT_NEAR(of_peg.arm, 0.0381, 1e-9);
  const auto far = domain::PartFile::Read(
      Document::Parse("format: assay-part/1\n"
                      "name: far\n"
                      "initial: F\n"
                      "units: {length: mm, angle: degree}\n"
                      "density: 1000\n"
                      "friction: 0.25\n"
                      "solids: {body: {box: [[40, -10, -50], [100, 10, -30]]}}\n"
                      "features: {1: {face: body, normal: [0, 0, 1], what: top}}\n"
                      "stable_poses: {flat: [0, 0, -1]}\n",
                      "part.yaml"),
      0.0005);
  EXPECT_NEAR(LeverOf(*far).length, 0.05, 1e-9);
  EXPECT_NEAR(LeverOf(*far).arm, 0.01, 1e-9);
}

}  // namespace
}  // namespace assay::check::observed_error_test
