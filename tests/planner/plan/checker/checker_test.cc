#include "planner/plan/checker/checker.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "planner/base/random.h"
#include "planner/domain/parts/part_model.h"
#include "planner/geometry/pose.h"
#include "planner/plan/certificates/not_covered.h"
#include "tests/oracle/random_pose.h"
#include "tests/planner/plan/actions.h"
#include "tests/planner/plan/peg_and_block.h"

namespace assay::plan {

void PrintTo(const Flaw& flaw, std::ostream* out) {
  *out << "step " << flaw.step.index() << ": " << flaw.what;
}

namespace {

using geometry::RotationX;
using geometry::RotationY;
using geometry::RotationZ;
using geometry::Translation;
using testing::Contains;
using testing::Field;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

constexpr int kAllOrders = 1000;
constexpr std::uint64_t kSeed = 21;

auto FlawAt(int step, const std::string& words) {
  return Contains(testing::AllOf(Field(&Flaw::step, step < 0 ? StepId::None() : StepId(step)),
                                 Field(&Flaw::what, HasSubstr(words))));
}

// Figure 14 with its plan. The steps 0 to 3 are in the order of execution.
class FourStepPlan : public testing::Test {
 protected:
  std::vector<Flaw> Flaws() const { return Check(problem_, plan_, kAllOrders).flaws; }
  Action& TakeBlock() { return plan_.steps[0].action; }
  Action& PutBlock() { return plan_.steps[1].action; }
  Action& TakePeg() { return plan_.steps[2].action; }
  Action& Mate() { return plan_.steps[3].action; }

  void HoldPegWith(const Hold& hold) {
    TakePeg().hold = hold;
    Mate().hold = hold;
  }
  void HoldBlockWith(const Hold& hold) {
    TakeBlock().hold = hold;
    PutBlock().hold = hold;
  }
  void PutBlockAt(const Pose& X_WorldBlock) {
    PutBlock().place.X_WorldPart = X_WorldBlock;
    Mate().place.X_WorldPart = X_WorldBlock;
  }
  const Pose& X_WorldBlock() { return PutBlock().place.X_WorldPart; }

  domain::Problem problem_ = PegAndBlock(BlockOnEnd());
  Plan plan_ = FourSteps(problem_);
};

TEST(Check, AcceptsTheTwoStepsOfFigure15) {
  const domain::Problem problem = PegAndBlock({});
  const CheckReport report = Check(problem, TwoSteps(problem), kAllOrders);
  EXPECT_THAT(report.flaws, IsEmpty());
  EXPECT_EQ(report.linearizations, 1);
  EXPECT_TRUE(report.all_orders);
}

TEST_F(FourStepPlan, IsAccepted) {
  const CheckReport report = Check(problem_, plan_, kAllOrders);
  EXPECT_THAT(report.flaws, IsEmpty());
  EXPECT_TRUE(report.all_orders);
}

domain::Problem Scenario(const std::string& name) {
  return domain::ReadProblem(Document::Load(ASSAY_SOURCE_DIR "/scenarios/" + name + ".yaml"),
                             ASSAY_SOURCE_DIR "/models");
}

TEST(Check, AcceptsPlansByHandForTheScenariosOfThePaper) {
  const domain::Problem figure_15 = Scenario("spar-fig15");
  EXPECT_THAT(Check(figure_15, TwoSteps(figure_15), kAllOrders).flaws, IsEmpty());
  const domain::Problem figure_14 = Scenario("spar-fig14");
  EXPECT_THAT(Check(figure_14, FourSteps(figure_14), kAllOrders).flaws, IsEmpty());
}

TEST(Check, AcceptsAnEmptyPlanForGoalsThatHoldAlready) {
  const domain::Problem problem =
      PegAndBlock({.goals = "  - located: {part: block, stable: [on-end, on-back]}\n"});
  EXPECT_THAT(Check(problem, {.problem = problem.name, .steps = {}, .ordering = {}}, 1).flaws,
              IsEmpty());
}

// Tests of orders.

TEST(Check, FindsSwappedExecution) {
  const domain::Problem problem = PegAndBlock({});
  Plan plan = TwoSteps(problem);
  std::swap(plan.steps[0].executed, plan.steps[1].executed);
  const std::vector<Flaw> flaws = Check(problem, plan, kAllOrders).flaws;
  EXPECT_THAT(flaws, FlawAt(0, "the hand is empty"));
  EXPECT_THAT(flaws, FlawAt(0, "executed before action_2"));
  EXPECT_THAT(flaws, FlawAt(-1, "they are not mated"));
}

TEST_F(FourStepPlan, FindsThatAMissingOrderingAdmitsABadLinearization) {
  plan_.ordering = {{StepId(0), StepId(1)}, {StepId(2), StepId(3)}};
  const CheckReport report = Check(problem_, plan_, kAllOrders);
  EXPECT_EQ(report.linearizations, 6);
  EXPECT_TRUE(report.all_orders);
  EXPECT_THAT(report.flaws, FlawAt(2,
                                   "gripper(open) does not hold: the hand holds block (in the "
                                   "order action_1, action_3"));
  EXPECT_THAT(report.flaws, FlawAt(3, "part_location(block"));
}

TEST_F(FourStepPlan, InTheOrderOfExecutionAloneHidesAMissingOrdering) {
  plan_.ordering = {{StepId(0), StepId(1)}, {StepId(2), StepId(3)}};
  const CheckReport report = Check(problem_, plan_, 1);
  EXPECT_THAT(report.flaws, IsEmpty());
  EXPECT_EQ(report.linearizations, 1);
  EXPECT_FALSE(report.all_orders);
}

TEST_F(FourStepPlan, FindsACyclicOrdering) {
  plan_.ordering.emplace_back(StepId(3), StepId(0));
  EXPECT_THAT(Flaws(), FlawAt(-1, "cyclic"));
}

TEST_F(FourStepPlan, FindsExecutionNumbersThatAreNoPermutation) {
  plan_.steps[2].executed = 2;
  EXPECT_THAT(Flaws(), FlawAt(2, "executed as number 2"));
}

TEST_F(FourStepPlan, FindsStepsAndPartsThatDoNotExist) {
  plan_.ordering.emplace_back(StepId(1), StepId(7));
  TakeBlock().part = PartId(2);
  const std::vector<Flaw> flaws = Flaws();
  EXPECT_THAT(flaws, FlawAt(-1, "a step that the plan has not"));
  EXPECT_THAT(flaws, FlawAt(0, "a part or mating that the problem does not have"));
}

// Tests of preconditions and goals.

TEST_F(FourStepPlan, FindsAGoalThatIsNotReached) {
  plan_.steps.pop_back();
  plan_.ordering.pop_back();
  EXPECT_THAT(Flaws(), FlawAt(-1, "assembled(peg, block) is not reached"));
}

TEST_F(FourStepPlan, FindsALocatedGoalThatIsNotReached) {
  plan_.steps.resize(2);
  plan_.ordering.resize(1);
  Start start = BlockOnEnd();
  start.goals = "  - located: {part: block, stable: [face-down, on-end]}\n";
  problem_ = PegAndBlock(start);
  EXPECT_THAT(Flaws(), FlawAt(-1, "part_location(block) is not reached: it rests on another side"));
  start.goals = "  - located: {part: block, stable: [face-down, on-back]}\n";
  problem_ = PegAndBlock(start);
  EXPECT_THAT(Flaws(), IsEmpty());
}

TEST_F(FourStepPlan, FindsAPickupFromElsewhere) {
  TakePeg().place.X_WorldPart = Translation(0.001, 0, 0) * TakePeg().place.X_WorldPart;
  EXPECT_THAT(Flaws(), FlawAt(2, "part_location(peg, initial) does not hold"));
}

TEST_F(FourStepPlan, FindsThatTheHoldChangesInTheHand) {
  PutBlock().hold.X_PartTool = PutBlock().hold.X_PartTool * Translation(0.002, 0, 0);
  EXPECT_THAT(Flaws(), FlawAt(1, "holding(block, across the block) does not hold"));
}

TEST_F(FourStepPlan, FindsAMatingWithAFixedPartThatIsElsewhere) {
  Mate().place = PlaceNow(problem_, kBlock);
  EXPECT_THAT(Flaws(), FlawAt(3, "part_location(block, initial) does not hold"));
}

TEST_F(FourStepPlan, FindsThatAMatedPartIsTaken) {
  plan_.steps.push_back({"action_5", Pickup(kBlock, BlockHold(), PutBlock().place), 5, 5});
  plan_.ordering.emplace_back(StepId(3), StepId(4));
  const std::vector<Flaw> flaws = Flaws();
  EXPECT_THAT(flaws, FlawAt(4, "block cannot be taken alone: peg is mated into block"));
  EXPECT_THAT(flaws, FlawAt(-1, "one of them is in the hand"));
}

// Tests of sensing and squeezing.

// The plan of figure 14 with a look at the block and a squeeze of it before it is taken.
class CarefulPlan : public testing::Test {
 protected:
  CarefulPlan() {
    const Place start = PlaceNow(problem_, kBlock);
    for (PlannedStep& step : plan_.steps) step.executed += 2;
    plan_.steps.push_back({"action_5", Sense(kBlock, "overhead-camera", start), 5, 1});
    plan_.steps.push_back({"action_6", Squeeze(kBlock, BlockHold(), start), 6, 2});
    plan_.ordering.emplace_back(StepId(4), StepId(5));
    plan_.ordering.emplace_back(StepId(5), StepId(0));
  }
  static domain::Problem WithCamera() {
    Start start = BlockOnEnd();
    start.sensing = "overhead-camera";
    return PegAndBlock(start);
  }

  std::vector<Flaw> Flaws() const { return Check(problem_, plan_, kAllOrders).flaws; }
  Action& Look() { return plan_.steps[4].action; }
  Action& Press() { return plan_.steps[5].action; }
  void ExecuteInTheOrder(const std::vector<int>& steps) {
    plan_.ordering = {};
    for (std::size_t i = 0; i < steps.size(); ++i) {
      plan_.steps[static_cast<std::size_t>(steps[i])].executed = static_cast<int>(i) + 1;
      if (i > 0) plan_.ordering.emplace_back(StepId(steps[i - 1]), StepId(steps[i]));
    }
  }

  domain::Problem problem_ = WithCamera();
  Plan plan_ = FourSteps(problem_);
};

TEST_F(CarefulPlan, IsAccepted) { EXPECT_THAT(Flaws(), IsEmpty()); }

TEST_F(CarefulPlan, MayLookWhileTheHandHoldsAnotherPart) {
  Look() = Sense(kPeg, "overhead-camera", PlaceNow(problem_, kPeg));
  ExecuteInTheOrder({5, 0, 4, 1, 2, 3});
  EXPECT_THAT(Flaws(), IsEmpty());
}

TEST_F(CarefulPlan, FindsASensorThatIsNotAllowed) {
  problem_.sensors.clear();
  EXPECT_THAT(Flaws(), FlawAt(4, "the sensor overhead-camera is none that the problem allows"));
}

TEST_F(CarefulPlan, FindsALookAtAnotherPlace) {
  Look().place.X_WorldPart = Translation(0.001, 0, 0) * Look().place.X_WorldPart;
  EXPECT_THAT(Flaws(), FlawAt(4, "part_location(block, initial) does not hold"));
}

TEST_F(CarefulPlan, FindsALookAtAPartInTheHand) {
  ExecuteInTheOrder({5, 0, 4, 1, 2, 3});
  EXPECT_THAT(Flaws(), FlawAt(4, "block is in the hand"));
}

TEST_F(CarefulPlan, FindsALookAtAPartThatIsMatedIntoAnother) {
  const domain::Mating& mating = problem_.mating(kPegIntoBlock);
  const Pose& X_WorldBlock = plan_.steps[1].action.place.X_WorldPart;
  Look() = Sense(kPeg, "overhead-camera", {"mated", X_WorldBlock * mating.X_FixedHeld});
  ExecuteInTheOrder({5, 0, 1, 2, 3, 4});
  EXPECT_THAT(Flaws(), FlawAt(4, "peg does not lie free: it is mated into another part"));
}

TEST_F(CarefulPlan, FindsALookAtAPartThatTheProblemHasNot) {
  Look().part = PartId(2);
  EXPECT_THAT(Flaws(), FlawAt(4, "a part or mating that the problem does not have"));
  Look().part = kBlock;
  Press().part = PartId(-1);
  EXPECT_THAT(Flaws(), FlawAt(5, "a part or mating that the problem does not have"));
}

TEST_F(CarefulPlan, FindsASqueezeWithAPartInTheHand) {
  Press() = Squeeze(kPeg, PlateHold(45 * kDegree), PlaceNow(problem_, kPeg));
  ExecuteInTheOrder({4, 0, 5, 1, 2, 3});
  EXPECT_THAT(Flaws(), FlawAt(5, "gripper(open) does not hold: the hand holds block"));
}

TEST_F(CarefulPlan, FindsASqueezeAtAnotherPlace) {
  Press().place.X_WorldPart = Translation(0, 0.001, 0) * Press().place.X_WorldPart;
  EXPECT_THAT(Flaws(), FlawAt(5, "part_location(block, initial) does not hold"));
}

TEST_F(CarefulPlan, FindsASqueezeOfAPartWithAnotherInIt) {
  Press().place = plan_.steps[1].action.place;
  ExecuteInTheOrder({4, 0, 1, 2, 3, 5});
  EXPECT_THAT(Flaws(), FlawAt(5, "block cannot be taken alone: peg is mated into block"));
}

TEST_F(CarefulPlan, ExaminesASqueezeLikeAPickup) {
  Press().hold.width += 0.001;
  EXPECT_THAT(Flaws(), FlawAt(5, "the pads do not touch block opposite each other"));
  Press().hold = BlockHold();
  Press().hold.X_PartTool = Press().hold.X_PartTool * RotationY(M_PI);
  EXPECT_THAT(Flaws(), FlawAt(5, "the tool leans"));
}

TEST_F(CarefulPlan, FindsLabelsOfAnotherGraspOrPose) {
  Press().hold.grasp = problem_.part(kBlock).grasps->front().label;
  Look().place.position = problem_.part(kBlock).model->stable_poses()[0].label;
  if (problem_.part(kBlock).resting == domain::StablePoseId(0)) {
    Look().place.position = problem_.part(kBlock).model->stable_poses()[1].label;
  }
  EXPECT_THAT(Flaws(), FlawAt(5, "the grasp has the label"));
  EXPECT_THAT(Flaws(), FlawAt(4, "the place of block has the label"));
}

// Labels that say nothing are refused where the part has a grasp or position with a true label.
TEST_F(CarefulPlan, FindsLabelsWithoutMeaning) {
  Look().place.position = "nonsense";
  EXPECT_THAT(Flaws(), FlawAt(4, "the place of block has the label 'nonsense', but is initial"));
  const domain::Grasp& grasp = problem_.part(kBlock).grasps->front();
  Press().hold = {"", grasp.X_PartTool, grasp.width};
  EXPECT_THAT(Flaws(), FlawAt(5, "the grasp has the label '', but is " + grasp.label));
  Press().hold = BlockHold();
  Press().hold.X_PartTool = Translation(0, 0, 1e-4) * Press().hold.X_PartTool;
  Press().hold.grasp = "";
  EXPECT_THAT(Flaws(), FlawAt(5, "the grasp has the label '', but is another grasp"));
}

TEST_F(FourStepPlan, NamesPartsThatErrorsLetOverlapAtTheStart) {
  plan_.not_covered = NotCovered(problem_, plan_);
  EXPECT_THAT(*plan_.not_covered, testing::Each(testing::Not(HasSubstr("at the start"))));
  problem_.parts[0].error.x = problem_.parts[0].error.y = {-0.4, 0.4};
  const std::string start = "errors with which " + problem_.parts[0].name + " and " +
                            problem_.parts[1].name + " overlap at the start";
  EXPECT_THAT(NotCovered(problem_, plan_).front(), HasSubstr(start));
  EXPECT_THAT(Flaws(), ElementsAre(Field(&Flaw::what, HasSubstr("does not name '" + start))));
}

// The mated peg may fall with the block, or off it.
TEST_F(FourStepPlan, NamesPartsThatAreAssembledAtTheStart) {
  problem_.assembled = {domain::MatingId(0)};
  EXPECT_THAT(NotCovered(problem_, plan_).front(), HasSubstr("assembled at the start"));
}

// Parts stop at once only where there is friction.
TEST_F(FourStepPlan, NamesPartsThatMayGlide) {
  const auto names_gliding = testing::Contains(HasSubstr("stops where the pads leave it"));
  EXPECT_THAT(NotCovered(problem_, plan_), testing::Not(names_gliding));
  problem_.tolerances.friction = 0.14;  // of 0.25
  EXPECT_THAT(NotCovered(problem_, plan_), testing::Not(names_gliding));
  problem_.tolerances.friction = 0.16;
  EXPECT_THAT(NotCovered(problem_, plan_), names_gliding);
  plan_.steps.clear();
  EXPECT_THAT(NotCovered(problem_, plan_), testing::Not(names_gliding)) << "nothing is pushed";
}

TEST_F(FourStepPlan, FindsWhatItSaysWronglyOfWhatIsNotCovered) {
  plan_.not_covered = NotCovered(problem_, plan_);
  EXPECT_THAT(Flaws(), IsEmpty());
  const std::string missing = plan_.not_covered->back();
  plan_.not_covered->back() = "nothing at all";
  EXPECT_THAT(Flaws(),
              UnorderedElementsAre(
                  Field(&Flaw::what, "not_covered does not name '" + missing + "'"),
                  Field(&Flaw::what, "not_covered names without reason 'nothing at all'")));
  plan_.not_covered->clear();
  EXPECT_EQ(Flaws().size(), NotCovered(problem_, plan_).size());
  plan_.not_covered = NotCovered(problem_, plan_);
  plan_.not_covered->push_back(missing);
  EXPECT_THAT(Flaws(), FlawAt(-1, "not_covered names without reason '" + missing + "'"));
}

// Tests of grasps.

TEST_F(FourStepPlan, FindsAGraspBesideThePart) {
  for (const Vector3& shift : {Vector3(0.05, 0, 0), Vector3(-0.03, 0, 0), Vector3(0, 0, 0.06)}) {
    Hold hold = PlateHold(45 * kDegree);
    hold.X_PartTool = Translation(shift) * hold.X_PartTool;
    HoldPegWith(hold);
    EXPECT_THAT(Flaws(), FlawAt(2, "the pads do not touch peg opposite each other"));
  }
}

TEST_F(FourStepPlan, FindsAGraspOfTheWrongWidth) {
  Hold hold = PlateHold(45 * kDegree);
  hold.width += 0.001;
  HoldPegWith(hold);
  EXPECT_THAT(Flaws(), FlawAt(2, "the pads do not touch peg opposite each other"));
  hold.width = 0.12;
  HoldPegWith(hold);
  EXPECT_THAT(Flaws(), FlawAt(2, "the hold is 120 mm wide; the gripper opens from 0 to"));
}

TEST_F(FourStepPlan, FindsAGraspThatCoversTheShaft) {
  HoldPegWith(HoldWith(
      "on the shaft",
      {.p = {1.4, 0, 0}, .approach = {1, -1, 0}, .closing = Vector3::UnitZ(), .width = 1.5}));
  EXPECT_THAT(Flaws(), FlawAt(3, "pad covers mating feature 7 of peg"));
}

TEST_F(FourStepPlan, FindsAGraspWithTheHandInThePart) {
  HoldBlockWith(HoldWith(
      "too deep",
      {.p = {1.5, 0, 1.5}, .approach = {0, 0, -1}, .closing = Vector3::UnitY(), .width = 3}));
  EXPECT_THAT(Flaws(), FlawAt(0, "the closed hand overlaps block"));
}

TEST_F(FourStepPlan, FindsAPadBetweenPartAndTable) {
  HoldBlockWith(HoldWith(
      "front to back",
      {.p = {1.5, 0, 5.5}, .approach = {0, 0, -1}, .closing = Vector3::UnitX(), .width = 3}));
  EXPECT_THAT(Flaws(), FlawAt(1, "the right pad presses a face of block that lies on the table"));
}

TEST_F(FourStepPlan, FindsAToolFromBelow) {
  Hold hold = PlateHold(45 * kDegree);
  hold.X_PartTool = hold.X_PartTool * RotationY(M_PI);
  HoldPegWith(hold);
  const std::vector<Flaw> flaws = Flaws();
  EXPECT_THAT(flaws, FlawAt(2, "the tool leans"));
  EXPECT_THAT(flaws, FlawAt(2, "below the table's top"));
}

TEST_F(FourStepPlan, FindsATooGreatLean) {
  HoldPegWith(PlateHold(0));
  EXPECT_THAT(Flaws(), FlawAt(2, "the tool leans 74.74 degrees from straight down; at most 60"));
  HoldPegWith(PlateHold(75 * kDegree));
  EXPECT_THAT(Flaws(), FlawAt(3, "the tool leans 75 degrees from straight down; at most 60"));
}

// Tests of places.

TEST_F(FourStepPlan, FindsAPartPutDownInTheAir) {
  PutBlockAt(Translation(0, 0, 0.02) * X_WorldBlock());
  const std::vector<Flaw> flaws = Flaws();
  EXPECT_THAT(flaws, FlawAt(1, "the lowest point of block is 20 mm above the table"));
  EXPECT_THAT(flaws, FlawAt(1, "block does not rest stably"));
}

TEST_F(FourStepPlan, FindsAPartPutDownInTheTable) {
  PutBlockAt(Translation(0, 0, -0.01) * X_WorldBlock());
  EXPECT_THAT(Flaws(), FlawAt(1, "the lowest point of block is -10 mm above the table"));
}

TEST_F(FourStepPlan, FindsAPartPutDownOnAnEdge) {
  const Pose tilted = X_WorldBlock() * RotationY(-0.1);
  const Pose raised = Translation(0, 0, -6.5 * kInch * std::sin(-0.1)) * tilted;
  for (const Pose& X : {tilted, raised}) {
    PutBlockAt(X);
    EXPECT_THAT(Flaws(), FlawAt(1, "block does not rest stably"));
  }
}

TEST_F(FourStepPlan, FindsAPartPutDownOnAnother) {
  Pose X = X_WorldBlock();
  X.translation().head<2>() = TakePeg().place.X_WorldPart.translation().head<2>();
  PutBlockAt(X);
  const std::vector<Flaw> flaws = Flaws();
  EXPECT_THAT(flaws, FlawAt(1, "block overlaps peg by"));
}

TEST_F(FourStepPlan, FindsAPartPutDownOverTheTablesEdge) {
  PutBlockAt(BlockOnBack({.x = 0.32, .y = 0, .yaw = -M_PI / 2}).X_WorldPart);
  EXPECT_THAT(Flaws(), FlawAt(1, "block reaches beyond the table at (281.9,"));
}

TEST_F(FourStepPlan, FindsAnUnreachablePlace) {
  PutBlockAt(BlockOnBack({.x = 0.85, .y = -0.6, .yaw = M_PI}).X_WorldPart);
  EXPECT_THAT(Flaws(), FlawAt(1, "the arm does not reach the tool pose"));
}

TEST_F(FourStepPlan, FindsALineOnWhichAJointMeetsItsLimit) {
  Start start = BlockOnEnd();
  start.peg = "{stable: on-side, at: [16, -6], yaw: 0}";
  problem_ = PegAndBlock(start);
  TakePeg().place = PlaceNow(problem_, kPeg);
  EXPECT_THAT(Flaws(), FlawAt(2, "none goes on continuously along the straight line"));
}

TEST(Check, FindsAPartInTheHandsWay) {
  Start start;
  start.other_parts = "  brick: {model: brick, pose: {stable: upright, at: [26.8, -8.5]}}\n";
  const domain::Problem problem = PegAndBlock(start);
  const std::vector<Flaw> flaws = Check(problem, TwoSteps(problem), kAllOrders).flaws;
  EXPECT_THAT(flaws, FlawAt(1, "the open hand overlaps brick by"));
  EXPECT_THAT(flaws, testing::Not(FlawAt(0, "brick")));
}

// Tests of matings.

TEST(Check, FindsABlockThatLiesFaceDownWhenMating) {
  Start start;
  start.block = "{stable: face-down, at: [24, 6], yaw: 0}";
  const domain::Problem problem = PegAndBlock(start);
  const std::vector<Flaw> flaws = Check(problem, TwoSteps(problem), kAllOrders).flaws;
  EXPECT_THAT(flaws, FlawAt(0, "the mating vector is 180 degrees from straight down"));
  EXPECT_THAT(flaws, FlawAt(0, "mating feature 7 of block is on the table"));
  EXPECT_THAT(flaws, FlawAt(0, "peg reaches"));
}

TEST(Check, FindsABlockThatWouldSlideWhenMating) {
  Start start;
  start.block = "{stable: on-end, at: [24, 6], yaw: 0}";
  const domain::Problem problem = PegAndBlock(start);
  EXPECT_THAT(Check(problem, TwoSteps(problem), kAllOrders).flaws,
              FlawAt(0,
                     "the mating vector is 90 degrees from straight down, outside the friction "
                     "cone of 14.04 degrees"));
}

TEST(Check, FindsAPartOnTheMatingPath) {
  Start start;
  start.other_parts = "  brick: {model: brick, pose: {stable: upright, at: [40, 12]}}\n";
  domain::Problem problem = PegAndBlock(start);
  problem.parts.back().X_WorldPart = Translation(0.54864, 0.23495, 0.1778);
  EXPECT_THAT(Check(problem, TwoSteps(problem), kAllOrders).flaws,
              FlawAt(0, "peg overlaps brick by"));
}

TEST_F(FourStepPlan, FindsAMatingThatJams) {
  problem_.matings[0].X_FixedHeld = Translation(0, 0.002, 0) * problem_.matings[0].X_FixedHeld;
  EXPECT_THAT(Flaws(), FlawAt(3, "peg overlaps block by 1.5 mm"));
}

// The checker answers whatever a plan contains. It never accepts a hold or place that was moved at
// random.
TEST_F(FourStepPlan, SurvivesRandomPosesAndRefusesThem) {
  RandomStream random(kSeed, "poses");
  const Plan good = plan_;
  for (int trial = 0; trial < 60; ++trial) {
    plan_ = good;
    const Pose X = oracle::RandomPose(random, trial % 3 == 0 ? 1e6 : 0.5);
    switch (trial % 4) {
      case 0:
        HoldPegWith({"random", X, 0.05});
        break;
      case 1:
        HoldBlockWith({"random", X, 0.05});
        break;
      case 2:
        PutBlockAt(X);
        break;
      case 3:
        TakePeg().place.X_WorldPart = X;
        break;
    }
    EXPECT_FALSE(Flaws().empty()) << "seed " << kSeed << " trial " << trial;
  }
}

}  // namespace
}  // namespace assay::plan
