#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/sim/cli/program.h"

namespace assay::cli::calibrate_test {
namespace {

using ::testing::HasSubstr;

const std::string kTable = "models/workcells/puma762-table/workcell.yaml";
const std::string kNarrowTable = "models/workcells/narrow-table/workcell.yaml";

// Copies the models into the folder and returns their path.
std::string ModelsIn(const Folder& folder) {
  std::filesystem::copy(kTree / "models", folder / "models",
                        std::filesystem::copy_options::recursive);
  return folder / "models";
}

// Returns the file's text with another promise of the overhead camera, and puts the old promise
// into `removed`.
std::string Promising(std::string text, const std::string& promise, std::string* removed) {
  const std::size_t camera = text.find("  overhead-camera:");
  EXPECT_NE(camera, std::string::npos);
  const std::size_t start = text.find("error: {", camera);
  const std::size_t end = text.find('\n', start);
  if (removed != nullptr) *removed = text.substr(start, end - start);
  return text.replace(start, end - start, promise);
}

// Copies the models and lets the camera promise an error that no sensor can keep.
std::string BoastfulModels(const Folder& folder) {
  const std::string models = ModelsIn(folder);
  folder.Write(kTable, Promising(TextOf(folder / kTable), "error: {x: 0.000000001}", nullptr));
  return models;
}

class Calibrate : public testing::Test {
 protected:
  void SetUp() override {
    if (Assay({"doctor"}).code == 4) GTEST_SKIP() << "nothing renders on this machine";
  }
};

TEST_F(Calibrate, TellsTheGreatestErrorsAndWhetherThePromiseIsKept) {
  const Ended ended = Assay({"calibrate", kTwoLooks, "--trials", "3", "--seed", "7", "--json"});
  ASSERT_EQ(ended.code, 0) << ended.err << ended.out;
  const nlohmann::json result = ended.Json();
  EXPECT_EQ(result["trials"], 3);
  EXPECT_EQ(result["found"], 3);
  EXPECT_EQ(result["scenarios"][0]["seed"], 7);
  EXPECT_EQ(result["kept"], true);
  for (const char* coordinate : {"x", "y", "z", "theta"}) {
    const auto& promised = result["promised"][coordinate];
    const double greatest = result["greatest_errors"][coordinate]["error"];
    EXPECT_LT(greatest, promised[1]) << coordinate;
    EXPECT_GT(greatest, 0) << coordinate << ": nothing measured is exact";
  }

  // A trial that is run alone has the same result as in the series.
  const int worst = result["greatest_errors"]["x"]["trial"];
  const Ended alone =
      Assay({"calibrate", kTwoLooks, "--trial", std::to_string(worst), "--seed", "7", "--json"});
  EXPECT_EQ(alone.Json()["greatest_errors"]["x"], result["greatest_errors"]["x"]);
}

TEST_F(Calibrate, ABrokenPromiseIsAFailureWithTheCommandThatShowsIt) {
  const Folder folder;
  const std::string models = BoastfulModels(folder);
  const Ended ended =
      Assay({"calibrate", kTwoLooks, "--trials", "2", "--seed", "7", "--models", models});
  EXPECT_EQ(ended.code, 12) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("the error is greater than promised"));
  EXPECT_THAT(ended.out, HasSubstr("assay calibrate " + kTwoLooks + " --seed 7 --trial 1"));
}

// The promise is the margin times the greatest errors of all scenarios. The promise is written into
// the workcells of all these scenarios and read from there. Nothing else in the files changes.
TEST_F(Calibrate, WritesThePromiseIntoTheWorkcellsOfAllScenarios) {
  const Folder folder;
  const std::string models = ModelsIn(folder);
  const std::vector<std::string> command = {
      "calibrate", kTwoLooks,  kTree / "scenarios/clutter.yaml",
      "--trials",  "2",        "--seed",
      "7",         "--models", models,
      "--json"};
  std::vector<std::string> writing = command;
  writing.insert(writing.end(), {"--margin", "2", "--write"});
  const Ended written = Assay(writing);
  ASSERT_EQ(written.code, 0) << written.err << written.out;
  const nlohmann::json measured = written.Json();
  const nlohmann::json again = Assay(command).Json();
  for (const char* coordinate : {"x", "y", "z", "theta"}) {
    const double greatest = measured["greatest_errors"][coordinate]["error"];
    EXPECT_EQ(again["greatest_errors"][coordinate]["error"], greatest) << coordinate;
    const double promised = again["promised"][coordinate][1];
    EXPECT_GE(promised, 2 * greatest * (1 - 1e-9)) << coordinate;
    EXPECT_LE(promised, 2 * greatest * 1.1) << coordinate << ": two digits";
  }
  EXPECT_EQ(again["kept"], true);

  std::string promise;
  std::string promise_of_others;
  const std::string anything = "error: {x: 1}";
  EXPECT_EQ(Promising(TextOf(folder / kTable), anything, &promise),
            Promising(TextOf(kTree / kTable), anything, nullptr));
  EXPECT_EQ(Promising(TextOf(folder / kNarrowTable), anything, &promise_of_others),
            Promising(TextOf(kTree / kNarrowTable), anything, nullptr));
  EXPECT_THAT(promise, HasSubstr("}  # calibrated: " + measured["found"].dump() +
                                 " placements, seed 7, margin 2"));
  EXPECT_EQ(promise, promise_of_others);
}

TEST_F(Calibrate, WantsASensorAndAScenario) {
  EXPECT_EQ(Assay({"calibrate"}).code, 2);
  EXPECT_EQ(Assay({"calibrate", kTwoLooks, "--trials", "0"}).code, 2);
  EXPECT_EQ(Assay({"calibrate", "no-such-file.yaml"}).code, 3);
}

}  // namespace
}  // namespace assay::cli::calibrate_test
