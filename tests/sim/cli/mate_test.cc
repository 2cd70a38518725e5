#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/sim/cli/program.h"

namespace assay::cli {
namespace {

using ::testing::HasSubstr;

const std::string kSquare = kTree / "scenarios/mate-square.yaml";

TEST(Mate, PlansAStrategyThatIsCertainForAllTheErrors) {
  const Ended ended = Assay({"mate", kSquare, "--json"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  const nlohmann::json result = ended.Json();
  EXPECT_EQ(result["outcome"], "plan");
  EXPECT_EQ(result["critical_points"].size(), 2u);  // the tip at the mouth, the plate on the front
  EXPECT_GE(result["absorbed"], 1);
  EXPECT_GT(result["strategy"].size(), 2u);
  for (const auto& motion : result["strategy"]) {
    for (const auto& unwanted : motion["margins"]) EXPECT_GT(unwanted["scale"], 1);
  }
}

TEST(Mate, WithoutAStrategyThereIsNoPlan) {
  const Ended ended = Assay({"mate", kSquare, "--displacement", "20", "--rotation", "10"});
  EXPECT_EQ(ended.code, 10) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("no strategy absorbs the errors"));
}

TEST(Mate, AFewTrialsComeToTheSeat) {
  const Ended ended = Assay({"mate", kSquare, "--trials", "2", "--json"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(ended.Json()["trials"]["strategy"]["seated"], 2);
}

}  // namespace
}  // namespace assay::cli
