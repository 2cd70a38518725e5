#include "planner/plan/plan_files/travel_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "planner/base/input_files/input_error.h"
#include "planner/base/random.h"

namespace assay::plan::travel_file_test {
namespace {

using ::testing::HasSubstr;

Travel Read(const std::string& json) {
  return ReadTravel(Document::Parse(json, "travel.json").root());
}

TEST(TravelFile, ReadsBackTheVerySameNumbers) {
  RandomStream random(71, "travel");
  Travel travel{.path = {}, .clearance = random.Uniform(), .is_usual = true};
  for (int i = 0; i < 4; ++i) {
    kinematics::JointVector q;
    for (int j = 0; j < 6; ++j) q[j] = random.Uniform(-3, 3);
    travel.path.push_back(q);
  }
  const Travel again = Read(ToJson(travel).dump());
  EXPECT_EQ(again.path, travel.path);
  EXPECT_EQ(again.clearance, travel.clearance);
  EXPECT_TRUE(again.is_usual);
}

TEST(TravelFile, TellsWhatIsWrongAndWhere) {
  const auto expect = [](const std::string& json, const char* words) {
    try {
      Read(json);
      ADD_FAILURE() << json;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(words));
      EXPECT_THAT(error.what(), HasSubstr("travel.json:1:"));
    }
  };
  const std::string q = "[0, 0, 0, 0, 0, 0]";
  expect(R"({"path": [)" + q + R"(], "clearance": 0})", "at least 2");
  expect(R"({"path": [)" + q + R"(, [0, 0]], "clearance": 0})", "2 joint values");
  expect(R"({"path": [)" + q + "," + q + R"(], "clearance": -1})",
         "-1 m is out of range; allowed: 0 m or more");
  expect(R"({"path": [)" + q + "," + q + R"(], "clearance": 0, "speed": 1})", "speed");
  expect(R"({"path": [)" + q + "," + q + R"(], "clearance": 0, "usual": 1})", "true or false");
}

}  // namespace
}  // namespace assay::plan::travel_file_test
