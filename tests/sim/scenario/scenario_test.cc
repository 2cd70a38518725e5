#include "sim/scenario/scenario.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "planner/base/input_files/input_error.h"
#include "sim/scenario/models_folder.h"
#include "tests/scratch_file.h"

namespace assay::scenario::scenario_test {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

const fs::path kRoot = ASSAY_SOURCE_DIR;

// A temporary folder of a test. It is removed after the test.
class ScenarioFile : public testing::Test {
 protected:
  ScenarioFile()
      : folder_(ScratchFile(testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::create_directories(folder_);
  }
  ~ScenarioFile() override { fs::remove_all(folder_); }

  // Writes the scenario of Spar's figure 15 with more lines at its end.
  fs::path Write(const std::string& more) const {
    std::ifstream original(kRoot / "scenarios/spar-fig15.yaml");
    std::ofstream(folder_ / "scenario.yaml") << original.rdbuf() << more;
    return folder_ / "scenario.yaml";
  }
  Simulation Read(const std::string& more) const {
    return Load(Write(more), kRoot / "models").simulation;
  }
  std::string ErrorOf(const std::string& more) const {
    try {
      Read(more);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  }

  fs::path folder_;
};

TEST_F(ScenarioFile, SaysHowToSimulate) {
  const Simulation simulation =
      Read("simulation: {seed: 7, grasp: weld, timestep: 0.00025, cameras: [top, side]}\n");
  EXPECT_EQ(simulation.seed, 7u);
  EXPECT_EQ(simulation.scene.grasp, scene::GraspMode::kWeld);
  EXPECT_EQ(simulation.scene.timestep, 0.00025);
  EXPECT_THAT(simulation.cameras, ElementsAre("top", "side"));
}

TEST_F(ScenarioFile, NeedNotSayIt) {
  const Simulation simulation = Read("");
  EXPECT_EQ(simulation.seed, 0u);
  EXPECT_EQ(simulation.scene.grasp, scene::GraspMode::kFriction);
  EXPECT_EQ(simulation.scene.timestep, scene::SceneOptions().timestep);
  EXPECT_THAT(simulation.cameras, ElementsAre("work", "overview"));
}

TEST_F(ScenarioFile, WrongValuesAreRefusedWithTheirPlace) {
  EXPECT_THAT(ErrorOf("simulation: {grasp: glue}\n"), HasSubstr("friction, weld"));
  EXPECT_THAT(ErrorOf("simulation: {grap: weld}\n"), HasSubstr("grasp"));
  EXPECT_THAT(ErrorOf("simulation: {seed: -1}\n"), HasSubstr("scenario.yaml:"));
  EXPECT_THAT(ErrorOf("simulation: {timestep: 0.1}\n"), HasSubstr("0.001"));
  EXPECT_THAT(ErrorOf("simulation: {cameras: [clos]}\n"), HasSubstr("close"));
  EXPECT_THAT(ErrorOf("simulation: {cameras: [top, top]}\n"), HasSubstr("each camera once"));
}

TEST_F(ScenarioFile, ReadsTheProblemToo) {
  const domain::Problem problem = Load(Write(""), kRoot / "models").problem;
  EXPECT_EQ(problem.name, "scenario");
  EXPECT_EQ(problem.parts.size(), 2u);
}

TEST_F(ScenarioFile, IsReadWithOverrides) {
  const fs::path file = Write("tolerances: {friction: 0.1}\nsimulation: {seed: 7}\n");
  const Scenario said = Load(file, kRoot / "models");
  const Scenario other = Load(file, kRoot / "models", {.clearance = 0.0003, .error_scale = 0.1});
  EXPECT_EQ(other.problem.clearance, 0.0003);
  EXPECT_EQ(other.problem.parts[0].model->clearance(), 0.0003);
  EXPECT_EQ(other.problem.gripper_error.y.high, 0.1 * said.problem.gripper_error.y.high);
  EXPECT_EQ(other.problem.parts[1].error.theta.low, 0.1 * said.problem.parts[1].error.theta.low);
  EXPECT_EQ(other.problem.tolerances, said.problem.tolerances);
  EXPECT_EQ(other.simulation.seed, 7u);
  EXPECT_THROW(Load(file, kRoot / "models", {.clearance = -0.0003}), InputError);
}

using Folders = std::vector<fs::path>;

TEST_F(ScenarioFile, ModelsStandBesideItOrAbove) {
  fs::create_directories(folder_ / "models/workcells");
  fs::create_directories(folder_ / "deep/down");
  const Folders models = {fs::canonical(folder_ / "models")};
  EXPECT_EQ(FindModels(folder_ / "scenario.yaml").folders(), models);
  EXPECT_EQ(FindModels(folder_ / "deep/down/scenario.yaml").folders(), models);
}

TEST_F(ScenarioFile, TheNearestModelsCount) {
  fs::create_directories(folder_ / "models/workcells");
  fs::create_directories(folder_ / "deep/models/workcells");
  EXPECT_EQ(FindModels(folder_ / "deep/scenario.yaml").folders(),
            Folders{fs::canonical(folder_ / "deep/models")});
}

// A folder of parts alone does not hide the workcells of the folders after it.
TEST_F(ScenarioFile, HasItsOwnPartsBesideTheUsualModels) {
  fs::create_directories(folder_ / "models/workcells");
  fs::create_directories(folder_ / "deep/models/parts");
  const Folders models = {fs::canonical(folder_ / "deep/models"), fs::canonical(folder_ / "models")};
  EXPECT_EQ(FindModels(folder_ / "deep/scenario.yaml").folders(), models);
  fs::remove_all(folder_ / "models");
  EXPECT_EQ(FindModels(folder_ / "deep/scenario.yaml").folders(),
            (Folders{models.front(), fs::canonical(kRoot / "models")}));
}

// If there are no models beside the file or above it, those of the source tree are used.
TEST_F(ScenarioFile, WithoutModelsHasThoseOfTheProgram) {
  EXPECT_EQ(FindModels(folder_ / "scenario.yaml").folders(),
            Folders{fs::canonical(kRoot / "models")});
  EXPECT_EQ(Load(Write("")).problem.parts.size(), 2u);
}

// Given folders come first in their order. The usual folder comes last, and only once.
TEST_F(ScenarioFile, GivenModelsComeFirst) {
  fs::create_directories(folder_ / "own/parts/peg");
  fs::create_directories(folder_ / "other/parts");
  std::ofstream(folder_ / "own/parts/peg/part.yaml") << "not looked at";
  const fs::path usual = fs::canonical(kRoot / "models");
  domain::ModelPath given = folder_ / "own";
  given.Append(folder_ / "other");
  const domain::ModelPath models = FindModels(folder_ / "scenario.yaml", given);
  EXPECT_EQ(models.folders(), (Folders{folder_ / "own", folder_ / "other", usual}));
  EXPECT_EQ(models.PartFile("peg"), folder_ / "own/parts/peg/part.yaml");
  EXPECT_EQ(models.PartFile("block"), usual / "parts/block/part.yaml");
  EXPECT_EQ(models.Parts(), domain::ModelPath(usual).Parts());
  EXPECT_EQ(FindModels(folder_ / "scenario.yaml", usual).folders(), Folders{usual});
}

TEST_F(ScenarioFile, AFolderWithoutModelsIsRefused) {
  EXPECT_THROW(FindModels(folder_ / "scenario.yaml", folder_), InputError);
}

TEST_F(ScenarioFile, ThatIsNotThereIsNamed) {
  try {
    Load(folder_ / "nothing.yaml");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("nothing.yaml"));
  }
}

TEST(Scenarios, AllCanBeLoaded) {
  for (const auto& entry : fs::directory_iterator(kRoot / "scenarios")) {
    if (entry.path().extension() != ".yaml") continue;
    const auto worlds = ReadWorlds(Document::Load(entry.path()));
    EXPECT_EQ(worlds.front().name, entry.path().stem());
    if (worlds.size() > 1) continue;
    EXPECT_EQ(Load(entry.path()).problem.name, entry.path().stem());
  }
}

}  // namespace
}  // namespace assay::scenario::scenario_test
