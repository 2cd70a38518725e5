#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "tests/sim/cli/program.h"

namespace assay::cli::view_test {
namespace {

using ::testing::HasSubstr;

constexpr const char* kHeader =
    R"({"format":"assay-trace/1","problem":"spar-fig15","parts":["peg"]})";

std::string TextOf(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(ViewTest, RefusesWhatItCannotShow) {
  const Folder folder;
  const std::string page = folder / "page.html";
  const std::string trace = folder.Write("trace.jsonl", kHeader);
  const std::string scenario = (kTree / "scenarios/spar-fig15.yaml").string();
  const Ended without_plan = Assay({"view", trace, "-o", page});
  EXPECT_EQ(without_plan.code, 2);
  EXPECT_THAT(without_plan.err, HasSubstr("allowed: --plan FILE"));
  ASSERT_EQ(Assay({"plan", scenario, "-o", folder / "plan.json"}).code, 0);
  const Ended cut_off = Assay({"view", trace, "-o", page});
  EXPECT_EQ(cut_off.code, 3);
  EXPECT_THAT(cut_off.err, HasSubstr("the trace has no end"));
  const Ended numbered = Assay({"view", scenario, "1", "-o", page});
  EXPECT_EQ(numbered.code, 2);
  EXPECT_THAT(numbered.err, HasSubstr("numbers of trials are for databases"));
  EXPECT_EQ(Assay({"view", scenario, "--worlds", "all", "-o", page}).code, 2);
  EXPECT_EQ(Assay({"view", scenario, "--counterexample", "1", "-o", page}).code, 2);
  const std::string result = folder.Write("result.json", R"({"rows": [{"trial": 3}]})");
  EXPECT_THAT(Assay({"view", result, "-o", page}).err, HasSubstr("needs the number of a trial"));
  EXPECT_THAT(Assay({"view", result, "2", "-o", page}).err, HasSubstr("has no trial 2"));
  EXPECT_EQ(Assay({"view", folder / "no.yaml", "-o", page}).code, 3);
  EXPECT_EQ(Assay({"view", kTree / "scenarios/spar-fig15.yaml"}).code, 2);
  EXPECT_FALSE(std::filesystem::exists(page));
}

TEST(ViewTest, ShowsWhyThereIsNoPlan) {
  const Folder folder;
  const std::string page = folder / "page.html";
  EXPECT_EQ(Assay({"view", kTree / "scenarios/impossible.yaml", "-o", page}).code, 10);
  EXPECT_THAT(TextOf(page), HasSubstr("block starts face-down"));
}

TEST(ViewTest, ShowsTheWayThroughAPlanTree) {
  const Folder folder;
  const std::string page = folder / "page.html";
  const Ended ended =
      Assay({"view", kTree / "scenarios/bottles.yaml", "2", "--worlds", "all", "-o", page});
  EXPECT_EQ(ended.code, 0) << ended.err;
  const std::string text = TextOf(page);
  EXPECT_THAT(text,
              HasSubstr(R"x("text":"if !isEmptyBottle(bottle)","action":false,"gone":true)x"));
  EXPECT_THAT(text,
              HasSubstr(R"x("text":"if isEmptyBottle(bottle)","action":false,"gone":false)x"));
}

}  // namespace
}  // namespace assay::cli::view_test
