#include "sim/execution/trace/trace.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <sstream>

#include "planner/base/input_files/input_error.h"
#include "planner/geometry/pose.h"
#include "tests/sim/execution/trace/trace_schema.h"

namespace assay::execution::trace_test {
namespace {

using Json = nlohmann::json;
using testing::IsEmpty;
using testing::Not;

Snapshot SomeSnapshot(double time) {
  return {.time = time,
          .tool = {geometry::Translation(0.1, 0.2, 0.3) * geometry::RotationX(3.5),
                   geometry::Translation(0.1, 0.2, 0.31)},
          .parts = {{geometry::Translation(1, 2, 3), Pose::Identity()}},
          .table_heights = {0.002},
          .opening = 0.05,
          .wrist = {.force = {1, 2, 3}, .torque = {4, 5, 6}},
          .contacts = {{"part/peg", "world"}},
          .arms = {{.q = scene::JointVector(0.1, -0.2, 0.3, -0.4, 0.5, -0.6), .opening = 0.05}}};
}

LookRecord SomeLook(bool found) {
  return {.time = 0.75,
          .part = PartId(0),
          .sensor = "overhead-camera",
          .found = found,
          .measured = geometry::Translation(1, 2, 5),
          .before = {Pose::Identity(), geometry::Translation(1, 2, 3)},
          .believed = geometry::Translation(1, 2, 4)};
}

Trace OneOfEach() {
  const VerificationRecord check = {.time = 0.8,
                                    .step = plan::StepId(2),
                                    .name = "gripper-opening",
                                    .measured = 0,
                                    .expected = 0.05,
                                    .tolerance = 0.001,
                                    .error = "error1"};
  const RecoveryRecord recovery = {.time = 0.9,
                                   .step = plan::StepId(2),
                                   .error = "error1",
                                   .strategy = domain::RecoveryStrategy::kGropingSearch,
                                   .attempt = 3,
                                   .offset = {0.003, 0, 0}};
  const MotionRecord motion = {.time = 1.5,
                               .step = plan::StepId(1),
                               .motion = 3,
                               .attempt = 2,
                               .outcome = TrialOutcome::kWrongContact,
                               .recognized = RecognizedContact{"vertex 8 on face 6", false}};
  return {
      .problem = "test",
      .parts = {"peg"},
      .events = {Sample{SomeSnapshot(0)},
                 GraspFact{.time = 0.5,
                           .part = PartId(0),
                           .expected_width = 0.05,
                           .opening = 0.0512,
                           .pads_touch = true},
                 SomeLook(true), SomeLook(false),
                 GuardRecord{.time = 0.76,
                             .resisted = true,
                             .tool = geometry::Translation(1, 2, 6),
                             .from = 0.7,
                             .force = 15,
                             .direction = {0, 0, -1}},
                 Milestone{plan::StepId(2), Stage::kReached, SomeSnapshot(0.78)}, check, recovery,
                 StepEnd{plan::StepId(0), "action_1", "pickup(peg, PG1)", SomeSnapshot(1)}, motion,
                 RestRecord{.duration = 0.5, .parts = {{1e-6, 2e-6}}},
                 CollisionRecord{1.5, "arm/forearm", "part/peg"}, ExecutionStart{SomeSnapshot(0)},
                 ExecutionEnd{.outcome = TrialOutcome::kOverload,
                              .reason = "too much",
                              .snapshot = SomeSnapshot(2)}}};
}

class TraceSchema : public testing::Test {
 protected:
  TraceSchema() : schema_(TraceSchemaFile()) {}

  oracle::JsonSchema schema_;
};

TEST_F(TraceSchema, EveryLineFollowsIt) {
  const std::vector<Json> lines = Lines(OneOfEach());
  ASSERT_EQ(lines.size(), 15u);
  for (const Json& line : lines) EXPECT_THAT(schema_.Errors(line), IsEmpty()) << line.dump(2);
}

// Each kind of line has only fields that the schema describes.
TEST_F(TraceSchema, TellsOfEveryField) {
  for (const Json& line : Lines(OneOfEach())) {
    const std::string kind = line.value("kind", "header");
    const Json fields = TraceSchemaFile()["definitions"][kind]["properties"];
    for (const auto& [name, value] : line.items()) {
      EXPECT_TRUE(fields.contains(name)) << kind << "/" << name;
    }
  }
}

TEST_F(TraceSchema, HasEveryOutcomeAndStage) {
  Trace trace = OneOfEach();
  for (int i = 0; i <= static_cast<int>(TrialOutcome::kOperatorCalled); ++i) {
    std::get<ExecutionEnd>(trace.events.back()).outcome = static_cast<TrialOutcome>(i);
    EXPECT_THAT(schema_.Errors(Lines(trace).back()), IsEmpty());
  }
  using enum TrialOutcome;
  for (const TrialOutcome outcome : {kSucceeded, kUnreachable, kOverload, kEngineWarning, kJammed,
                                     kWedged, kWrongContact, kTimeout, kDropped}) {
    trace.events = {MotionRecord{.step = plan::StepId(0), .outcome = outcome}};
    EXPECT_THAT(schema_.Errors(Lines(trace).back()), IsEmpty());
  }
  for (const Stage stage : {Stage::kPoised, Stage::kReached, Stage::kActed}) {
    trace.events = {Milestone{plan::StepId(0), stage, SomeSnapshot(0)}};
    EXPECT_THAT(schema_.Errors(Lines(trace).back()), IsEmpty());
  }
}

TEST_F(TraceSchema, RefusesWhatIsMissing) {
  const std::vector<Json> lines = Lines(OneOfEach());
  for (const Json& line : lines) {
    for (const auto& [name, value] : line.items()) {
      Json less = line;
      less.erase(name);
      EXPECT_THAT(schema_.Errors(less), Not(IsEmpty())) << name << " of " << line.dump(2);
    }
  }
}

TEST(TraceTest, SaysWhatItWasGiven) {
  const std::vector<Json> lines = Lines(OneOfEach());
  EXPECT_EQ(lines[0]["parts"], Json::parse(R"(["peg"])"));
  EXPECT_EQ(lines[1]["parts"]["peg"]["true"]["position"], Json::parse("[1.0, 2.0, 3.0]"));
  EXPECT_EQ(lines[1]["table_heights"], Json::parse("[0.002]"));
  EXPECT_EQ(lines[1]["contacts"], Json::parse(R"([["part/peg", "world"]])"));
  EXPECT_EQ(lines[1]["wrist"]["torque"], Json::parse("[4.0, 5.0, 6.0]"));
  EXPECT_EQ(lines[2]["holds"], false);
  EXPECT_EQ(lines[9]["action"], "pickup(peg, PG1)");
  EXPECT_EQ(lines[12]["other"], "part/peg");
  EXPECT_EQ(lines[13]["kind"], "start");
  EXPECT_EQ(lines[14]["outcome"], "overload");
}

TEST(TraceTest, SaysWhatSensorsTold) {
  const std::vector<Json> lines = Lines(OneOfEach());
  EXPECT_EQ(lines[3]["sensor"], "overhead-camera");
  EXPECT_EQ(lines[3]["before"]["believed"]["position"], Json::parse("[1.0, 2.0, 3.0]"));
  EXPECT_EQ(lines[3]["measured"]["position"], Json::parse("[1.0, 2.0, 5.0]"));
  EXPECT_EQ(lines[3]["believed"]["position"], Json::parse("[1.0, 2.0, 4.0]"));
  EXPECT_EQ(lines[4]["found"], false);
  EXPECT_FALSE(lines[4].contains("measured"));
  EXPECT_EQ(lines[5]["resisted"], true);
  EXPECT_EQ(lines[5]["tool"]["position"], Json::parse("[1.0, 2.0, 6.0]"));
}

TEST(TraceTest, SaysWhatWasVerifiedAndDone) {
  const std::vector<Json> lines = Lines(OneOfEach());
  EXPECT_EQ(lines[6]["stage"], "reached");
  EXPECT_EQ(lines[6]["step"], 2);
  EXPECT_EQ(lines[7]["name"], "gripper-opening");
  EXPECT_EQ(lines[7]["error"], "error1");
  EXPECT_EQ(lines[8]["strategy"], "groping-search");
  EXPECT_EQ(lines[8]["attempt"], 3);
  EXPECT_EQ(lines[8]["offset"], Json::parse("[0.003, 0.0, 0.0]"));
}

TEST(TraceTest, SaysHowMotionsEnded) {
  const Json line = Lines(OneOfEach())[10];
  EXPECT_EQ(line["kind"], "motion");
  EXPECT_EQ(line["step"], 1);
  EXPECT_EQ(line["motion"], 4) << "numbered from 1";
  EXPECT_EQ(line["attempt"], 2);
  EXPECT_EQ(line["outcome"], "wrong-contact");
  EXPECT_EQ(line["recognized"]["contact"], "vertex 8 on face 6");
  EXPECT_EQ(line["recognized"]["loss"], false);
}

TEST(TraceTest, SaysWhereTheArmsAre) {
  const Json arm = Lines(OneOfEach())[1]["arms"][0];
  EXPECT_EQ(arm["joints"], Json::parse("[0.1, -0.2, 0.3, -0.4, 0.5, -0.6]"));
  EXPECT_EQ(arm["opening"], 0.05);
}

// Returns the numbers and words of a trace's lines by their places.
std::map<std::string, Json> Leaves(const Trace& trace) {
  std::map<std::string, Json> leaves;
  int number = 0;
  for (const Json& line : Lines(trace)) {
    ++number;
    const Json flat = line.flatten();
    for (const auto& [place, value] : flat.items()) {
      leaves[std::to_string(number) + place] = value;
    }
  }
  return leaves;
}

std::string TextOf(const Trace& trace) {
  std::ostringstream text;
  WriteTrace(trace, text);
  return text.str();
}

TEST(ReadTraceTest, ReadsWhatWasWritten) {
  const Trace trace = OneOfEach();
  const std::map<std::string, Json> written = Leaves(trace);
  const std::map<std::string, Json> read = Leaves(ReadTrace(TextOf(trace), "t"));
  ASSERT_EQ(read.size(), written.size());
  for (const auto& [place, value] : written) {
    ASSERT_TRUE(read.contains(place)) << place;
    if (value.is_number_float()) {
      EXPECT_NEAR(read.at(place).get<double>(), value.get<double>(), 1e-12) << place;
    } else {
      EXPECT_EQ(read.at(place), value) << place;
    }
  }
}

TEST(ReadTraceTest, RefusesATraceThatWasCutOff) {
  const std::string text = TextOf(OneOfEach());
  for (const std::size_t size : {std::size_t{0}, text.size() / 2, text.rfind("\n{")}) {
    EXPECT_THROW(ReadTrace(text.substr(0, size), "t"), InputError) << size;
  }
}

TEST(ReadTraceTest, NamesTheLineOfAnError) {
  std::string text = TextOf(OneOfEach());
  text.replace(text.find("gripper-opening") - 12, 4, "?");
  try {
    ReadTrace(text, "t");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.place().line, 8);
  }
}

// Three samples with two contacts: the peg rests, and a finger leaves it. The last sample does not
// know its points.
Trace WithContactPoints() {
  Snapshot touching = SomeSnapshot(0);
  touching.contacts = {{"gripper/finger_left", "part/peg"}, {"part/peg", "world"}};
  const ContactPoint finger = {0, {0.1, 0.2, 0.3}, {0, 1, 0}, {0.5, 12.3456789, -1}};
  const ContactPoint table = {1, {0.12345678, 0, -1e-9}, {0, 0, -1}, {0, 0, -2}};
  return {
      .problem = "test",
      .parts = {"peg"},
      .events = {Sample{touching, {{finger, table, table}}}, Sample{touching, {{finger, table}}},
                 Sample{SomeSnapshot(1), {{{0, table.position, table.normal, table.force}}}},
                 Sample{SomeSnapshot(2)}, ExecutionEnd{.snapshot = SomeSnapshot(2)}}};
}

// A sample has only the pairs whose points have changed. Numbers are rounded.
TEST(ContactPoints, AreWrittenWhereTheyChange) {
  const std::vector<Json> lines = Lines(WithContactPoints());
  const oracle::JsonSchema schema(TraceSchemaFile());
  for (const Json& line : lines) EXPECT_THAT(schema.Errors(line), IsEmpty());
  const Json finger = Json::parse("[0.1, 0.2, 0.3, 0, 1, 0, 0.5, 12.346, -1]");
  const Json table = Json::parse("[0.123457, 0, 0, 0, 0, -1, 0, 0, -2]");
  EXPECT_EQ(lines[1]["contact_points"],
            Json({{{"bodies", {"gripper/finger_left", "part/peg"}}, {"points", {finger}}},
                  {{"bodies", {"part/peg", "world"}}, {"points", {table, table}}}}));
  EXPECT_EQ(lines[2]["contact_points"],
            Json({{{"bodies", {"part/peg", "world"}}, {"points", {table}}}}));
  EXPECT_EQ(lines[3]["contact_points"], Json::array());
  EXPECT_FALSE(lines[4].contains("contact_points"));
}

TEST(ContactPoints, AreReadAtEachSample) {
  const Trace written = WithContactPoints();
  const Trace trace = ReadTrace(TextOf(written), "t");
  EXPECT_EQ(TextOf(trace), TextOf(written));
  const auto read = trace.All<Sample>();
  const auto expected = written.All<Sample>();
  ASSERT_EQ(read.size(), 4u);
  EXPECT_FALSE(read[3]->contact_points);
  for (std::size_t i = 0; i < 3; ++i) {
    ASSERT_EQ(read[i]->contact_points->size(), expected[i]->contact_points->size()) << i;
    for (std::size_t k = 0; k < read[i]->contact_points->size(); ++k) {
      const ContactPoint& point = (*read[i]->contact_points)[k];
      const ContactPoint& known = (*expected[i]->contact_points)[k];
      EXPECT_EQ(point.pair, known.pair);
      EXPECT_LT((point.position - known.position).norm(), 1e-6);
      EXPECT_LT((point.force - known.force).norm(), 1e-3);
      EXPECT_EQ(point.normal, known.normal);
    }
  }
}

TEST(ContactPoints, OfATraceAreChecked) {
  const std::string text = TextOf(WithContactPoints());
  const auto expect_refused = [&](const std::string& from, const std::string& to) {
    std::string wrong = text;
    wrong.replace(wrong.find(from), from.size(), to);
    EXPECT_THROW(ReadTrace(wrong, "t"), InputError) << to;
  };
  expect_refused(R"({"bodies":["gripper/finger_left","part/peg"])",
                 R"({"bodies":["gripper/finger_left","part/pin"])");
  expect_refused(R"({"bodies":["gripper/finger_left","part/peg"])", R"({"bodies":"part/peg")");
  expect_refused("12.346,-1.0]", "12.346]");
  expect_refused("12.346", "\"x\"");
}

// A rotation has two quaternions, and the trace has the one with w >= 0. The example is 3.5 rad
// about x, which is -2.78 rad.
TEST(TraceTest, QuaternionsAreUnique) {
  const Json quaternion = Lines(OneOfEach())[1]["tool"]["true"]["quaternion"];
  EXPECT_NEAR(quaternion[0].get<double>(), -std::cos(1.75), 1e-12);
  EXPECT_NEAR(quaternion[1].get<double>(), -std::sin(1.75), 1e-12);
}

TEST(GraspFactTest, HoldsUpToItsTolerance) {
  GraspFact fact{
      .time = 0, .part = PartId(0), .expected_width = 0.05, .opening = 0.0509, .pads_touch = true};
  EXPECT_TRUE(fact.holds());
  fact.opening = 0.0511;
  EXPECT_FALSE(fact.holds());
  fact.opening = 0.0489;
  EXPECT_FALSE(fact.holds());
  fact.opening = 0.05;
  fact.pads_touch = false;
  EXPECT_FALSE(fact.holds());
}

}  // namespace
}  // namespace assay::execution::trace_test
