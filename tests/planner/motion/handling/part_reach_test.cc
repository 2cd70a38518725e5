#include "planner/motion/handling/part_reach.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "planner/contingent/grounding/grounding.h"
#include "planner/contingent/pks_and_pddl/task_file.h"
#include "planner/contingent/plan_tree/tree_text.h"
#include "planner/contingent/search/contingent_planner.h"
#include "planner/domain/problem/problem_file.h"
#include "planner/geometry/pose.h"

namespace assay::motion::part_reach_test {
namespace {

constexpr PartId kBottle(0);
constexpr domain::RobotId kLeft(0);
constexpr domain::RobotId kRight(1);

const domain::Problem& Bottle() {
  static const domain::Problem problem = domain::ReadProblem(
      Document::Parse("format: assay-scenario/1\n"
                      "workcell: two-pumas\n"
                      "parts:\n"
                      "  bottle: {model: bottle, pose: {stable: upright, at: [-0.4, 0.1]}}\n"
                      "goal: [{located: {part: bottle, stable: [upright]}}]\n",
                      "bottle.yaml"),
      ASSAY_SOURCE_DIR "/models");
  return problem;
}

Pose At(double x, double y) {
  return geometry::Translation(x, y, 0) *
         Bottle()
             .part(kBottle)
             .model->stable_poses()[Bottle().part(kBottle).resting.index()]
             .X_TablePart;
}

const std::map<std::string, Pose>& Places() {
  static const std::map<std::string, Pose> places = {{"tableLeft", At(-0.40, 0.10)},
                                                     {"shared", At(0, 0)},
                                                     {"tableRight", At(0.40, 0.10)},
                                                     {"dishwasher", At(0.40, -0.20)}};
  return places;
}

bool Reaches(domain::RobotId robot, const std::string& place) {
  const domain::Problem problem = WorkedBy(Bottle(), robot);
  return !ServingGrasp(problem, kBottle, Places().at(place)).IsNone();
}

TEST(PartReach, EachRobotServesItsOwnHalfOfTheTable) {
  EXPECT_TRUE(Reaches(kLeft, "tableLeft"));
  EXPECT_TRUE(Reaches(kLeft, "shared"));
  EXPECT_FALSE(Reaches(kLeft, "tableRight"));
  EXPECT_FALSE(Reaches(kLeft, "dishwasher"));
  EXPECT_FALSE(Reaches(kRight, "tableLeft"));
  EXPECT_TRUE(Reaches(kRight, "shared"));
  EXPECT_TRUE(Reaches(kRight, "tableRight"));
  EXPECT_TRUE(Reaches(kRight, "dishwasher"));
}

// The workcell is symmetric under half a turn about z.
TEST(PartReach, RobotsThatStandAlikeServeAlike) {
  const domain::Problem right = WorkedBy(Bottle(), kRight);
  for (const auto& [name, X_WorldPart] : Places()) {
    const Pose turned = geometry::RotationZ(M_PI) * X_WorldPart;
    for (std::size_t grasp = 0; grasp < Bottle().part(kBottle).grasps->size(); grasp += 7) {
      EXPECT_EQ(CanServe(Bottle(), kBottle, GraspId(grasp), X_WorldPart),
                CanServe(right, kBottle, GraspId(grasp), turned))
          << name << ", grasp " << grasp;
    }
  }
}

// The plan must have five actions and a branch, and the bottle must be handed over at the place
// that both robots reach. The domain does not state which robot reaches what.
TEST(PartReach, HandOverEmergesFromGeometry) {
  const std::string folder = ASSAY_SOURCE_DIR "/scenarios/know/";
  const contingent::Task task =
      contingent::LoadTask(folder + "visual-sensing.pks", folder + "one-bottle.pks");
  contingent::Externs externs;
  externs.Add("isReachable", [](std::span<const std::string> arguments) {
    return Reaches(arguments[1] == "left" ? kLeft : kRight, arguments[0]);
  });
  const contingent::GroundTask ground = Ground(task.domain, task.problem, externs);
  Budget budget(100'000);
  const auto plan = MakePlan(ground, contingent::Wanted::kLeastDepth, budget);
  ASSERT_EQ(plan.outcome, Outcome::kFound);
  EXPECT_EQ(TextOf(ground, plan.tree, contingent::Sharing::kUnfolded),
            "senseIfEmpty(bottle)\n"
            "branch isEmptyBottle(bottle)\n"
            "  pickUp(left, bottle, tableLeft)\n"
            "  putDown(left, bottle, shared)\n"
            "  pickUp(right, bottle, shared)\n"
            "  putDown(right, bottle, dishwasher)\n"
            "branch !isEmptyBottle(bottle)\n");
}

}  // namespace
}  // namespace assay::motion::part_reach_test
