#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/sim/cli/program.h"

namespace assay::cli::report_test {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

// The page reports one trial without noise, with pictures and tables.
TEST(ReportVerb, MakesAPageAndTables) {
  const Folder folder;
  const std::string models = kTree / "models";
  folder.Write("known.yaml", TextOf(kTwoActions) + "simulation: {timestep: 0.0005}\n");
  const std::string sweep = folder.Write(
      "sweep.yaml",
      "format: assay-sweep/1\ntitle: A & B\nscenarios: [known.yaml]\nnoise: [none]\ntrials: 1\n");
  const std::string database = folder / "a.sqlite";
  const Ended swept = Assay({"sweep", sweep, "--db", database, "--models", models});
  ASSERT_THAT((std::vector{0, 12}), Contains(swept.code)) << swept.err;

  const std::string page = folder / "a.html";
  const Ended ended = Assay({"report", database, "-o", page, "--csv", folder / "tables",
                             "--pictures", "--size", "120x90", "--models", models});
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("a.html: 1 trial in 1 cell"));
  const std::string html = TextOf(page);
  EXPECT_THAT(html, HasSubstr("<h1>A &amp; B</h1>"));
  EXPECT_THAT(html, HasSubstr("src=\"data:image/png;base64,iVBORw0KGgo"));
  EXPECT_THAT(TextOf(folder / "tables/outcomes.csv"), HasSubstr("1,known.yaml,"));
}

TEST(ReportVerb, WrongDatabasesAreErrors) {
  const Folder folder;
  const std::string text = folder.Write("text.sqlite", std::string(5000, 'x'));
  EXPECT_EQ(Assay({"report", text, "-o", folder / "a.html"}).code, 3);
  EXPECT_EQ(Assay({"report", folder / "no.sqlite", "-o", folder / "a.html"}).code, 3);
  EXPECT_EQ(Assay({"report", text, "-o", folder / "no/a.html"}).code, 3);
  EXPECT_EQ(Assay({"report", text}).code, 2);
  EXPECT_FALSE(std::filesystem::exists(folder / "a.html"));
}

}  // namespace
}  // namespace assay::cli::report_test
