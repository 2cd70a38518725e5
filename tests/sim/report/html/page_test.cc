#include "sim/report/html/page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/report/findings/csv.h"
#include "sim/report/findings/read_findings.h"
#include "tests/scratch_file.h"
#include "tests/sim/report/markup.h"
#include "tests/sim/report/sample_database.h"

namespace assay::report::page_test {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

Findings Sample(bool tried) {
  const auto file = ScratchFile(tried ? "attacked.sqlite" : "sample.sqlite");
  std::filesystem::remove(file);
  WriteSampleDatabase(file, tried);
  return ReadFindings(sweep::Store::Open(file), "my db.sqlite");
}

TEST(Findings, AreWhatTheTrialsObserved) {
  const Findings findings = Sample(false);
  ASSERT_EQ(findings.cells.size(), 3);
  const CellFindings& cell = findings.cells[1];
  EXPECT_EQ(cell.control_done, 1);
  EXPECT_EQ(cell.control_succeeded, 1);
  EXPECT_EQ(cell.recovery.signalled, 4);
  EXPECT_EQ(cell.recovery.mended, 2);
  EXPECT_EQ(cell.recovery.unaided, 6);
  EXPECT_EQ(cell.summary.succeeded, 8);
  ASSERT_EQ(cell.steps.size(), 2);
  EXPECT_EQ(cell.steps[1].what, "assemble(peg, <block>)");
  const Observed& x = cell.steps[0].claims.at(0).observed;
  EXPECT_DOUBLE_EQ(x.least, -0.0009);
  EXPECT_DOUBLE_EQ(x.greatest, 0.0009);
  EXPECT_NEAR(x.median, 0, 1e-15);
  // The quartile is between the 3rd and the 4th of ten values, 2.25 steps of 0.2 mm from the least.
  EXPECT_NEAR(x.lower_quartile, -0.00045, 1e-15);
  EXPECT_EQ(x.verdicts.Verdicts(), (VerdictCounts{.contained = 10}));
  const StepFindings& second = cell.steps[1];
  const VerdictCounts counts{.contained = 8, .inconclusive = 1, .violated = 1};
  EXPECT_EQ(second.counts.Verdicts(), counts);
  EXPECT_EQ(second.counts.Of(Standing::kWithinResolution), 1);
  EXPECT_EQ(second.claims.at(0).observed.verdicts.Verdicts(), counts);
  EXPECT_EQ(second.worst.trial, 11);
  EXPECT_EQ(second.worst.dimension, domain::Dimension::kAngle);
  EXPECT_EQ(second.worst.about, "after");
}

TEST(Findings, NotableTrialsAreInOrderOfSuccessAndMargin) {
  const NotableTrials notable = Sample(false).notable;
  // Numbers 5 and 6 have x nearest to 0 among the trials that succeeded with all claims contained.
  EXPECT_EQ(notable.best, 6);
  // Two trials failed, and number 3 observed x farther out than number 4.
  EXPECT_EQ(notable.worst, 4);
}

TEST(Page, IsWellFormedWhateverTheNames) {
  for (const bool tried : {false, true}) {
    const std::string page = Page(Sample(tried), {});
    const Markup root = ReadMarkup(page);
    EXPECT_TRUE(root.All("script").empty());
    EXPECT_THAT(page, Not(HasSubstr("<script")));
    EXPECT_THAT(root.text, HasSubstr("a<b>&amp;\"'")) << "the scenario's name, without .yaml";
    EXPECT_THAT(root.text, HasSubstr(kHostilePart));
    EXPECT_EQ(root.All("h1").at(0)->text, "Pegs & <holes>");
  }
}

TEST(Page, FetchesNothing) {
  const Markup root = ReadMarkup(Page(Sample(true), {.picture = [](int) { return "png"; }}));
  for (const char* element : {"img", "link", "use", "a"}) {
    for (const Markup* found : root.All(element)) {
      const auto& address =
          found->attributes.at(found->attributes.contains("src") ? "src" : "href");
      EXPECT_TRUE(address.starts_with("#") || address.starts_with("data:")) << address;
      if (!address.starts_with("#")) continue;
      EXPECT_NE(root.WithId(address.substr(1)), nullptr) << address;
    }
  }
  EXPECT_THAT(root.All("style").at(0)->text, Not(HasSubstr("url(")));
  EXPECT_EQ(root.All("img").size(), 3);
  EXPECT_EQ(root.All("img")[0]->attributes.at("src"), "data:image/png;base64,cG5n");
}

TEST(Page, CanBeReadWithoutEyes) {
  const Markup root = ReadMarkup(Page(Sample(true), {.picture = [](int) { return ""; }}));
  for (const Markup* table : root.All("table")) {
    ASSERT_EQ(table->All("caption").size(), 1);
    EXPECT_NE(table->All("caption")[0]->text, "");
    for (const Markup* heading : table->All("th"))
      EXPECT_TRUE(heading->attributes.contains("scope"));
    // Each row has as many cells as the head.
    const std::size_t columns = table->All("thead").at(0)->All("th").size();
    for (const Markup* row : table->All("tbody").at(0)->All("tr")) {
      const bool group = row->attributes.contains("class");
      EXPECT_EQ(row->children.size(), group ? 1 : columns) << table->text;
    }
  }
  for (const Markup* svg : root.All("svg")) {
    EXPECT_TRUE(svg->attributes.contains("aria-label") || svg->attributes.contains("aria-hidden"));
  }
  for (const Markup* image : root.All("img")) EXPECT_NE(image->attributes.at("alt"), "");
  EXPECT_EQ(root.attributes.at("lang"), "en");
  EXPECT_EQ(root.All("h1").size(), 1);
}

TEST(Page, TellsTheRates) {
  const Markup root = ReadMarkup(Page(Sample(true), {}));
  const std::string summary = root.WithId("summary")->text;
  // By hand, (0.8 + z²/20) / (1 + z²/10) = 0.71674, plus or minus 0.22658, for z = 1.96.
  EXPECT_THAT(summary, HasSubstr("8 of 10 trials; 95 % interval 49 to 94.3 %"));
  EXPECT_THAT(
      summary,
      HasSubstr(
          "Predictions were violated 3 times in 22 certificates of trials and 20,000 attempts."));
  EXPECT_THAT(summary, HasSubstr("Without noise: 1 of 1"));
  const std::string recoveries = root.WithId("recoveries")->text;
  EXPECT_THAT(recoveries, HasSubstr("60 % (31.3 to 83.2 %)"));
  EXPECT_THAT(recoveries, HasSubstr("80 % (49 to 94.3 %)"));
}

TEST(Page, TellsTheVerdictsWithTheCommand) {
  const Markup root = ReadMarkup(Page(Sample(true), {}));
  const std::string verdicts = root.WithId("verdicts")->text;
  EXPECT_THAT(verdicts, HasSubstr("assay replay 'my db.sqlite' 11"));
  EXPECT_THAT(verdicts, HasSubstr("1.15°±0.573°−0.573°0.0573°"));
  const std::string sets = root.WithId("error-sets")->text;
  EXPECT_THAT(sets, HasSubstr("±1 mm±0.9 mm"));
  EXPECT_EQ(root.WithId("error-sets")->All("table").size(), 4);  // two cells of two steps
}

TEST(Page, TellsTheFalsifications) {
  const Markup root = ReadMarkup(Page(Sample(true), {}));
  const std::string falsifications = root.WithId("attacks")->text;
  EXPECT_THAT(falsifications, HasSubstr("assay replay 'my db.sqlite' --counterexample 3/1"));
  EXPECT_THAT(falsifications, HasSubstr("theta_block = −4.58°"));
  EXPECT_THAT(
      falsifications,
      HasSubstr("Observed: 2.5 mm. Predicted: ±1 mm. The observation is outside by 1.5 mm"));
  const std::string conservatism = root.WithId("conservatism")->text;
  EXPECT_THAT(conservatism, HasSubstr("all together× 1× 33"));
  EXPECT_THAT(conservatism, HasSubstr("not broken"));
  const Markup without = ReadMarkup(Page(Sample(false), {}));
  EXPECT_THAT(without.WithId("attacks")->text, HasSubstr("There was no falsification"));
}

TEST(Page, TellsOnlySomeCellsInFull) {
  const Markup root = ReadMarkup(Page(Sample(false), {.cells_in_full = 1}));
  const std::string sets = root.WithId("error-sets")->text;
  EXPECT_THAT(sets, HasSubstr("Cell 2"));  // the cell with a violation
  EXPECT_THAT(sets, Not(HasSubstr("Cell 1")));
  EXPECT_THAT(sets, HasSubstr("not shown here: 1 cell."));
}

// Each failed trial has the command that makes its page, or a link if pages are made.
TEST(Page, LeadsToFailedTrials) {
  const Findings findings = Sample(false);
  ASSERT_FALSE(findings.failures.empty());
  const std::string name = ViewedTrial{findings.failures.front().trial}.FileName();
  EXPECT_THAT(Page(findings, {}), HasSubstr("-o " + name));
  std::vector<std::string> made;
  const auto make = [&](const ViewedTrial& viewed) {
    made.push_back(viewed.FileName());
    return "views/" + viewed.FileName();
  };
  const std::string page = Page(findings, {.view = make});
  EXPECT_EQ(made.size(), findings.failures.size());
  EXPECT_THAT(page, HasSubstr("href=\"views/" + name + "\""));
  EXPECT_THAT(page, Not(HasSubstr("assay view")));
}

TEST(Page, LeadsToCounterexamples) {
  std::vector<std::string> made;
  const auto make = [&](const ViewedTrial& viewed) {
    if (viewed.counterexample) made.push_back(viewed.FileName());
    return viewed.FileName();
  };
  Findings findings = Sample(true);
  for (CellFindings& cell : findings.cells) cell.falsification_trial = 7;
  const std::string page = Page(findings, {.view = make});
  EXPECT_THAT(made, Contains("counterexample-7-1.html"));
  for (const std::string& name : made) EXPECT_THAT(page, HasSubstr("href=\"" + name + "\""));
}

TEST(Page, IsTheSameForTheSameDatabase) {
  EXPECT_EQ(Page(Sample(true), {}), Page(Sample(true), {}));
}

TEST(Csv, HasEveryTable) {
  std::map<std::string, std::string> files;
  for (const CsvFile& file : CsvFiles(Sample(true))) files[file.name] = file.text;
  EXPECT_EQ(files.size(), 10);
  EXPECT_THAT(files["outcomes.csv"], HasSubstr("2,\"a<b>&amp;\"\"'.yaml\",0.0005,1,sound,"));
  EXPECT_THAT(files["verdicts.csv"], HasSubstr("2,2,action_1,8,1,1,0,violated,theta of peg,after,"
                                               "rad,0.02,-0.01,0.01,-0.01,0.001,11,"));
  EXPECT_THAT(files["conservatism.csv"], HasSubstr("3,dx_block,1.5,,\n"));
  EXPECT_THAT(files["recoveries.csv"], HasSubstr("2,10,4,4,2,2,2,6,8\n"));
}

}  // namespace
}  // namespace assay::report::page_test
