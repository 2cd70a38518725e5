#include "sim/view/page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "planner/geometry/pose.h"
#include "planner/plan/certificates/condition_table.h"
#include "planner/plan/certificates/coverage.h"
#include "planner/plan/certificates/not_covered.h"
#include "tests/sim/view/recording/series_decoder.h"
#include "tests/sim/view/viewed_execution.h"

namespace assay::view::page_test {
namespace {

using Json = nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

// Returns the text between two marks.
std::string Between(const std::string& text, const std::string& from, const std::string& to) {
  const std::size_t begin = text.find(from) + from.size();
  return text.substr(begin, text.find(to, begin) - begin);
}

Json DataIn(const std::string& page) {
  return Json::parse(Between(page, "id=\"data\">", "</script>"));
}

std::string FromBase64(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text.substr(0, text.find('='))) {
    bits = bits << 6 | static_cast<std::uint32_t>(digits.find(c));
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes += static_cast<char>(bits >> count & 255);
  }
  return bytes;
}

std::size_t PegIndex() {
  const std::vector<std::string>& parts = Figure15().trace.parts;
  return static_cast<std::size_t>(std::ranges::find(parts, "peg") - parts.begin());
}

class PageOfFigure15 : public ::testing::Test {
 protected:
  static const std::string& page() {
    static const std::string page = Page(Figure15().subject());
    return page;
  }
  static const Json& data() {
    static const Json data = DataIn(page());
    return data;
  }
};

TEST_F(PageOfFigure15, IsTheSameAgainAndSmall) {
  EXPECT_EQ(Page(Figure15().subject()), page());
  EXPECT_LT(page().size(), 1'000'000u);
}

TEST_F(PageOfFigure15, HasEveryStepInTheOrderOfExecution) {
  double time = 0;
  int number = 0;
  for (const Json& step : data()["steps"]) {
    EXPECT_EQ(step["number"], ++number);
    EXPECT_EQ(step["from"], time);
    EXPECT_TRUE(step["ended"]);
    time = step["to"];
  }
  EXPECT_EQ(number, static_cast<int>(Figure15().plan.steps.size()));
  EXPECT_LT(time, Figure15().trace.end().snapshot.time);
}

TEST_F(PageOfFigure15, CountsEveryPrecondition) {
  const plan::Plan& plan = Figure15().plan;
  std::size_t at = 0;
  for (const plan::StepId id : plan.ExecutionOrder()) {
    std::size_t all = 0;
    std::size_t open = 0;
    double margin = -std::numeric_limits<double>::infinity();
    for (const Json& group : data()["steps"][at]["preconditions"]) {
      all += group["count"].get<std::size_t>();
      open += group["open"].get<std::size_t>();
      EXPECT_LE(margin, group["margin"].get<double>()) << "the least comes first";
      margin = group["margin"];
      EXPECT_EQ(group["standing"] == "proved", group["open"] == 0);
    }
    const auto& claims = plan.step(id).certificate.preconditions;
    EXPECT_EQ(all, claims.size());
    EXPECT_EQ(open, std::ranges::count_if(claims, [](const auto& c) { return !c.holds(); }));
    ++at;
  }
}

// A plan by the paper's rules leaves out conditions. Its page does not say that all is proved.
TEST_F(PageOfFigure15, SaysThatCertificatesAreAsPublished) {
  EXPECT_FALSE(data().contains("asPublished"));
  plan::Plan plan = Figure15().plan;
  plan.steps[0].certificate.not_needed.push_back(
      {plan::condition::kReach, std::string(plan::kNotPublished)});
  Subject subject = Figure15().subject();
  const Json published = DataIn(Page(
      {.problem = subject.problem, .plan = plan, .scene = subject.scene, .trace = subject.trace}));
  EXPECT_EQ(published["asPublished"], true);
}

// The planner computes one number for the whole way of the arm, and for the load that the pads
// bear. Such a number counts all errors, and says nothing about an execution without errors.
TEST_F(PageOfFigure15, ANumberForAllErrorsIsNoValueWithoutErrors) {
  std::set<std::string> with_nominal, without_nominal;
  for (const Json& step : data()["steps"]) {
    for (const Json& group : step["preconditions"]) {
      (group.contains("nominal") ? with_nominal : without_nominal)
          .insert(group["condition"].get<std::string>());
      if (!group.contains("nominal")) {
        EXPECT_TRUE(group["costs"].empty());
      }
    }
  }
  EXPECT_TRUE(with_nominal.contains("between fingers"));
  EXPECT_TRUE(without_nominal.contains("way clear"));
  EXPECT_TRUE(without_nominal.contains("holding"));
}

// The page says that a way of the arm is proved, or what errors may cause on this way.
TEST(Page, SaysWhyAWayIsNotProved) {
  int unproved = 0;
  const Json data = DataIn(Page(WithAnUnprovedWay().subject()));
  for (const Json& step : data["steps"]) {
    const auto& lacking = step["notNeeded"];
    const bool lacks_way = std::ranges::any_of(
        lacking, [](const Json& kind) { return kind["condition"] == "way clear"; });
    EXPECT_EQ(step["unprovedWays"].empty(), !lacks_way) << step["number"];
    for (const Json& way : step["unprovedWays"]) {
      ++unproved;
      EXPECT_EQ(way["condition"], "way clear");
      EXPECT_THAT(way["text"].get<std::string>(), HasSubstr("are nearer than"));
      EXPECT_FALSE(way["marked"].empty());
      EXPECT_LT(way["share"].get<double>(), 1);
    }
  }
  EXPECT_EQ(unproved, 1);
}

TEST_F(PageOfFigure15, NamesWhatIsNotCovered) {
  EXPECT_EQ(data()["notCovered"],
            Json(plan::NotCovered(Figure15().scenario.problem, Figure15().plan)));
}

// The recorded hand is where the trace has the tool, and recorded parts are where it has them: the
// joint values of the trace lead there.
TEST_F(PageOfFigure15, RecordsWhatTheTraceHas) {
  const Json& recording = data()["recording"];
  const std::string series = recording["series"];
  SeriesDecoder decoder(FromBase64(series.substr(series.find(',') + 1)));
  const std::size_t count = recording["samples"];
  const auto samples = Figure15().trace.All<execution::Sample>();
  ASSERT_EQ(count, samples.size());
  const auto next = [&] { return decoder.Next(count); };
  next();
  const geometry::Pose X_HandTool =
      Figure15().scenario.problem.workcell->robots().front().gripper->X_FlangeTool();
  for (const Json& body : data()["bodies"]) {
    const std::string name = body["name"];
    if (name == "world") continue;
    std::array<std::vector<std::int64_t>, 7> track;
    for (auto& column : track) column = next();
    if (name != "gripper/hand" && name != "part/peg") continue;
    for (std::size_t i = 0; i < count; ++i) {
      const auto turn = [&](int k) { return static_cast<double>(track[3 + k][i]); };
      geometry::Pose pose = geometry::Pose::Identity();
      pose.linear() =
          Eigen::Quaterniond(turn(0), turn(1), turn(2), turn(3)).normalized().toRotationMatrix();
      for (int k = 0; k < 3; ++k) pose.translation()[k] = 1e-5 * static_cast<double>(track[k][i]);
      const execution::Snapshot& snapshot = samples[i]->snapshot;
      const geometry::Pose expected = name == "part/peg"
                                          ? snapshot.parts[PegIndex()].truth
                                          : snapshot.tool.truth * X_HandTool.inverse();
      EXPECT_LT((pose.translation() - expected.translation()).norm(), 3e-5) << name << " " << i;
      EXPECT_LT(geometry::AngleBetween(pose.linear(), expected.linear()), 2e-4) << name;
    }
  }
  for (std::size_t i = 0; i < 7 * data()["parts"].size() + 6; ++i) next();
  EXPECT_TRUE(decoder.IsAtEnd());
}

// The points of two touching bodies as the page has them: whole numbers, at each sample.
struct PairInPage {
  std::string first;
  std::string second;
  std::vector<std::int64_t> counts;
  std::vector<std::array<std::vector<std::int64_t>, 9>> points;
};

std::vector<PairInPage> ContactPointsIn(const Json& data) {
  const std::string series = data["contactPoints"]["series"];
  SeriesDecoder decoder(FromBase64(series.substr(series.find(',') + 1)));
  std::vector<PairInPage> pairs;
  for (const Json& pair : data["contactPoints"]["pairs"]) {
    PairInPage& added =
        pairs.emplace_back(PairInPage{pair["bodies"][0],
                                      pair["bodies"][1],
                                      decoder.Next(data["recording"]["samples"].get<std::size_t>()),
                                      {}});
    for (int point = 0; point < pair["most"]; ++point) {
      const auto has_it = [&](std::int64_t count) { return count > point; };
      const auto length = static_cast<std::size_t>(std::ranges::count_if(added.counts, has_it));
      for (auto& numbers : added.points.emplace_back()) numbers = decoder.Next(length);
    }
  }
  EXPECT_TRUE(decoder.IsAtEnd());
  return pairs;
}

// The points of parts on the table are where the trace has them, in the frame of the part.
TEST_F(PageOfFigure15, HasTheContactPointsOfTheTrace) {
  const auto samples = Figure15().trace.All<execution::Sample>();
  int compared = 0;
  for (const PairInPage& pair : ContactPointsIn(data())) {
    if (pair.first != "part/peg" || pair.second != "world") continue;
    std::vector<std::size_t> next(pair.points.size(), 0);
    for (std::size_t i = 0; i + 1 < samples.size(); ++i) {
      const execution::Snapshot& snapshot = samples[i]->snapshot;
      const geometry::Pose X_PegWorld = snapshot.parts[PegIndex()].truth.inverse();
      std::size_t at = 0;
      for (const execution::ContactPoint& point : *samples[i]->contact_points) {
        if (snapshot.contacts[point.pair] != std::pair(pair.first, pair.second)) continue;
        const geometry::Vector3 position = X_PegWorld * point.position;
        const geometry::Vector3 force = X_PegWorld.linear() * point.force;
        for (int k = 0; k < 3; ++k) {
          const auto number = [&](int column) {
            return static_cast<double>(pair.points[at][column][next[at]]);
          };
          EXPECT_NEAR(1e-4 * number(k), position[k], 0.6e-4);
          EXPECT_NEAR(1e-2 * number(6 + k), force[k], 0.6e-2);
          ++compared;
        }
        ++next[at++];
      }
      EXPECT_EQ(static_cast<std::size_t>(pair.counts[i]), at) << i;
    }
  }
  EXPECT_GT(compared, 1000);
}

// Returns each key of an object with the keys inside of it. For a list, it returns those of the
// first item.
std::set<std::string> KeysOf(const Json& data, const std::string& path = "") {
  if (data.is_array() && !data.empty()) return KeysOf(data[0], path + "[]");
  std::set<std::string> keys;
  if (!data.is_object()) return keys;
  for (const auto& [key, value] : data.items()) {
    keys.insert(path + "/" + key);
    keys.merge(KeysOf(value, path + "/" + key));
  }
  return keys;
}

// The page that stands under renders has the format of today's pages. If it has an older format, it
// must be made again as renders/README.md says.
TEST_F(PageOfFigure15, TheKeptPageOfFigure13HasTheSameFormat) {
  std::ifstream file(ASSAY_SOURCE_DIR "/renders/spar-fig13/page.html", std::ios::binary);
  const std::string kept(std::istreambuf_iterator<char>(file), {});
  EXPECT_LT(kept.size(), 2'000'000u);
  const Json data = DataIn(kept);
  EXPECT_EQ(data["title"], "spar-fig13");
  for (const char* key : {"bodies", "cameras", "colors", "contactPoints", "errorSets", "format",
                          "guards", "parts", "recording"}) {
    EXPECT_EQ(KeysOf(data[key]), KeysOf(this->data()[key])) << key;
  }
  EXPECT_EQ(data["format"], this->data()["format"]);
  EXPECT_EQ(data.size(), this->data().size()) << "keys of the whole";
}

TEST_F(PageOfFigure15, ErrorSetsFollowEachOther) {
  for (const Json& set : data()["errorSets"]) {
    EXPECT_LE(set["from"].get<double>(), set["to"].get<double>());
    for (const Json& other : data()["errorSets"]) {
      if (other == set || other["part"] != set["part"]) continue;
      EXPECT_TRUE(other["to"] <= set["from"] || set["to"] <= other["from"]);
    }
  }
}

// Another execution beside the first one has the times of its own steps.
TEST_F(PageOfFigure15, HasAnExecutionBeside) {
  Subject subject = Figure15().subject();
  subject.beside.emplace("the same again", Figure15().scene, Figure15().trace);
  const Json beside = DataIn(Page(subject))["beside"];
  EXPECT_EQ(beside["name"], "the same again");
  EXPECT_EQ(beside["recording"], data()["recording"]);
  ASSERT_EQ(beside["times"].size(), data()["steps"].size());
  for (std::size_t i = 0; i < beside["times"].size(); ++i) {
    EXPECT_EQ(beside["times"][i]["from"], data()["steps"][i]["from"]);
    EXPECT_EQ(beside["times"][i]["to"], data()["steps"][i]["to"]);
  }
}

// Actions of a way follow each other in time; those that were not reached have no times.
TEST_F(PageOfFigure15, HasTheActionsOfAWay) {
  Subject subject = Figure15().subject();
  const plan::StepId first = subject.plan.ExecutionOrder().front();
  subject.way = Way{.lines = {{.text = "a", .is_action = true, .is_gone = true, .steps = {0}}},
                    .actions = {{.action = "a", .step = first, .end = 2.0},
                                {.action = "b", .end = 3.0, .facts = {{"left", "nothing"}}},
                                {.action = "c"}}};
  const Json page = DataIn(Page(subject));
  ASSERT_EQ(page["steps"].size(), 3u);
  EXPECT_TRUE(page["steps"][0]["planned"]);
  EXPECT_EQ(page["steps"][0]["preconditions"], data()["steps"][0]["preconditions"]);
  EXPECT_EQ(page["steps"][1]["from"], 2.0);
  EXPECT_EQ(page["steps"][1]["facts"], Json::parse(R"([["left", "nothing"]])"));
  EXPECT_FALSE(page["steps"][2].contains("from"));
  EXPECT_EQ(page["tree"][0]["steps"], Json({0}));
}

// No text of a file can end the script that holds the data.
TEST_F(PageOfFigure15, EscapesTexts) {
  Subject subject = Figure15().subject();
  subject.source = "</script><b>&";
  const std::string page = Page(subject);
  EXPECT_THAT(page, Not(HasSubstr("<b>")));
  EXPECT_EQ(DataIn(page)["source"], subject.source);
}

}  // namespace
}  // namespace assay::view::page_test
