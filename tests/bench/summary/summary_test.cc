#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "bench/summary/comparison.h"
#include "bench/summary/contingent_table.h"
#include "bench/summary/growth.h"
#include "bench/summary/measurements.h"
#include "bench/summary/plots.h"
#include "bench/summary/report.h"
#include "planner/base/input_files/input_error.h"
#include "tests/scratch_file.h"

namespace assay::bench::summary_test {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

Series Of(const std::string& name, std::vector<double> seconds,
          std::map<std::string, double> counters = {}) {
  return {.name = name, .seconds = std::move(seconds), .counters = std::move(counters)};
}

Measurements TwoInstances() {
  return {.context = {{"labeling/measured", "the search"},
                      {"labeling/at_least", "5"},
                      {"labeling/against", "gecode"},
                      {"labeling/never_below", "2"},
                      {"labeling/missing/minion", "minion"}},
          .series = {Of("labeling/a/assay", {1, 2, 4}), Of("labeling/a/gecode:afc", {10, 20, 40}),
                     Of("labeling/a/gecode:size", {5, 8, 24}), Of("labeling/a/cadical", {2, 4, 8}),
                     Of("labeling/b/assay", {1, 1, 1}), Of("labeling/b/gecode:afc", {9, 9, 9}),
                     Of("alone/b", {3, 3, 3})}};
}

TEST(Comparison, TakesAPeersBestVariantAndPairsThePasses) {
  const std::vector<Family> families = Families(TwoInstances());
  ASSERT_THAT(families, SizeIs(1));
  const Contest& a = families[0].contests[0];
  const PeerTime* gecode = a.Find("gecode");
  ASSERT_NE(gecode, nullptr);
  EXPECT_EQ(gecode->variant, "size");
  EXPECT_EQ(gecode->ratio.least, 4);
  EXPECT_EQ(gecode->ratio.median, 5);
  EXPECT_EQ(gecode->ratio.greatest, 6);
  EXPECT_EQ(a.Best()->peer, "cadical");
  EXPECT_THAT(Ratios(families[0], ""), ElementsAre(2, 9));
  EXPECT_THAT(Ratios(families[0], "gecode"), ElementsAre(5, 9));
  EXPECT_THAT(families[0].missing, ElementsAre(testing::FieldsAre("minion", "minion")));
}

TEST(Comparison, ScalesPublishedFiguresByWhatBothRan) {
  const Measurements measurements = {
      .context = {},
      .series = {Of("bounds/spar/assay", {1e-6}),
                 Of("bounds/spar/boost", {4e-6}, {{"times:ibex", 1000.0}})}};
  const std::vector<Family> families = Families(measurements);
  EXPECT_THAT(Ratios(families[0], "ibex (scaled)"), ElementsAre(DoubleNear(4000, 1e-9)));
}

TEST(Comparison, TellsKindsOfInstancesApart) {
  Measurements measurements = {.context = {{"posting/against", "gecode"}}, .series = {}};
  const auto add = [&](const std::string& instance, double ratio, const std::string& label) {
    measurements.series.push_back(Of("posting/" + instance + "/assay", {1}));
    measurements.series.back().label = label;
    measurements.series.push_back(Of("posting/" + instance + "/gecode", {ratio}));
  };
  for (int i = 0; i < 3; ++i) {
    add("plan-0" + std::to_string(i), 100, "");
    add("crowded-0" + std::to_string(i), 10, "some refused");
  }
  add("a-file", 7, "");
  const std::vector<Family> kinds = ByKind(Families(measurements)[0]);
  ASSERT_THAT(kinds, SizeIs(3));
  EXPECT_THAT(Ratios(kinds[0], ""), ElementsAre(100, 100, 100));
  EXPECT_EQ(kinds[1].name, "crowded, some refused");
  EXPECT_THAT(Ratios(kinds[2], ""), ElementsAre(7));
  EXPECT_THAT(Report(measurements),
              HasSubstr("| [posting](#posting) | crowded, some refused | 3 | gecode | 10 |"));
}

TEST(Comparison, GeometricMeanOfPowers) {
  EXPECT_NEAR(GeometricMean({1, 10, 100}), 10, 1e-12);
  EXPECT_NEAR(GeometricMean({0.5, 2}), 1, 1e-12);
}

TEST(Growth, FindsTheExponentOfAPowerLaw) {
  Measurements measurements;
  for (const int size : {1, 2, 5, 10}) {
    measurements.series.push_back(
        Of("Search/sides:" + std::to_string(size), {3e-6 * std::pow(size, 1.5)}));
    measurements.series.push_back(Of("plan/tree-0" + std::to_string(size) + "/assay",
                                     {1e-3 * size * size}, {{"size", size}}));
  }
  for (const char* not_a_size : {"Draw/seed:1", "Draw/seed:2", "Draw/seed:3"}) {
    measurements.series.push_back(Of(not_a_size, {1}));
  }
  const std::vector<Growth> growths = Growths(measurements);
  ASSERT_THAT(growths, SizeIs(2));
  EXPECT_NEAR(growths[0].Exponent(), 1.5, 1e-9);
  EXPECT_EQ(growths[0].of, "sides");
  EXPECT_EQ(growths[1].name, "plan/tree/assay");  // each kind of instance has its own growth
  EXPECT_NEAR(growths[1].Exponent(), 2, 1e-9);
}

TEST(Report, TellsWhatHoldsAndWhatIsMissed) {
  Measurements measurements = TwoInstances();
  measurements.context.erase("labeling/missing/minion");
  EXPECT_THAT(Report(measurements), HasSubstr("| 5 times gecode, nowhere below 2 | holds |"));
  measurements.context["labeling/at_least"] = "50";
  EXPECT_THAT(Report(measurements), HasSubstr("| **missed** |"));
}

TEST(Report, NothingHoldsAgainstAPeerThatIsNotInstalled) {
  const Measurements some = TwoInstances();
  EXPECT_THAT(Report(some), HasSubstr("| minion | 0 | not measured: minion is not installed |"));
  EXPECT_THAT(Report(some), HasSubstr("| 5 times gecode, nowhere below 2 | **not measured** |"));

  Measurements none = {.context = {{"counting/at_least", "10"},
                                   {"counting/against", "gecode"},
                                   {"counting/missing/gecode", "libgecode-dev"}},
                       .series = {Of("counting/a/assay", {1})}};
  EXPECT_THAT(Report(none), HasSubstr("| [counting](#counting) | gecode | 0 | not measured: "
                                      "libgecode-dev is not installed |  |  | 10 times gecode | "
                                      "**not measured** |"));
  none.context.erase("counting/missing/gecode");
  EXPECT_THAT(Report(none), HasSubstr("| 10 times gecode | **not measured** |"));
}

TEST(Report, AMissingPeerHidesNoMiss) {
  Measurements measurements = TwoInstances();
  measurements.context["labeling/at_least"] = "50";
  EXPECT_THAT(Report(measurements), HasSubstr("| **missed** |"));
}

TEST(Report, HoldsTimesAgainstTheirLimits) {
  const Measurements measurements = {.context = {},
                                     .series = {Of("Plan/fig13", {0.005}, {{"at_most_ms", 20}}),
                                                Of("Plan/fig16", {0.025}, {{"at_most_ms", 20}})}};
  const std::string report = Report(measurements);
  EXPECT_THAT(report, HasSubstr("| Plan/fig13 | 5 ms | at most 20 ms: holds |"));
  EXPECT_THAT(report, HasSubstr("| Plan/fig16 | 25 ms | at most 20 ms: **missed** |"));
  EXPECT_THAT(report, HasSubstr("| Plan | 20 ms | 2 | Plan/fig16 | 25 ms | **missed** by 1 |"));
}

TEST(Report, HoldsTheSlowestOfManyQuestionsAgainstTheirLimit) {
  Measurements measurements = {
      .context = {{"bounds/measured", "both ends"}},
      .series = {Of("bounds/wide", {0.03}, {{"at_most_ms", 10}, {"slowest_ms", 4}})}};
  EXPECT_THAT(Report(measurements),
              HasSubstr("| bounds | 10 ms | 1 | bounds/wide | 4 ms | holds |"));
  EXPECT_THAT(Report(measurements), HasSubstr("Time of bounds: both ends."));
  measurements.series[0].counters["slowest_ms"] = 11;
  EXPECT_THAT(Report(measurements), HasSubstr("| bounds/wide | 11 ms | **missed** by 1 |"));
}

TEST(Report, MarksPeersWhoseTimeWasUp) {
  const Measurements measurements = {
      .context = {},
      .series = {Of("labeling/a/assay", {0.01}), Of("labeling/a/z3", {2}, {{"timeout", 1}}),
                 Of("labeling/b/assay", {0.01}), Of("labeling/b/z3", {1}, {{"timeout", 0}})}};
  const std::string report = Report(measurements);
  EXPECT_THAT(report, HasSubstr("| a | 10 ms | > 2 s | > 200 (200 to 200) |"));
  EXPECT_THAT(report, HasSubstr("| b | 10 ms | 1 s | 100 (100 to 100) |"));
}

TEST(ContingentTable, SetsPublishedFiguresBesideOurs) {
  Measurements measurements = {.context = {},
                               .series = {Of("Contingent/doors11", {0.02},
                                             {{"nodes", 436},
                                              {"actions", 385},
                                              {"worlds", 161051},
                                              {"all_worlds", 1},
                                              {"po_prp_ms", 34500},
                                              {"po_prp_search_ms", 34000},
                                              {"po_prp_pairs", 461}}),
                                          Of("Contingent/clog5", {0.01},
                                             {{"nodes", 66}, {"worlds", 200}, {"all_worlds", 0}}),
                                          Of("ForceSensing/cans:2", {1})}};
  measurements.series[1].label = "refused";
  measurements.series.push_back({.name = "Contingent/wrong", .wrong = "the goal fails"});
  const std::string table = ContingentTable(measurements);
  EXPECT_THAT(table, HasSubstr("| doors11 | 436 | 385 | 20 ms | 461 | 34.5 s | 34 s | "
                               "in all 161051 worlds |"));
  EXPECT_THAT(table, HasSubstr("| clog5 | 66 |  | 10 ms |  | refused |  | in 200 worlds |"));
  EXPECT_THAT(table, HasSubstr("| **refused**: the goal fails |"));
  EXPECT_THAT(table,
              HasSubstr("PO-PRP's time is 1725 times the time of `assay`, and its search time "
                        "alone is 1700 times"));
  EXPECT_THAT(table, testing::Not(HasSubstr("cans")));
}

TEST(PlotScript, DrawsWhatThereIs) {
  EXPECT_THAT(PlotScript(TwoInstances()), HasSubstr("set output 'ratios.svg'"));
  EXPECT_THAT(PlotScript(TwoInstances()), testing::Not(HasSubstr("growth.svg")));
  const Measurements alone = {.context = {}, .series = {Of("labeling/a/assay", {1})}};
  EXPECT_THAT(PlotScript(alone), testing::Not(HasSubstr("ratios.svg")));
}

std::filesystem::path Write(const std::string& name, const std::string& text) {
  const std::filesystem::path path = ScratchFile(name);
  std::ofstream(path) << text;
  return path;
}

TEST(Measurements, ReadsWhatGoogleBenchmarkWrites) {
  const auto pass = [](const std::string& name, const std::string& time) {
    return Write(
        name,
        R"({"context": {"host_name": "h", "executable": "bench/a_bench", "num_cpus": 2, "caches": []},
      "benchmarks": [
        {"name": "A/b/assay/min_time:0.001", "run_type": "iteration", "iterations": 7, "real_time": 9,
         "cpu_time": )" +
            time +
            R"(, "time_unit": "us", "nodes": 12},
        {"name": "A/b/peer/iterations:3", "run_type": "iteration", "error_occurred": true,
         "error_message": "answers differ"},
        {"name": "A/b/in_turn/iterations:1/manual_time", "run_type": "iteration", "real_time": 5,
         "cpu_time": 9, "time_unit": "ms"},
        {"name": "A_mean", "run_type": "aggregate", "cpu_time": 1, "time_unit": "us"}]})");
  };
  const Measurements measurements = Read({pass("pass1.json", "2"), pass("pass2.json", "4")});
  ASSERT_THAT(measurements.series, SizeIs(3));
  EXPECT_EQ(measurements.series[0].name, "A/b/assay");
  EXPECT_EQ(measurements.series[0].program, "a");
  EXPECT_THAT(measurements.series[0].seconds,
              ElementsAre(DoubleNear(2e-6, 1e-18), DoubleNear(4e-6, 1e-18)));
  EXPECT_EQ(measurements.series[0].counters.at("nodes"), 12);
  EXPECT_EQ(measurements.series[0].counters.size(), 1u);
  EXPECT_EQ(measurements.series[1].name, "A/b/peer");
  EXPECT_EQ(measurements.series[1].wrong, "answers differ");
  EXPECT_EQ(measurements.series[2].name, "A/b/in_turn");
  EXPECT_THAT(measurements.series[2].seconds,
              ElementsAre(DoubleNear(5e-3, 1e-15), DoubleNear(5e-3, 1e-15)));
  EXPECT_EQ(measurements.context.at("num_cpus"), "2");
}

// Writes one pass of the benchmark "labeling/a", in which 5 times the speed of gecode is demanded.
// Each contestant has its time in microseconds, or the reason why its answer is wrong.
std::filesystem::path WritePass(
    const std::string& name, const std::vector<std::pair<std::string, std::string>>& contestants) {
  std::vector<std::string> entries;
  for (const auto& [contestant, told] : contestants) {
    const bool is_time = told.find_first_not_of("0123456789") == std::string::npos;
    entries.push_back(R"({"name": "labeling/a/)" + contestant + R"(", "run_type": "iteration", )" +
                      (is_time ? R"("cpu_time": )" + told + R"(, "time_unit": "us"})"
                               : R"("error_occurred": true, "error_message": ")" + told + R"("})"));
  }
  std::string joined;
  for (const std::string& entry : entries) joined += (joined.empty() ? "" : ", ") + entry;
  return Write(name, R"({"context": {"executable": "labeling_bench", "labeling/at_least": "5",
      "labeling/against": "gecode"}, "benchmarks": [)" +
                         joined + "]}");
}

TEST(WrongAnswers, OfOnePassAreToldFirstAndLeaveNothingThatHolds) {
  const auto right = WritePass("right.json", {{"assay", "1"}, {"gecode", "9"}, {"z3", "30"}});
  EXPECT_THAT(Read({right}).Wrong(), testing::IsEmpty());
  EXPECT_THAT(Report(Read({right})), HasSubstr("| 5 times gecode | holds |"));

  const auto wrong =
      WritePass("wrong.json", {{"assay", "2"}, {"gecode", "its answer is not ours"}, {"z3", "80"}});
  for (const auto& passes : {std::vector{right, wrong, right}, {wrong, right}, {wrong}}) {
    const Measurements measurements = Read(passes);
    ASSERT_THAT(measurements.Wrong(), SizeIs(1));
    EXPECT_EQ(measurements.Wrong()[0]->name, "labeling/a/gecode");
    EXPECT_THAT(measurements.Wrong()[0]->seconds, testing::IsEmpty());
    const std::string report = Report(measurements);
    EXPECT_LT(report.find("- labeling/a/gecode: **its answer is not ours**"),
              report.find("## Ratios"));
    EXPECT_THAT(report, HasSubstr("| 5 times gecode | **does not hold: wrong answers** |"));
  }
}

TEST(WrongAnswers, OfAPeerLeaveTheOthersPaired) {
  const Measurements measurements =
      Read({WritePass("1.json", {{"assay", "1"}, {"gecode", "wrong"}, {"z3", "30"}}),
            WritePass("2.json", {{"assay", "2"}, {"gecode", "9"}, {"z3", "80"}})});
  const Contest contest = Families(measurements)[0].contests[0];
  EXPECT_EQ(contest.Find("gecode"), nullptr);
  EXPECT_NEAR(contest.Find("z3")->ratio.least, 30, 1e-9);
  EXPECT_NEAR(contest.Find("z3")->ratio.greatest, 40, 1e-9);
}

TEST(WrongAnswers, OfOursAreNotForgottenWithTheContest) {
  const std::string report =
      Report(Read({WritePass("ours.json", {{"assay", "no such labeling"}, {"gecode", "9"}})}));
  EXPECT_THAT(report, HasSubstr("- labeling/a/assay: **no such labeling**"));
  EXPECT_THAT(report, HasSubstr("| **does not hold: wrong answers** |"));
}

TEST(WrongAnswers, WithoutAPeerAreToldToo) {
  Measurements measurements = {.context = {},
                               .series = {Of("Plan/fig13", {}, {{"at_most_ms", 20}})}};
  measurements.series[0].wrong = "there is no plan";
  const std::string report = Report(measurements);
  EXPECT_THAT(report, HasSubstr("## Wrong answers"));
  EXPECT_THAT(report, HasSubstr("| Plan/fig13 | **wrong**: there is no plan | at most 20 ms: "
                                "**missed** |"));
}

TEST(Measurements, TellsWhichFileIsNoResult) {
  EXPECT_THROW(Read({Write("cut.json", "{\"context\": {")}), InputError);
  EXPECT_THROW(Read({Write("other.json", "{}")}), InputError);
}

}  // namespace
}  // namespace assay::bench::summary_test
