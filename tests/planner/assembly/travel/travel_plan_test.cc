#include "planner/assembly/travel/travel_plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "planner/assembly/certified_plan.h"
#include "planner/assembly/plan_check.h"
#include "planner/assembly/travel/travel_check.h"
#include "planner/assembly/travel/way_conditions.h"
#include "planner/motion/collision/motion_check.h"
#include "planner/motion/paths/straight_line.h"
#include "planner/plan/certificates/condition_table.h"
#include "planner/plan/certificates/not_covered.h"
#include "planner/plan/data/tool_route.h"
#include "tests/planner/constraint_posting/scenarios.h"

namespace assay::assembly::travel_plan_test {
namespace {

using domain::PartId;
using kinematics::JointVector;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::Field;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

const PartId kMast(2);

const domain::Problem& Mast() {
  static const domain::Problem problem = constraint_posting::LoadScenario("mast");
  return problem;
}

const plan::Plan& PlanBesideTheMast() {
  static const plan::Plan plan = MakeCertifiedPlan(Mast(), {}, {}).plan;
  return plan;
}

// Returns the steps to which the arm does not travel the usual way.
std::vector<plan::StepId> StepsByPath(const plan::Plan& plan) {
  std::vector<plan::StepId> steps;
  for (const plan::StepId id : plan.ExecutionOrder()) {
    if (!plan.step(id).travel->is_usual) steps.push_back(id);
  }
  return steps;
}

const plan::CertifiedPrecondition* Claim(const plan::PlannedStep& step, plan::Condition condition) {
  const auto& claims = step.certificate.preconditions;
  const auto found = std::ranges::find(claims, condition, &plan::CertifiedPrecondition::condition);
  return found == claims.end() ? nullptr : &*found;
}

// In the figures of the paper nothing is in the way.
TEST(TravelPlan, GoesTheUsualWayWhereItIsFree) {
  const domain::Problem problem = constraint_posting::LoadScenario("spar-fig15");
  const plan::PlanResult result = MakeCertifiedPlan(problem, {}, {});
  ASSERT_EQ(result.outcome, Outcome::kFound);
  EXPECT_THAT(StepsByPath(result.plan), IsEmpty());
  EXPECT_TRUE(result.plan.homing->is_usual);
  EXPECT_THAT(FlawsOfTravels(problem, result.plan), IsEmpty());
}

TEST(TravelPlan, SaysOfEachStepWhetherTheArmReaches) {
  for (const char* name : {"uncertain-known", "uncertain-squeezing"}) {
    const domain::Problem problem = constraint_posting::LoadScenario(name);
    const plan::Plan plan = MakeCertifiedPlan(problem, {}, {}).plan;
    for (const plan::PlannedStep& step : plan.steps) {
      for (const plan::Condition condition : {plan::Condition(plan::condition::kReach),
                                              plan::Condition(plan::condition::kWayClear)}) {
        const plan::CertifiedPrecondition* claim = Claim(step, condition);
        ASSERT_NE(claim, nullptr) << step.name << ", " << condition.name();
        EXPECT_TRUE(claim->holds()) << step.name << ", " << condition.name();
      }
    }
  }
}

TEST(TravelPlan, InPaperModeNothingIsSaidOfTheArm) {
  const domain::Problem problem = constraint_posting::LoadScenario("spar-fig15");
  const plan::Plan plan =
      MakeCertifiedPlan(problem, {}, {.propagation = uncertainty::Propagation::kPaper}).plan;
  for (const plan::PlannedStep& step : plan.steps) {
    EXPECT_EQ(Claim(step, plan::condition::kReach), nullptr);
  }
  EXPECT_THAT(FlawsOfTravels(problem, plan), IsEmpty());
}

// A plan is refused if a claim is stronger than the computed one, or if a posture is on the other
// side of the shoulder.
TEST(TravelPlan, WhatIsClaimedOfWaysIsComputedAnew) {
  const domain::Problem problem = constraint_posting::LoadScenario("uncertain-known");
  const plan::Plan plan = MakeCertifiedPlan(problem, {}, {}).plan;
  plan::Plan bragging = plan;
  for (auto& claim : bragging.steps[0].certificate.preconditions) {
    if (claim.condition == plan::condition::kReach) claim.bound = claim.margin = 2 * claim.bound;
  }
  EXPECT_THAT(FlawsOfTravels(problem, bragging),
              Contains(Field(&plan::Flaw::what, HasSubstr("the file says that reach is above"))));
  plan::Plan turned = plan;
  turned.steps[0].travel->path.front()[5] += 2 * M_PI;
  EXPECT_THAT(FlawsOfTravels(problem, turned),
              Contains(Field(&plan::Flaw::what, HasSubstr("in the posture in which"))));
}

// The plan names what it does not claim about the ways of the arm, including the way home.
TEST(TravelPlan, WhatIsNotClaimedOfWaysIsNamed) {
  const domain::Problem problem = constraint_posting::LoadScenario("uncertain-known");
  const plan::Plan plan = MakeCertifiedPlan(problem, {}, {}).plan;
  EXPECT_THAT(plan::NotCovered(problem, plan), Each(Not(HasSubstr(": step"))));
  for (std::size_t i = 0; i < plan.steps.size(); ++i) {
    plan::Plan silent = plan;
    auto& claims = silent.steps[i].certificate.preconditions;
    claims.erase(std::ranges::find(claims, plan::Condition(plan::condition::kReach),
                                   &plan::CertifiedPrecondition::condition));
    EXPECT_THAT(
        plan::NotCovered(problem, silent),
        Contains(HasSubstr("configuration: step " + std::to_string(silent.steps[i].executed))));
  }
}

TEST(TravelPlan, GoesAroundTheMast) {
  EXPECT_FALSE(StepsByPath(PlanBesideTheMast()).empty());
  EXPECT_THAT(FlawsOfTravels(Mast(), PlanBesideTheMast()), IsEmpty());
  EXPECT_THAT(assembly::Check(Mast(), PlanBesideTheMast(), 10).flaws, IsEmpty());
}

// Oracle: at every thousandth of each path, no link of the arm is nearer to the mast than the
// clearance that the plan claims.
TEST(TravelPlan, PathsKeepTheirClearance) {
  motion::Surroundings surroundings;
  for (std::size_t p = kMast.index(); p < Mast().parts.size(); ++p) {
    surroundings.parts.push_back({PartId(p), Mast().parts[p].X_WorldPart});
  }
  const motion::CollisionScene scene(Mast(), surroundings);
  for (const plan::StepId id : StepsByPath(PlanBesideTheMast())) {
    const plan::Travel& travel = *PlanBesideTheMast().step(id).travel;
    EXPECT_GE(travel.clearance, kTravelClearance);
    for (std::size_t i = 0; i + 1 < travel.path.size(); ++i) {
      for (int k = 0; k <= 1000; ++k) {
        const JointVector q = travel.path[i] + k / 1000.0 * (travel.path[i + 1] - travel.path[i]);
        const motion::LinkPoses X_BaseLink = scene.arm().LinkPoses(q);
        for (const motion::BodyPair& pair : scene.pairs()) {
          if (scene.IsCarried(pair.second) || scene.body(pair.first).name.find("mast") != 0)
            continue;
          ASSERT_GE(scene.Separation(pair, X_BaseLink, 1), travel.clearance);
        }
      }
    }
  }
}

// A path starts where the step before leaves the tool, and the executor continues from its end.
TEST(TravelPlan, PathsJoinTheStraightLines) {
  for (const plan::StepId id : StepsByPath(PlanBesideTheMast())) {
    const plan::PlannedStep& step = PlanBesideTheMast().step(id);
    if (step.action.Is(domain::kSense)) continue;
    const PartId part = plan::PlacedPart(Mast(), step.action);
    if (!step.action.Is(domain::kAssemble)) continue;
    const plan::ToolRoute route = plan::RouteOf(Mast(), step, Mast().part(part).X_WorldPart);
    const geometry::Pose end = motion::ToolAt(*Mast().workcell, step.travel->path.back());
    EXPECT_TRUE(end.isApprox(route.poised, 1e-6));
  }
}

// A plan that has ways of the arm has all of them. A plan that was written by hand may have no ways
// of the arm.
TEST(TravelPlan, NoWayMayBeLeftOut) {
  const domain::Problem problem = constraint_posting::LoadScenario("spar-fig15");
  const plan::Plan plan = MakeCertifiedPlan(problem, {}, {}).plan;
  plan::Plan tampered = plan;
  tampered.homing.reset();
  EXPECT_THAT(assembly::Check(problem, tampered, 10).flaws,
              ElementsAre(AllOf(Field(&plan::Flaw::step, plan::StepId::None()),
                                Field(&plan::Flaw::what, HasSubstr("none home")))));
  for (plan::PlannedStep& step : tampered.steps) step.travel.reset();
  EXPECT_THAT(FlawsOfTravels(problem, tampered),
              Contains(Field(&plan::Flaw::what, HasSubstr("none to this step")))
                  .Times(std::ssize(plan.steps)));
  for (plan::PlannedStep& step : tampered.steps) RemoveWayConditions(step.certificate);
  EXPECT_THAT(FlawsOfTravels(problem, tampered), IsEmpty());
}

TEST(TravelPlan, FlawsAreTold) {
  const plan::StepId step = StepsByPath(PlanBesideTheMast()).front();
  const auto expect = [&](const std::function<void(plan::Travel&)>& change, const char* words) {
    plan::Plan tampered = PlanBesideTheMast();
    change(*tampered.steps[step.index()].travel);
    EXPECT_THAT(FlawsOfTravels(Mast(), tampered),
                Contains(Field(&plan::Flaw::what, HasSubstr(words))));
  };
  expect([](plan::Travel& t) { t.path.front()[0] += 0.01; }, "does not start where");
  expect([](plan::Travel& t) { t.path.back()[4] += 0.01; }, "does not end where");
  expect([](plan::Travel& t) { t.clearance = 0; }, "a clearance of 0.00 mm is less");
  expect([](plan::Travel& t) { t.clearance = 0.2; }, "are nearer than");
  expect([](plan::Travel& t) { t.path = {t.path.front(), t.path.back()}; }, "and mast");
}

// The mast is moved by 5 cm to where the forearm is while the hand takes the peg.
TEST(TravelPlan, TellsWhatIsInTheWay) {
  domain::Problem problem = Mast();
  problem.parts[kMast.index()].X_WorldPart.translation().x() += 0.05;
  plan::Plan plan = PlanBesideTheMast();
  TravelEffort effort = {.budget = 2000};
  const auto obstruction = AddTravels(problem, effort, plan);
  ASSERT_TRUE(obstruction);
  EXPECT_THAT(obstruction->text, HasSubstr("no way to action_"));
  EXPECT_THAT(obstruction->text, HasSubstr("and mast are nearer than"));
  ASSERT_TRUE(obstruction->situation);
  const plan::Situation& situation = *obstruction->situation;
  ASSERT_EQ(situation.colliding.size(), 2u);
  EXPECT_EQ(situation.colliding[1].part, kMast);
  EXPECT_THAT(obstruction->text, HasSubstr("the " + situation.colliding[0].piece));
  ASSERT_TRUE(situation.hand && situation.hand->posture);
  const plan::Pose X_WorldTool = motion::ToolAt(*problem.workcell, *situation.hand->posture);
  EXPECT_TRUE(situation.hand->X_WorldTool.isApprox(X_WorldTool));
}

TEST(TravelPlan, SpendsNoMoreThanTheEffortThatIsLeft) {
  plan::Plan plan = PlanBesideTheMast();
  TravelEffort little = {.left = 10};
  const auto obstruction = AddTravels(Mast(), little, plan);
  ASSERT_TRUE(obstruction);
  EXPECT_THAT(obstruction->text, HasSubstr("no path was found"));
  EXPECT_EQ(little.left, 0);
  TravelEffort enough;
  EXPECT_FALSE(AddTravels(Mast(), enough, plan));
}

}  // namespace
}  // namespace assay::assembly::travel_plan_test
