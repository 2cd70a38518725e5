#include "sim/sweep/shell_commands/run_command.h"

#include <gtest/gtest.h>

namespace assay::sweep::run_command_test {
namespace {

TEST(RunCommand, LeavesOutWhatIsUsual) {
  EXPECT_EQ(RunCommand{.input = "a.yaml"}.Text(), "assay run a.yaml");
  EXPECT_EQ(RunCommand{.input = "a b.yaml"}.Text(), "assay run 'a b.yaml'");
}

TEST(RunCommand, HasEveryOptionThatDecidesWhatATrialDoes) {
  const RunCommand command{.input = "a.yaml",
                           .scatter = true,
                           .tree = true,
                           .propagation = "paper",
                           .resolvers = {"sensing", "squeezing"},
                           .error_scale = 1.5,
                           .grasp = scene::GraspMode::kWeld,
                           .models = domain::ModelPath("models"),
                           .worlds = "all",
                           .sensing_errors = 0.25,
                           .noise = "uniform",
                           .sensing = "camera",
                           .errors = "dx_peg=0.5 dy_peg=1",
                           .seed = 7,
                           .trial = 3};
  EXPECT_EQ(command.Text(),
            "assay run a.yaml --scatter --tree --propagation paper --resolvers sensing,squeezing "
            "--error-scale 1.5 --grasp weld --models models --worlds all --sensing-errors 0.25 "
            "--noise uniform --sensing camera --errors 'dx_peg=0.5 dy_peg=1' --seed 7 --trial 3");
  EXPECT_EQ(command.OfPlan().Text(),
            "assay run a.yaml --scatter --tree --propagation paper --resolvers sensing,squeezing "
            "--error-scale 1.5 --grasp weld --models models");
}

TEST(RunCommand, RepeatsOneTrialOrAll) {
  const RunCommand command{.input = "a.yaml", .noise = "vertices", .trial = 5};
  EXPECT_EQ(command.Again(2, 9).Text(), "assay run a.yaml --noise vertices --seed 2 --trial 9");
  EXPECT_EQ(command.Again(2, std::nullopt).Text(), "assay run a.yaml --noise vertices --seed 2");
}

TEST(RunCommand, StatesErrorsInPlaceOfNoise) {
  const RunCommand command{.input = "a.yaml", .error_scale = 2, .noise = "attack", .seed = 4};
  EXPECT_EQ(command.WithErrors("dx_peg=0.5").Text(),
            "assay run a.yaml --error-scale 2 --errors 'dx_peg=0.5'");
}

}  // namespace
}  // namespace assay::sweep::run_command_test
