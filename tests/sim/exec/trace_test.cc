#include "sim/exec/trace.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/oracle/json_schema.h"

namespace assay::exec {
namespace {

using Json = nlohmann::json;
using testing::IsEmpty;

Moment SomeMoment(double time) {
  return {.time = time,
          .tool = {geometry::Translation(0.1, 0.2, 0.3) * geometry::RotationX(3.5),
                   geometry::Translation(0.1, 0.2, 0.31)},
          .parts = {{geometry::Translation(1, 2, 3), Pose::Identity()}},
          .opening = 0.05,
          .wrist = {.force = {1, 2, 3}, .torque = {4, 5, 6}},
          .contacts = {{"part/peg", "world"}}};
}

Trace OneOfEach() {
  return {.problem = "test",
          .parts = {"peg"},
          .events = {Sample{SomeMoment(0)},
                     GraspFact{.time = 0.5,
                               .part = PartId(0),
                               .expected_width = 0.05,
                               .opening = 0.0512,
                               .pads_touch = true},
                     LookRecord{.time = 0.75,
                                .part = PartId(0),
                                .sensor = "overhead-camera",
                                .believed = geometry::Translation(1, 2, 4)},
                     StepEnd{plan::StepId(0), "action_1", "pickup(peg, PG1)", SomeMoment(1)},
                     RestRecord{.duration = 0.5, .parts = {{1e-6, 2e-6}}},
                     ExecutionEnd{.outcome = ExecutionOutcome::kOverload,
                                  .reason = "too much",
                                  .moment = SomeMoment(2)}}};
}

std::vector<Json> Lines(const Trace& trace) {
  std::stringstream text;
  WriteTrace(trace, text);
  std::vector<Json> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(Json::parse(line));
  return lines;
}

TEST(TraceTest, EveryLineFollowsTheSchema) {
  std::ifstream file(ASSAY_SOURCE_DIR "/sim/exec/trace.schema.json");
  const oracle::JsonSchema schema(Json::parse(file));
  const std::vector<Json> lines = Lines(OneOfEach());
  ASSERT_EQ(lines.size(), 7u);
  for (const Json& line : lines) EXPECT_THAT(schema.Errors(line), IsEmpty()) << line.dump(2);
}

TEST(TraceTest, SaysWhatItWasGiven) {
  const std::vector<Json> lines = Lines(OneOfEach());
  EXPECT_EQ(lines[0]["parts"], Json::parse(R"(["peg"])"));
  EXPECT_EQ(lines[1]["parts"]["peg"]["true"]["position"], Json::parse("[1.0, 2.0, 3.0]"));
  EXPECT_EQ(lines[1]["contacts"], Json::parse(R"([["part/peg", "world"]])"));
  EXPECT_EQ(lines[1]["wrist"]["torque"], Json::parse("[4.0, 5.0, 6.0]"));
  EXPECT_EQ(lines[2]["holds"], false);
  EXPECT_EQ(lines[3]["sensor"], "overhead-camera");
  EXPECT_EQ(lines[3]["believed"]["position"], Json::parse("[1.0, 2.0, 4.0]"));
  EXPECT_EQ(lines[4]["action"], "pickup(peg, PG1)");
  EXPECT_EQ(lines[6]["outcome"], "overload");
}

// Of the two quaternions of a rotation the one with w >= 0: 3.5 rad about x is -2.78 rad.
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
}  // namespace assay::exec
