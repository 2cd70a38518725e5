#include "sim/exec/command_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/exec/action_commands.h"
#include "tests/sim/exec/figure15.h"

namespace assay::exec {
namespace {

// The kinds of the commands, as letters: safe height, line, open, close, look (W).
std::string Kinds(const std::vector<Command>& commands) {
  std::string kinds;
  for (const Command& command : commands) kinds += "SLOCW"[command.index()];
  return kinds;
}

class CommandFileTest : public testing::Test {
 protected:
  CommandFileTest() : problem_(Figure15()), plan_(TwoActions(problem_)) {}

  const Pose& Line(const std::vector<Command>& commands, std::size_t i) const {
    return std::get<MoveStraight>(commands[i]).X_WorldTool;
  }

  domain::Problem problem_;
  plan::Plan plan_;
};

TEST_F(CommandFileTest, IsInTheOrderOfExecution) {
  const CommandFile file = CommandFileOf(problem_, plan_);
  ASSERT_EQ(file.steps.size(), 2u);
  EXPECT_EQ(file.steps[0].step, plan::StepId(1));
  EXPECT_EQ(file.steps[1].step, plan::StepId(0));
}

// Spar, figure 18: open, above the part, straight down, close, straight up.
TEST_F(CommandFileTest, PickupFollowsFigure18) {
  const auto pickup = std::get<plan::Pickup>(plan_.steps[1].action);
  const std::vector<Command> commands = CommandsFor(problem_, pickup);
  ASSERT_EQ(Kinds(commands), "OSLLCL");
  const Pose grasp = pickup.from.X_WorldPart * pickup.hold.X_PartTool;
  const domain::WorkcellRules& rules = problem_.workcell->rules();
  EXPECT_TRUE(Line(commands, 3).isApprox(grasp, 1e-12));
  const Vector3 approach = grasp.translation() - Line(commands, 2).translation();
  EXPECT_TRUE(approach.isApprox(rules.approach_distance * grasp.linear().col(2), 1e-12));
  EXPECT_NEAR(Line(commands, 5).translation().z(), rules.safe_height, 1e-12);
  EXPECT_TRUE(Line(commands, 5).translation().head<2>().isApprox(grasp.translation().head<2>()));
}

// Putting down is picking up backwards.
TEST_F(CommandFileTest, PutdownReversesPickup) {
  const auto pickup = std::get<plan::Pickup>(plan_.steps[1].action);
  const plan::Putdown putdown{pickup.part, pickup.hold, pickup.from};
  const std::vector<Command> up = CommandsFor(problem_, pickup);
  const std::vector<Command> down = CommandsFor(problem_, putdown);
  ASSERT_EQ(Kinds(down), "SLOLL");
  const Vector3 release(0, 0, kReleaseHeight);
  EXPECT_TRUE(Line(down, 1).translation().isApprox(Line(up, 3).translation() + release, 1e-12));
  EXPECT_TRUE(Line(down, 3).translation().isApprox(Line(up, 2).translation() + release, 1e-12));
}

TEST_F(CommandFileTest, AssembleGoesAlongTheMatingVector) {
  const auto assemble = std::get<plan::Assemble>(plan_.steps[0].action);
  const domain::Mating& mating = problem_.mating(assemble.mating);
  const std::vector<Command> commands = CommandsFor(problem_, assemble);
  ASSERT_EQ(Kinds(commands), "SLLOLL");
  const Vector3 motion = Line(commands, 2).translation() - Line(commands, 1).translation();
  const Vector3 vector = assemble.fixed.X_WorldPart.linear() * mating.mating_vector;
  EXPECT_TRUE(motion.isApprox(vector, 1e-12));
  const Pose mated = assemble.fixed.X_WorldPart * mating.X_FixedHeld * assemble.hold.X_PartTool;
  EXPECT_LE((Line(commands, 2).translation() - mated.translation()).norm(),
            kReleaseHeight * (1 + 1e-9));
}

// A squeeze is a pickup up to the closing, and a putdown from the opening on.
TEST_F(CommandFileTest, SqueezeClosesAndLetsGoWhereThePartIs) {
  const auto pickup = std::get<plan::Pickup>(plan_.steps[1].action);
  const plan::Squeeze squeeze{pickup.part, pickup.hold, pickup.from};
  const std::vector<Command> up = CommandsFor(problem_, pickup);
  const std::vector<Command> commands = CommandsFor(problem_, squeeze);
  ASSERT_EQ(Kinds(commands), "OSLLCOLL");
  for (const std::size_t line : {2u, 3u}) {
    EXPECT_TRUE(Line(commands, line).isApprox(Line(up, line), 1e-12));
  }
  const auto& release = std::get<OpenGripper>(commands[5]).release;
  ASSERT_TRUE(release.has_value());
  EXPECT_EQ(release->part, pickup.part);
  EXPECT_EQ(release->X_WorldPart.matrix(), pickup.from.X_WorldPart.matrix());
  EXPECT_TRUE(Line(commands, 6).isApprox(Line(commands, 2), 1e-12)) << "out by the way in";
  EXPECT_NEAR(Line(commands, 7).translation().z(), problem_.workcell->rules().safe_height, 1e-12);
}

TEST_F(CommandFileTest, SenseSendsTheArmHomeAndLooks) {
  const plan::Place place{"initial", problem_.part(PartNamed(problem_, "block")).X_WorldPart};
  const plan::Sense sense{PartNamed(problem_, "block"), "overhead-camera", place};
  const std::vector<Command> commands = CommandsFor(problem_, sense);
  ASSERT_EQ(Kinds(commands), "SW");
  EXPECT_EQ(std::get<MoveAtSafeHeight>(commands[0]).X_WorldTool.matrix(),
            CommandFileOf(problem_, plan_).home.X_WorldTool.matrix());
  EXPECT_EQ(std::get<Look>(commands[1]).part, sense.part);
  EXPECT_EQ(std::get<Look>(commands[1]).sensor, "overhead-camera");
  EXPECT_EQ(Text(problem_, commands[1]), "look at block with overhead-camera");
  EXPECT_EQ(Text(problem_, plan::Action(sense)), "sense(block, overhead-camera)");
}

TEST_F(CommandFileTest, TextNamesStepsAndCommands) {
  const std::string text = Text(problem_, plan_, CommandFileOf(problem_, plan_));
  EXPECT_THAT(text, testing::HasSubstr("1 action_2: pickup(peg, "));
  EXPECT_THAT(text, testing::HasSubstr("2 action_1: assemble(peg, block)"));
  EXPECT_THAT(text, testing::HasSubstr("    close on peg to 76.20 mm"));
  EXPECT_THAT(text, testing::HasSubstr("    open, releasing peg"));
}

}  // namespace
}  // namespace assay::exec
