#include <gtest/gtest.h>

#include <map>

#include "planner/geometry/pose.h"
#include "sim/execution/walk/executor.h"
#include "tests/planner/plan/actions.h"
#include "tests/sim/execution/figure15.h"

namespace assay::execution::sense_and_squeeze_test {
namespace {

constexpr double kStays = 1e-4;  // metres

// Returns the plan of Spar's figure 15 with three more steps. Before the pickup, a camera that
// measures no heights looks at the peg, and the hand squeezes it. The camera then looks at the
// block while the peg is in the hand.
plan::Plan CarefulPlan(const domain::Problem& problem) {
  plan::Plan plan = TwoActions(problem);
  const plan::Action pickup = plan.steps[1].action;
  const PartId block = PartNamed(problem, "block");
  const plan::Place on_back{"initial", problem.part(block).X_WorldPart};
  plan.steps[0].executed = 5;
  plan.steps[1].executed = 3;
  plan.steps.push_back({"action_3", plan::Sense(pickup.part, "coarse-camera", pickup.place), 3, 1});
  plan.steps.push_back({"action_4", plan::Squeeze(pickup.part, pickup.hold, pickup.place), 4, 2});
  plan.steps.push_back({"action_5", plan::Sense(block, "coarse-camera", on_back), 5, 4});
  return plan;
}

// The plan is executed once for all tests, for each way in which the gripper can hold a part.
class CarefullyExecuted : public testing::TestWithParam<scene::GraspMode> {
 protected:
  CarefullyExecuted()
      : problem_(Executed().problem),
        peg_(PartNamed(problem_, "peg")),
        start_(Executed().start),
        trace_(Executed().trace) {}

  const Snapshot& AfterStep(int executed) const {
    return trace_.All<StepEnd>()[static_cast<std::size_t>(executed) - 1]->snapshot;
  }

 private:
  struct Result {
    domain::Problem problem;
    Pose start;  // of the peg
    Trace trace;
  };
  static Result Execution(scene::GraspMode grasp) {
    Result result{.problem = Figure15(), .start = {}, .trace = {}};
    const scene::Scene scene(result.problem, {.grasp = grasp});
    mujoco::Data data = scene.Start();
    result.start = scene.TruePose(data, PartNamed(result.problem, "peg"));
    result.trace = Execute(result.problem, CarefulPlan(result.problem), scene, data, {});
    return result;
  }
  static const Result& Executed() {
    static std::map<scene::GraspMode, Result> results;
    if (!results.contains(GetParam())) results.emplace(GetParam(), Execution(GetParam()));
    return results.at(GetParam());
  }

 protected:
  const domain::Problem& problem_;
  PartId peg_;
  const Pose& start_;
  const Trace& trace_;
};
INSTANTIATE_TEST_SUITE_P(Grasps, CarefullyExecuted,
                         testing::Values(scene::GraspMode::kFriction, scene::GraspMode::kWeld));

TEST_P(CarefullyExecuted, ASqueezeWithoutNoiseLeavesThePartInItsPlace) {
  ASSERT_EQ(trace_.end().outcome, TrialOutcome::kSucceeded) << trace_.end().reason;
  const TrueAndBelieved& peg = AfterStep(2).parts[peg_.index()];
  EXPECT_LT((peg.truth.translation() - start_.translation()).norm(), kStays);
  EXPECT_LT(geometry::AngleBetween(peg.truth.linear(), start_.linear()), 1e-3);
  EXPECT_TRUE(peg.believed.isApprox(trace_.All<LookRecord>()[0]->believed, 1e-12));
  for (const auto& [a, b] : AfterStep(2).contacts) {
    EXPECT_FALSE(a.starts_with("gripper/") && b == "part/peg") << a << " still touches it";
  }
  EXPECT_NEAR(AfterStep(2).opening, problem_.workcell->gripper().max_opening(), 1e-3);
}

TEST_P(CarefullyExecuted, TheSqueezeIsAGraspThatHolds) {
  const auto facts = trace_.All<GraspFact>();
  ASSERT_EQ(facts.size(), 2u);
  EXPECT_TRUE(facts[0]->holds());
  EXPECT_TRUE(facts[1]->holds());
}

TEST_P(CarefullyExecuted, ThePlanGoesOnAsIfNothingHadHappened) {
  ASSERT_EQ(trace_.end().outcome, TrialOutcome::kSucceeded) << trace_.end().reason;
  const TrueAndBelieved& peg = trace_.end().snapshot.parts[peg_.index()];
  EXPECT_LT((peg.truth.translation() - peg.believed.translation()).norm(), 2e-4);
}

// Without noise, the sensor measures the true pose. The believed place and yaw become the measured
// ones, and the believed height stays.
TEST_P(CarefullyExecuted, LooksUpdateTheBelief) {
  const auto looks = trace_.All<LookRecord>();
  ASSERT_EQ(looks.size(), 2u);
  EXPECT_EQ(looks[0]->part, peg_);
  EXPECT_EQ(looks[1]->part, PartNamed(problem_, "block"));
  EXPECT_GT(looks[1]->time, looks[0]->time);
  for (const LookRecord* look : looks) {
    EXPECT_EQ(look->sensor, "coarse-camera");
    EXPECT_TRUE(look->found);
    EXPECT_EQ(look->measured.matrix(), look->before.truth.matrix());
    EXPECT_EQ(look->before.believed.matrix(), problem_.part(look->part).X_WorldPart.matrix());
    EXPECT_LT((look->believed.translation() - look->measured.translation()).head<2>().norm(),
              1e-12);
    EXPECT_EQ(look->believed.translation().z(), look->before.believed.translation().z());
  }
  EXPECT_GT(AfterStep(4).parts[peg_.index()].truth.translation().z(), 0.2) << "in the hand";
}

}  // namespace
}  // namespace assay::execution::sense_and_squeeze_test
