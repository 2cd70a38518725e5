#include "sim/execution/commands/command_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/geometry/pose.h"
#include "planner/plan/certificates/condition_table.h"
#include "sim/execution/commands/action_commands.h"
#include "tests/planner/plan/actions.h"
#include "tests/sim/execution/figure15.h"

namespace assay::execution::command_file_test {
namespace {

// Returns one letter for each command's kind: S for safe height, P for a path, L for a line, O for
// open, C for close and W for a look.
std::string Kinds(const std::vector<Command>& commands) {
  std::string kinds;
  for (const Command& command : commands) kinds += "SPLOCW"[command.index()];
  return kinds;
}

class CommandFileTest : public testing::Test {
 protected:
  CommandFileTest() : problem_(Figure15()), plan_(TwoActions(problem_)), world_(problem_) {}

  const Pose& Line(const std::vector<Command>& commands, std::size_t i) const {
    return std::get<MoveStraight>(commands[i]).X_WorldTool;
  }
  const domain::WorkcellRules& Rules() const { return problem_.workcell->rules(); }

  domain::Problem problem_;
  plan::Plan plan_;
  WorldModel world_;
};

TEST_F(CommandFileTest, IsInTheOrderOfExecution) {
  const CommandFile file = CommandFileOf(problem_, plan_);
  ASSERT_EQ(file.steps.size(), 2u);
  EXPECT_EQ(file.steps[0].step, plan::StepId(1));
  EXPECT_EQ(file.steps[1].step, plan::StepId(0));
}

// The commands of Spar's figure 18 are: open, move above the part, move straight down, close, move
// straight up.
TEST_F(CommandFileTest, PickupFollowsFigure18) {
  const auto pickup = plan_.steps[1].action;
  const StepCommands commands = CommandsFor(problem_, world_, pickup);
  EXPECT_EQ(Kinds(commands.approach), "OSL");
  EXPECT_EQ(Kinds(commands.advance), "L");
  EXPECT_EQ(Kinds(commands.act), "C");
  EXPECT_EQ(Kinds(commands.depart), "L");
  ASSERT_EQ(Kinds(commands.InOrder()), "OSLLCL");
  const Pose grasp = pickup.place.X_WorldPart * pickup.hold.X_PartTool;
  EXPECT_TRUE(Line(commands.advance, 0).isApprox(grasp, 1e-12));
  const Vector3 way = grasp.translation() - Line(commands.approach, 2).translation();
  EXPECT_TRUE(way.isApprox(Rules().approach_distance * grasp.linear().col(2), 1e-12));
  const Vector3 lifted = Line(commands.depart, 0).translation();
  EXPECT_NEAR(lifted.z(), Rules().safe_height, 1e-12);
  EXPECT_TRUE(lifted.head<2>().isApprox(grasp.translation().head<2>()));
}

// A wrongly taken part is released at its believed pose. The hand then goes back by the way it
// came.
TEST_F(CommandFileTest, APickupThatFailedGoesBackToWhereItWasPoised) {
  const auto pickup = plan_.steps[1].action;
  const StepCommands commands = CommandsFor(problem_, world_, pickup);
  ASSERT_EQ(Kinds(commands.withdraw), "OL");
  const auto& release = std::get<OpenGripper>(commands.withdraw[0]).release;
  ASSERT_TRUE(release.has_value());
  EXPECT_EQ(release->part, pickup.part);
  EXPECT_EQ(release->X_WorldPart.matrix(), pickup.place.X_WorldPart.matrix());
  EXPECT_EQ(Line(commands.withdraw, 1).matrix(), Line(commands.approach, 2).matrix());
}

// The way down of a putdown is that of a pickup, prolonged by the guarded travel.
TEST_F(CommandFileTest, PutdownGoesOnUntilItMeetsResistance) {
  const auto pickup = plan_.steps[1].action;
  const plan::Action putdown = plan::Putdown(pickup.part, pickup.hold, pickup.place);
  const StepCommands up = CommandsFor(problem_, world_, pickup);
  const StepCommands down = CommandsFor(problem_, world_, putdown);
  EXPECT_EQ(Kinds(down.approach), "S");
  ASSERT_EQ(Kinds(down.InOrder()), "SLOLL");
  const auto& descent = std::get<MoveStraight>(down.advance[0]);
  const Vector3 beyond = descent.X_WorldTool.translation() - Line(up.advance, 0).translation();
  EXPECT_TRUE(beyond.isApprox(Vector3(0, 0, -Rules().guarded_travel), 1e-9));
  ASSERT_TRUE(descent.guard.has_value());
  EXPECT_EQ(descent.guard->force, kResistance);
  EXPECT_GE(descent.pace.final_length, 2 * Rules().guarded_travel) << "from as far before on";
  EXPECT_TRUE(Line(down.depart, 1).isApprox(Line(up.approach, 2), 1e-12));
}

// If the height is certain to a millimetre, the guarded travel is shortened accordingly, so that
// the pads do not slide farther on the part.
TEST_F(CommandFileTest, PutdownEndsWhereItMustHaveMetTheTable) {
  const auto pickup = plan_.steps[1].action;
  const plan::Action putdown = plan::Putdown(pickup.part, pickup.hold, pickup.place);
  const double doubt = 0.001;
  plan::CertifiedPrecondition landing = {.condition = plan::condition::kLandingHeight};
  landing.margin = Rules().guarded_travel - doubt;
  plan::Certificate certificate;
  certificate.preconditions = {landing};
  const StepCommands usual = CommandsFor(problem_, world_, putdown);
  const StepCommands certain = CommandsFor(problem_, world_, putdown, certificate);
  const Vector3 less =
      Line(certain.advance, 0).translation() - Line(usual.advance, 0).translation();
  const double beyond = doubt + plan::kBeyondContact;
  EXPECT_TRUE(less.isApprox(Vector3(0, 0, Rules().guarded_travel - beyond), 1e-9));
  EXPECT_GE(std::get<MoveStraight>(certain.advance[0]).pace.final_length, doubt + beyond);
}

// The fixture begins to clamp before the parts may touch. It clamps until the hand lets the held
// part go.
TEST_F(CommandFileTest, AFixtureClampsTheFixedPart) {
  const auto assemble = plan_.steps[0].action;
  problem_.parts[problem_.mating(assemble.mating).fixed.index()].clamp = 120;
  const StepCommands commands = CommandsFor(problem_, world_, assemble);
  EXPECT_EQ(std::get<Clamp>(commands.advance.front()).force, 120);
  ASSERT_TRUE(std::holds_alternative<OpenGripper>(commands.depart[0]));
  EXPECT_EQ(std::get<Clamp>(commands.depart[1]).force, 0);
}

TEST_F(CommandFileTest, AssembleGoesAlongTheMatingVector) {
  const auto assemble = plan_.steps[0].action;
  const domain::Mating& mating = problem_.mating(assemble.mating);
  const StepCommands commands = CommandsFor(problem_, world_, assemble);
  EXPECT_EQ(Kinds(commands.approach), "SL");
  ASSERT_EQ(Kinds(commands.InOrder()), "SLLOLL");
  const Pose& start = Line(commands.approach, 1);
  const Pose& end = Line(commands.advance, 0);
  const Vector3 vector = assemble.place.X_WorldPart.linear() * mating.mating_vector;
  const Vector3 motion = end.translation() - start.translation();
  EXPECT_LT(motion.cross(vector).norm(), 1e-12);
  EXPECT_NEAR(motion.norm(), vector.norm() + Rules().guarded_travel, 1e-12);
  const Pose mated = assemble.place.X_WorldPart * mating.X_FixedHeld * assemble.hold.X_PartTool;
  EXPECT_TRUE((start.translation() + vector).isApprox(mated.translation(), 1e-12));
  EXPECT_TRUE(std::get<MoveStraight>(commands.advance[0]).guard.has_value());
  EXPECT_EQ(Kinds(commands.withdraw), "") << "it is enough to back off a little";
}

// Commands go to the believed poses of parts, even if the plan has other poses.
TEST_F(CommandFileTest, CommandsFollowTheBelief) {
  const Pose away = geometry::Translation(0.02, -0.03, 0) * geometry::RotationZ(0.1);
  const PartId peg = PartNamed(problem_, "peg");
  const PartId block = PartNamed(problem_, "block");
  WorldModel moved = world_;
  moved.Believe(peg, away * world_.PartPose(peg));
  moved.Believe(block, away * world_.PartPose(block));
  for (const plan::PlannedStep& step : plan_.steps) {
    const std::vector<Command> planned = CommandsFor(problem_, world_, step).advance;
    const std::vector<Command> believed = CommandsFor(problem_, moved, step).advance;
    EXPECT_TRUE(Line(believed, 0).isApprox(away * Line(planned, 0), 1e-12)) << step.name;
  }
}

// A squeeze has the commands of a pickup up to the closing, and those of a putdown from the opening
// on.
TEST_F(CommandFileTest, SqueezeClosesAndLetsGoWhereThePartIs) {
  const auto pickup = plan_.steps[1].action;
  const plan::Action squeeze = plan::Squeeze(pickup.part, pickup.hold, pickup.place);
  const std::vector<Command> up = CommandsFor(problem_, world_, pickup).InOrder();
  const std::vector<Command> commands = CommandsFor(problem_, world_, squeeze).InOrder();
  ASSERT_EQ(Kinds(commands), "OSLLCOLL");
  for (const std::size_t line : {2u, 3u}) {
    EXPECT_TRUE(Line(commands, line).isApprox(Line(up, line), 1e-12));
  }
  const auto& release = std::get<OpenGripper>(commands[5]).release;
  ASSERT_TRUE(release.has_value());
  EXPECT_EQ(release->part, pickup.part);
  EXPECT_EQ(release->X_WorldPart.matrix(), pickup.place.X_WorldPart.matrix());
  EXPECT_TRUE(Line(commands, 6).isApprox(Line(commands, 2), 1e-12)) << "out by the way in";
  EXPECT_NEAR(Line(commands, 7).translation().z(), Rules().safe_height, 1e-12);
}

TEST_F(CommandFileTest, SenseSendsTheArmHomeAndLooks) {
  const plan::Place place{"initial", problem_.part(PartNamed(problem_, "block")).X_WorldPart};
  const plan::Action sense = plan::Sense(PartNamed(problem_, "block"), "overhead-camera", place);
  const std::vector<Command> commands = CommandsFor(problem_, world_, sense).InOrder();
  ASSERT_EQ(Kinds(commands), "SW");
  EXPECT_EQ(std::get<MoveAtSafeHeight>(commands[0]).X_WorldTool.matrix(),
            std::get<MoveAtSafeHeight>(CommandFileOf(problem_, plan_).home).X_WorldTool.matrix());
  EXPECT_EQ(std::get<Look>(commands[1]).part, sense.part);
  EXPECT_EQ(std::get<Look>(commands[1]).sensor, "overhead-camera");
  EXPECT_EQ(Text(problem_, commands[1]), "look at block with overhead-camera");
  EXPECT_EQ(ShortText(problem_, sense), "sense(block, overhead-camera)");
}

// The coarse camera promises 0.3 mm and 0.2 degrees, and it measures no heights.
TEST_F(CommandFileTest, ALookTakesWhatTheSensorKnowsBetter) {
  const PartId block = PartNamed(problem_, "block");
  plan::PlannedStep step = {"action_3", plan::Sense(block, "coarse-camera", {})};
  const auto takes = [&] {
    return std::get<Look>(CommandsFor(problem_, world_, step).act.front()).takes;
  };
  EXPECT_TRUE(takes().x && takes().y && takes().yaw) << "without a certificate all it measures";
  EXPECT_FALSE(takes().z);
  plan::ErrorSet known;
  known.part = PartNamed(problem_, "peg");  // another part, whose errors do not matter
  step.certificate.before.push_back(known);
  known.part = block;
  known.x = {-1e-4, 1e-4};
  known.y = {-0.01, 0.01};
  known.theta = {-0.001, 0.001};
  step.certificate.before.push_back(known);
  EXPECT_FALSE(takes().x);
  EXPECT_TRUE(takes().y);
  EXPECT_FALSE(takes().z);
  EXPECT_FALSE(takes().yaw);
}

TEST_F(CommandFileTest, TextNamesStepsAndCommands) {
  const std::string text = Text(problem_, plan_, CommandFileOf(problem_, plan_));
  EXPECT_THAT(text, testing::HasSubstr("1 action_2: pickup(peg, "));
  EXPECT_THAT(text, testing::HasSubstr("2 action_1: assemble(peg, block)"));
  EXPECT_THAT(text, testing::HasSubstr("    close on peg to 76.20 mm"));
  EXPECT_THAT(text, testing::HasSubstr("    open, releasing peg"));
}

}  // namespace
}  // namespace assay::execution::command_file_test
