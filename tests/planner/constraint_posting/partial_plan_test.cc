#include "planner/constraint_posting/partial_plan.h"

#include <gtest/gtest.h>

#include "tests/planner/constraint_posting/scenarios.h"

namespace assay::constraint_posting::partial_plan_test {
namespace {

using domain::PartId;

// The null plan of Spar's worked example. The block must be turned, and the peg lies on its side.
class ExamplePlan : public ::testing::Test {
 protected:
  ExamplePlan() : problem_(LoadScenario("spar-example")), relations_(problem_) {}

  PartId Part(const std::string& name) const {
    for (std::size_t p = 0; p < problem_.parts.size(); ++p) {
      if (problem_.parts[p].name == name) return PartId(p);
    }
    return PartId::None();
  }

  // Establishes the first goal of the agenda by a new action, for which there is only one rule.
  StepId EstablishByNewStep(PartialPlan& plan) {
    const OperationalGoal goal = *plan.PopOperational();
    const StepId step = plan.AddStep(plan.Establishers(goal).front());
    EXPECT_TRUE(plan.Establish(step, goal));
    return step;
  }

  domain::Problem problem_;
  GeometricRelations relations_;
};

TEST_F(ExamplePlan, TheNullPlanHasTheUsersGoalsAlone) {
  const PartialPlan plan(problem_, relations_);
  EXPECT_EQ(plan.action_count(), 0);
  ASSERT_EQ(plan.goals().operational.size(), 1u);
  EXPECT_EQ(plan.Text(plan.ConditionOf(PartialPlan::kFinish, 0)), "assembled(peg, block)");
  EXPECT_TRUE(plan.goals().geometric.empty());
}

// In figure 6 the assemble action owns goals 1 to 5, two operational and three geometric ones.
TEST_F(ExamplePlan, AssembleBringsTheGoalsOfFigure6) {
  PartialPlan plan(problem_, relations_);
  const StepId assemble = EstablishByNewStep(plan);
  EXPECT_EQ(plan.step(assemble).kind, &domain::kAssemble);
  ASSERT_EQ(plan.goals().operational.size(), 2u);
  EXPECT_EQ(plan.Text(plan.ConditionOf(assemble, 0)), "holding(peg, Grasp)");
  EXPECT_EQ(plan.Text(plan.ConditionOf(assemble, 1)), "part_location(block, Position)");
  ASSERT_EQ(plan.goals().geometric.size(), 3u);
  EXPECT_EQ(plan.step(assemble).geometric[0].constraint.kind, domain::ConstraintKind::kMember);
  EXPECT_EQ(plan.step(assemble).geometric[1].constraint.kind,
            domain::ConstraintKind::kInPositionClass);
  EXPECT_EQ(plan.step(assemble).geometric[2].constraint.kind,
            domain::ConstraintKind::kMateReachable);
  // Only the pose on its back leaves the mating features of the block free and brings the mating
  // vector into the friction cone (Spar: [BP5]).
  const auto& poses = problem_.part(Part("block")).model->stable_poses();
  ASSERT_EQ(plan.step(assemble).geometric[1].constraint.labels.size(), 1u);
  EXPECT_EQ(poses[plan.step(assemble).geometric[1].constraint.labels[0]].name, "on-back");
}

// In figure 7 the pickup comes before the assemble, and the variable of the goal is the grasp of
// the pickup.
TEST_F(ExamplePlan, EstablishingBindsAndOrders) {
  PartialPlan plan(problem_, relations_);
  const StepId assemble = EstablishByNewStep(plan);
  const StepId pickup = EstablishByNewStep(plan);
  EXPECT_EQ(plan.step(pickup).kind, &domain::kPickup);
  EXPECT_TRUE(plan.ordering().Before(pickup, assemble));
  EXPECT_EQ(plan.Resolve(plan.step(assemble).grasp), plan.step(pickup).grasp);
  EXPECT_EQ(plan.Labels(plan.step(assemble).grasp).count(),
            domain::GraspLabelCount(problem_.part(Part("peg"))));
}

// Spar: "goal_4 ... fails (because the block is not initially resting in stable pose BP5)".
TEST_F(ExamplePlan, TheInitialPositionOfTheBlockIsNotInTheClass) {
  PartialPlan plan(problem_, relations_);
  const StepId assemble = EstablishByNewStep(plan);
  plan.PopOperational();  // holding(peg, ...)
  const OperationalGoal location = *plan.PopOperational();
  ASSERT_TRUE(plan.CanEstablish(PartialPlan::kStart, location));
  ASSERT_TRUE(plan.Establish(PartialPlan::kStart, location));
  EXPECT_FALSE(plan.Post({.consumer = assemble, .goal = 1}));
}

// action_4 (pickup block) violates gripper(open) of action_2 (pickup peg). action_3 (putdown block)
// re-establishes it: "an arc from action_3 to action_2".
TEST_F(ExamplePlan, AThreatenedGripperIsReopenedByThePutdown) {
  PartialPlan plan(problem_, relations_);
  EstablishByNewStep(plan);                                                  // action_1: assemble
  const StepId pickup_peg = EstablishByNewStep(plan);                        // action_2
  ASSERT_TRUE(plan.Establish(PartialPlan::kStart, *plan.PopOrdering()));     // gripper(open)
  ASSERT_TRUE(plan.Establish(PartialPlan::kStart, *plan.PopOperational()));  // part_location(peg)
  const StepId putdown = EstablishByNewStep(plan);  // action_3: for part_location(block)
  ASSERT_EQ(plan.step(putdown).kind, &domain::kPutdown);
  EXPECT_FALSE(plan.PopThreat().has_value());
  const StepId pickup_block = EstablishByNewStep(plan);  // action_4: for holding(block)
  const auto threat = plan.PopThreat();
  ASSERT_TRUE(threat.has_value());
  EXPECT_EQ(threat->violator, pickup_block);
  EXPECT_EQ(threat->link.consumer, pickup_peg);
  ASSERT_TRUE(plan.IsThreat(*threat));

  plan.Reopen(*threat);
  const OperationalGoal gripper = *plan.PopOrdering();
  EXPECT_EQ(plan.Text(plan.ConditionOf(gripper.consumer, gripper.precondition)), "gripper(open)");
  ASSERT_TRUE(plan.CanEstablish(putdown, gripper));
  ASSERT_TRUE(plan.Establish(putdown, gripper));
  EXPECT_TRUE(plan.ordering().Before(putdown, pickup_peg));
  EXPECT_TRUE(plan.ordering().Before(pickup_block, putdown));
}

TEST_F(ExamplePlan, PromotionPutsTheViolatorAfterTheConsumer) {
  PartialPlan plan(problem_, relations_);
  EstablishByNewStep(plan);
  const StepId pickup_peg = EstablishByNewStep(plan);
  ASSERT_TRUE(plan.Establish(PartialPlan::kStart, *plan.PopOrdering()));
  ASSERT_TRUE(plan.Establish(PartialPlan::kStart, *plan.PopOperational()));
  EstablishByNewStep(plan);
  const StepId pickup_block = EstablishByNewStep(plan);
  const auto threat = plan.PopThreat();
  ASSERT_TRUE(threat && plan.Promote(*threat));
  EXPECT_TRUE(plan.ordering().Before(pickup_peg, pickup_block));
  EXPECT_FALSE(plan.IsThreat(*threat));
}

// If two positions do not codesignate, a pickup of the block from one of them does not undo that
// the block is at the other.
TEST_F(ExamplePlan, SeparationKeepsTheTwoPositionsApart) {
  PartialPlan plan(problem_, relations_);
  const StepId assemble = EstablishByNewStep(plan);
  plan.PopOperational();                            // holding(peg) stays open
  const StepId putdown = EstablishByNewStep(plan);  // part_location(block, pos)
  const OperationalGoal holding = *plan.PopOperational();
  const StepId pickup = plan.AddStep(plan.Establishers(holding).front());  // establishes no goal
  const OperationalGoal location = *plan.PopOperational();
  const StepId other = plan.AddStep(plan.Establishers(location).front());  // a second putdown
  ASSERT_TRUE(plan.Establish(other, location));
  std::optional<Threat> threat;
  while ((threat = plan.PopThreat()) && threat->violator != pickup) {
  }
  ASSERT_TRUE(threat.has_value());
  ASSERT_EQ(threat->link.producer, putdown);
  ASSERT_EQ(threat->link.consumer, assemble);
  ASSERT_TRUE(plan.IsThreat(*threat));
  ASSERT_TRUE(plan.Separate(*threat));
  EXPECT_EQ(plan.network().arcs().size(), 1u);
  const auto poses = plan.Labels(plan.step(putdown).position);
  for (int label : poses) {
    EXPECT_FALSE(plan.network().arcs()[0].relation->Allows(label, label));
  }
}

// Constraint posting never leaves the network without a labeling: it refuses the constraint
// instead.
TEST_F(ExamplePlan, AnInconsistentConstraintIsRefused) {
  const domain::Problem problem = LoadScenario("spar-fig13");
  const GeometricRelations relations(problem);
  PartialPlan plan(problem, relations);
  const StepId assemble = EstablishByNewStep(plan);
  plan.PopOperational();
  const StepId putdown = EstablishByNewStep(plan);
  const StepId pickup = EstablishByNewStep(plan);
  ASSERT_TRUE(plan.Establish(PartialPlan::kStart, *plan.PopOperational()));  // part_location
  ASSERT_TRUE(plan.Post({.consumer = assemble, .goal = 1}));  // the block is on its back
  ASSERT_TRUE(plan.Post({.consumer = pickup, .goal = 0}));    // the grasp is reachable face down
  const GeometricGoalRef both{.consumer = putdown, .goal = 0};
  EXPECT_FALSE(plan.Post(both));  // no grasp is reachable in both poses
  EXPECT_EQ(plan.WhyRefused(both).size(), 3u);
  EXPECT_EQ(plan.WhyRefused(both).back(), plan.Text(plan.ConstraintOf(both)));
}

}  // namespace
}  // namespace assay::constraint_posting::partial_plan_test
