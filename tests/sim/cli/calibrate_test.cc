#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/sim/cli/program.h"

namespace assay::cli::calibrate_test {
namespace {

using ::testing::HasSubstr;

// A copy of the models of which the camera promises what none can keep.
std::string BoastfulModels(const Folder& folder) {
  std::filesystem::copy(kTree / "models", folder / "models",
                        std::filesystem::copy_options::recursive);
  const std::string workcell = "models/workcells/puma762-table/workcell.yaml";
  std::string text = TextOf(folder / workcell);
  const std::string promise = "error: {x: 0.0003,";
  const std::size_t place = text.find(promise);
  EXPECT_NE(place, std::string::npos);
  folder.Write(workcell, text.replace(place, promise.size(), "error: {x: 0.000000001,"));
  return folder / "models";
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
  EXPECT_EQ(result["seed"], 7);
  EXPECT_EQ(result["kept"], true);
  for (const char* coordinate : {"x", "y", "theta"}) {
    const auto& promised = result["promised"][coordinate];
    const double greatest = result["greatest_errors"][coordinate]["error"];
    EXPECT_LT(greatest, promised[1]) << coordinate;
    EXPECT_GT(greatest, 0) << coordinate << ": nothing measured is exact";
  }
  EXPECT_FALSE(result["promised"].contains("z"));

  // One of them alone comes out as among the others.
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
  EXPECT_THAT(ended.out, HasSubstr("again: assay calibrate " + kTwoLooks + " --seed 7 --trial 1"));
}

TEST_F(Calibrate, WantsASensorAndAScenario) {
  EXPECT_EQ(Assay({"calibrate"}).code, 2);
  EXPECT_EQ(Assay({"calibrate", kTwoLooks, "--trials", "0"}).code, 2);
  EXPECT_EQ(Assay({"calibrate", "no-such-file.yaml"}).code, 3);
}

}  // namespace
}  // namespace assay::cli::calibrate_test
