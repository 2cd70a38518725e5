#include "sim/sweep/grid/sweep_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/base/input_files/input_error.h"
#include "tests/sim/sweep/sweep_folder.h"

namespace assay::sweep::sweep_file_test {
namespace {

using domain::ResolverKind;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Optional;
using uncertainty::Propagation;

class SweepFile : public SweepFolder {
 protected:
  std::string ErrorOf(const std::string& lines) const {
    try {
      Read(lines);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  }
};

TEST_F(SweepFile, SaysAllAxes) {
  const Sweep sweep = Read(
      "title: All of it\n"
      "units: {length: mm}\n"
      "scenarios: [a.yaml, b.yaml]\n"
      "clearances: [0.5, 1]\n"
      "error_scales: [1, 0.1]\n"
      "propagation: [sound, paper]\n"
      "resolvers: [[sensing], [fine-motion, sensing]]\n"
      "grasp: [weld, friction]\n"
      "sensing: [camera, drawn]\n"
      "noise: [none, uniform, vertices, low-discrepancy]\n"
      "seeds: [1, 2, 3]\n"
      "trials: 100\n"
      "control_trials: 7\n"
      "planner: {budget: 1000, instances: 3}\n");
  EXPECT_EQ(sweep.title, "All of it");
  EXPECT_THAT(sweep.scenarios, ElementsAre("a.yaml", "b.yaml"));
  ASSERT_EQ(sweep.clearances.size(), 2u);
  EXPECT_THAT(sweep.clearances[0], Optional(::testing::DoubleEq(0.0005)));
  EXPECT_THAT(sweep.error_scales, ElementsAre(1, 0.1));
  EXPECT_THAT(sweep.propagations, ElementsAre(Propagation::kSound, Propagation::kPaper));
  EXPECT_THAT(
      sweep.resolvers,
      ElementsAre(Optional(ElementsAre(ResolverKind::kSensing)),
                  Optional(ElementsAre(ResolverKind::kSensing, ResolverKind::kFineMotion))));
  EXPECT_THAT(sweep.grasps, ElementsAre(scene::GraspMode::kWeld, scene::GraspMode::kFriction));
  EXPECT_THAT(sweep.sensings, ElementsAre(Sensing::kCamera, Sensing::kDrawn));
  EXPECT_THAT(sweep.noises, ElementsAre(NoiseKind::kNone, NoiseKind::kUniform, NoiseKind::kVertices,
                                        NoiseKind::kLowDiscrepancy));
  EXPECT_THAT(sweep.seeds, ElementsAre(1, 2, 3));
  EXPECT_EQ(sweep.trials, 100);
  EXPECT_EQ(sweep.control_trials, 7);
  EXPECT_EQ(sweep.partial_plans, 1000);
  EXPECT_EQ(sweep.instances, 3);
}

TEST_F(SweepFile, NeedsScenariosAndTrialsOnly) {
  const Sweep sweep = Read("scenarios: [a.yaml]\ntrials: 5\n");
  EXPECT_THAT(sweep.clearances, ElementsAre(std::nullopt));
  EXPECT_THAT(sweep.error_scales, ElementsAre(1));
  EXPECT_THAT(sweep.propagations, ElementsAre(Propagation::kSound));
  EXPECT_THAT(sweep.resolvers, ElementsAre(std::nullopt));
  EXPECT_THAT(sweep.grasps, ElementsAre(scene::GraspMode::kFriction));
  EXPECT_THAT(sweep.sensings, ElementsAre(Sensing::kDrawn));
  EXPECT_THAT(sweep.noises, ElementsAre(NoiseKind::kUniform));
  EXPECT_THAT(sweep.seeds, ElementsAre(0));
  EXPECT_EQ(sweep.control_trials, 1);
}

// The order of resolvers in a set does not matter.
TEST_F(SweepFile, ResolversAreSets) {
  const std::string good = "scenarios: [a.yaml]\ntrials: 5\n";
  const auto both = Read(good + "resolvers: [[squeezing, sensing]]\n").resolvers.front();
  ASSERT_TRUE(both);
  EXPECT_EQ(Name(*both), "sensing,squeezing");
  EXPECT_THAT(ErrorOf(good + "resolvers: [[squeezing, sensing], [sensing, squeezing]]\n"),
              AllOf(HasSubstr("sweep.yaml:4:35"), HasSubstr("given twice")));
  EXPECT_THAT(ErrorOf(good + "resolvers: [[sensing, sensing]]\n"), HasSubstr("given twice"));
  EXPECT_THAT(ErrorOf(good + "resolvers: [[]]\n"), HasSubstr("empty"));
  EXPECT_THAT(ErrorOf(good + "resolvers: [sensing]\n"), HasSubstr("list"));
  EXPECT_THAT(ErrorOf(good + "resolvers: [[fine_motion]]\n"), HasSubstr("'fine-motion'"));
}

TEST_F(SweepFile, SaysHowToFalsify) {
  const Sweep sweep = Read(
      "scenarios: [a.yaml]\nnoise: [uniform, attack]\ntrials: 5\nattempts: 2500\n"
      "conservatism: true\n");
  EXPECT_THAT(sweep.noises, ElementsAre(NoiseKind::kUniform, NoiseKind::kFalsification));
  EXPECT_EQ(sweep.attempts, 2500);
  EXPECT_TRUE(sweep.conservatism);
}

TEST_F(SweepFile, AFalsificationAloneNeedsNoTrials) {
  const Sweep sweep = Read("scenarios: [a.yaml]\nnoise: [attack]\n");
  EXPECT_EQ(sweep.attempts, 1000);
  EXPECT_FALSE(sweep.conservatism);
  EXPECT_THAT(ErrorOf("scenarios: [a.yaml]\nnoise: [attack, uniform]\n"), HasSubstr("trials"));
}

TEST_F(SweepFile, WrongFalsificationsAreRefusedWithTheirPlace) {
  const std::string falsification = "scenarios: [a.yaml]\ntrials: 5\nnoise: [attack]\n";
  EXPECT_THAT(ErrorOf(falsification + "attempts: 0\n"), HasSubstr("sweep.yaml:5:11"));
  EXPECT_THAT(ErrorOf(falsification + "attempts: 1.5\n"), HasSubstr("sweep.yaml:5:11"));
  EXPECT_THAT(ErrorOf(falsification + "atempts: 5\n"), HasSubstr("did you mean 'attempts'?"));
  EXPECT_THAT(ErrorOf(falsification + "conservatism: 3\n"), HasSubstr("sweep.yaml:5:15"));
  EXPECT_THAT(ErrorOf(falsification + "sensing: [drawn, camera]\n"),
              AllOf(HasSubstr("sweep.yaml:5:10"), HasSubstr("no camera")));
  const std::string sampled = "scenarios: [a.yaml]\ntrials: 5\n";
  EXPECT_THAT(ErrorOf(sampled + "attempts: 5\n"), HasSubstr("nothing is attacked"));
  EXPECT_THAT(ErrorOf(sampled + "conservatism: true\n"), HasSubstr("nothing is attacked"));
  EXPECT_THAT(ErrorOf(sampled + "noise: [atack]\n"), HasSubstr("'attack'"));
}

TEST_F(SweepFile, KindsOfNoiseAreNamedAsTheModes) {
  for (const NoiseKind kind :
       {NoiseKind::kNone, NoiseKind::kUniform, NoiseKind::kVertices, NoiseKind::kLowDiscrepancy}) {
    EXPECT_EQ(Name(kind), noise::Name(ModeOf(kind)));
  }
}

TEST_F(SweepFile, ScenariosAreFoundFromItsFolder) {
  const Sweep sweep = Read("scenarios: [a.yaml]\ntrials: 5\n");
  EXPECT_EQ(sweep.PathOf("a.yaml"), folder_ / "a.yaml");
  EXPECT_EQ(sweep.PathOf("../a.yaml"), folder_.parent_path() / "a.yaml");
}

TEST_F(SweepFile, WrongOnesAreRefusedWithTheirPlace) {
  const std::string good = "scenarios: [a.yaml]\ntrials: 5\n";
  EXPECT_THAT(ErrorOf(good + "nois: [none]\n"), HasSubstr("did you mean 'noise'?"));
  EXPECT_THAT(ErrorOf(good + "nois: [none]\n"), HasSubstr("sweep.yaml:4:1"));
  EXPECT_THAT(ErrorOf(good + "noise: [unifrom]\n"), HasSubstr("'uniform'"));
  EXPECT_THAT(ErrorOf(good + "noise: [none, none]\n"), HasSubstr("given twice"));
  EXPECT_THAT(ErrorOf(good + "seeds: []\n"), HasSubstr("empty"));
  EXPECT_THAT(ErrorOf(good + "seeds: [-1]\n"), HasSubstr("sweep.yaml:4:9"));
  EXPECT_THAT(ErrorOf(good + "error_scales: [-1]\n"), HasSubstr("sweep.yaml:4:16"));
  EXPECT_THAT(ErrorOf(good + "units: {length: mm}\nclearances: [50]\n"), HasSubstr("10"));
  EXPECT_THAT(ErrorOf(good + "sensing: [radar]\n"), HasSubstr("drawn, camera"));
  EXPECT_THAT(ErrorOf(good + "planner: {instance: 2}\n"), HasSubstr("did you mean 'instances'?"));
  EXPECT_THAT(ErrorOf("scenarios: [a.yaml]\n"), HasSubstr("trials"));
  EXPECT_THAT(ErrorOf("trials: 5\n"), HasSubstr("scenarios"));
  EXPECT_THAT(ErrorOf("scenarios: [a.yaml]\ntrials: 0\n"), HasSubstr("sweep.yaml:3:9"));
  EXPECT_THAT(ErrorOf("scenarios: [c.yaml]\ntrials: 5\n"), HasSubstr("c.yaml"));
  EXPECT_THAT(ErrorOf("scenarios: a.yaml\ntrials: 5\n"), HasSubstr("list"));
}

TEST_F(SweepFile, GridsTooLargeToCountAreRefused) {
  std::string seeds = "0";
  for (int i = 1; i < 200; ++i) seeds += ", " + std::to_string(i);
  EXPECT_THAT(ErrorOf("scenarios: [a.yaml]\ntrials: 10000000\nseeds: [" + seeds + "]\n"),
              HasSubstr("1000000000 at most"));
}

}  // namespace
}  // namespace assay::sweep::sweep_file_test
