#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/sim/cli/program.h"

namespace assay::cli::view_test {
namespace {

using ::testing::HasSubstr;

constexpr const char* kHeader =
    R"({"format":"assay-trace/1","problem":"spar-fig15","parts":["peg"]})";

TEST(ViewTest, RefusesWhatItCannotShow) {
  const Folder folder;
  const std::string page = folder / "page.html";
  const std::string trace = folder.Write("trace.jsonl", kHeader);
  const Ended cut_off = Assay({"view", trace, "-o", page});
  EXPECT_EQ(cut_off.code, 3);
  EXPECT_THAT(cut_off.err, HasSubstr("the trace has no end"));
  const Ended tree = Assay({"view", kTree / "scenarios/two-cans.yaml", "-o", page});
  EXPECT_EQ(tree.code, 2);
  EXPECT_THAT(tree.err, HasSubstr("is a tree"));
  EXPECT_EQ(Assay({"view", folder / "no.yaml", "-o", page}).code, 3);
  EXPECT_EQ(Assay({"view", kTree / "scenarios/spar-fig15.yaml"}).code, 2);
  EXPECT_FALSE(std::filesystem::exists(page));
}

}  // namespace
}  // namespace assay::cli::view_test
