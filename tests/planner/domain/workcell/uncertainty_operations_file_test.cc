#include "planner/domain/workcell/uncertainty_operations_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "planner/base/input_files/input_error.h"
#include "planner/domain/actions/actions.h"

namespace assay::domain::uncertainty_operations_file_test {
namespace {

using testing::HasSubstr;

constexpr double kDegree = std::numbers::pi / 180;

const std::string kSections = R"(units: {length: mm, angle: degree}
sensors:
  side-camera: {error: {z: 0.5, x: [-1, 2]}}
  overhead-camera: {description: looks down, error: {x: 0.3, y: 0.3, theta: 0.2}}
verifications:
  opening: {after: pickup, measures: gripper-opening, tolerance: 1, below: lost, above: wide}
  landed: {after: putdown, measures: tool-height, tolerance: 2, above: high}
recoveries:
  lost: {strategy: groping-search, radius: 10, pitch: 3}
  wide: {strategy: call-operator}
  high: {strategy: retry}
)";

UncertaintyOperations Read(const std::string& text) {
  const Document document = Document::Parse(text, "cell.yaml");
  return ReadUncertaintyOperations(document.root(), ReadUnits(document.root()));
}

std::string MessageWith(const std::string& old_text, const std::string& new_text) {
  std::string text = kSections;
  const std::size_t at = text.find(old_text);
  EXPECT_NE(at, std::string::npos) << old_text;
  text.replace(at, old_text.size(), new_text);
  try {
    Read(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(UncertaintyOperationsFile, EverySectionMayBeLeftOut) {
  const UncertaintyOperations operations = Read("format: any\n");
  EXPECT_TRUE(operations.sensors.empty());
  EXPECT_TRUE(operations.verifications.empty());
  EXPECT_TRUE(operations.recoveries.empty());
  EXPECT_EQ(operations.FindSensor("overhead-camera"), nullptr);
}

TEST(UncertaintyOperationsFile, WhatASensorLeavesOutIsNotMeasured) {
  const UncertaintyOperations operations = Read(kSections);
  ASSERT_EQ(operations.sensors.size(), 2u);
  const SensorModel* side = operations.FindSensor("side-camera");
  ASSERT_EQ(side, &operations.sensors[0]);
  const double infinity = std::numeric_limits<double>::infinity();
  const Interval whole_line = {-infinity, infinity};
  EXPECT_EQ(side->x, (Interval{-0.001, 0.002}));
  EXPECT_EQ(side->y, whole_line);
  EXPECT_EQ(side->z, (Interval{-0.0005, 0.0005}));
  EXPECT_EQ(side->theta, whole_line);
  EXPECT_EQ(side->description, "");
  const SensorModel* overhead = operations.FindSensor("overhead-camera");
  ASSERT_NE(overhead, nullptr);
  EXPECT_NEAR(overhead->theta.low, -0.2 * kDegree, 1e-15);
  EXPECT_EQ(overhead->z, whole_line);
  EXPECT_EQ(overhead->description, "looks down");
}

TEST(UncertaintyOperationsFile, ReadsVerificationsAndRecoveries) {
  const UncertaintyOperations operations = Read(kSections);
  ASSERT_EQ(operations.verifications.size(), 2u);
  const VerificationTemplate& opening = operations.verifications[0];
  EXPECT_EQ(opening.name, "opening");
  EXPECT_EQ(opening.after, &kPickup);
  EXPECT_EQ(opening.quantity, MeasuredQuantity::kGripperOpening);
  EXPECT_EQ(opening.tolerance, 0.001);
  EXPECT_EQ(opening.below, "lost");
  EXPECT_EQ(opening.above, "wide");
  const VerificationTemplate& landed = operations.verifications[1];
  EXPECT_EQ(landed.after, &kPutdown);
  EXPECT_EQ(landed.quantity, MeasuredQuantity::kToolHeight);
  EXPECT_EQ(landed.below, "");
  EXPECT_EQ(landed.above, "high");

  ASSERT_EQ(operations.recoveries.size(), 3u);
  EXPECT_EQ(operations.recoveries[0].error, "lost");
  EXPECT_EQ(operations.recoveries[0].strategy, RecoveryStrategy::kGropingSearch);
  EXPECT_EQ(operations.recoveries[0].radius, 0.010);
  EXPECT_EQ(operations.recoveries[0].pitch, 0.003);
  EXPECT_EQ(operations.recoveries[1].strategy, RecoveryStrategy::kCallOperator);
  EXPECT_EQ(operations.recoveries[2].strategy, RecoveryStrategy::kRetry);
}

struct Slip {
  const char* old_text;
  const char* new_text;
  const char* message;
};

TEST(UncertaintyOperationsFile, EachSlipIsNamedAtItsPlace) {
  const std::vector<Slip> slips = {
      {"error: {z: 0.5, x: [-1, 2]}", "eror: {z: 1}", "did you mean 'error'"},
      {"error: {z: 0.5, x: [-1, 2]}", "description: blind", "missing key 'error'"},
      {"error: {z: 0.5, x: [-1, 2]}", "error: {}",
       "3:24: the sensor 'side-camera' measures nothing"},
      {"z: 0.5", "w: 0.5", "unknown key 'w'"},
      {"z: 0.5", "z: -0.5", "3:28: the half-width -0.5 mm is negative; allowed: 0 mm or more"},
      {"x: [-1, 2]", "x: [2, -1]", "the lower end 2 mm is greater than the upper end -1 mm"},
      {"x: [-1, 2]", "x: [1, 2]", "the interval from 1 mm to 2 mm does not contain 0; allowed: "},
      {"theta: 0.2", "theta: 200", "200 deg is out of range; allowed: -180 deg to 180 deg"},
      {"theta: 0.2", "theta: .nan", "number"},
      {"  overhead-camera:", "  side-camera:", "side-camera"},
      {"after: pickup", "after: pick", "did you mean 'pickup'"},
      {"after: pickup", "after: putdown", "after putdown there is no gripper-opening to measure"},
      {"tool-height", "gripper-opening", "allowed: tool-height"},
      {"measures: tool-height, ", "", "missing key 'measures'"},
      {"tolerance: 1", "tolerance: 0", "6:66: 0 mm is out of range; allowed: 0.001 mm to 100 mm"},
      {"tolerance: 1", "tolerance: 101", "101 mm is out of range"},
      {", above: high", "", "signals no error"},
      {"above: high", "above: hgh", "7:72: unknown name 'hgh'; did you mean 'high'"},
      {"above: high", "beyond: high", "unknown key 'beyond'"},
      {"below: lost", "below: ''", "the name is empty"},
      {"  wide: {strategy: call-operator}\n", "", "6:89: unknown name 'wide'"},
      {"groping-search", "grope", "allowed: groping-search, retry, call-operator"},
      {"radius: 10, ", "", "missing key 'radius'"},
      {"radius: 10", "radius: 1000", "1000 mm is out of range"},
      {"pitch: 3", "pitch: 30",
       "the pitch is greater than the radius, so that there is nothing to try; allowed: at most 10 "
       "mm"},
      {"pitch: 3", "pitch: 0", "0 mm is out of range"},
      {"strategy: retry", "strategy: retry, radius: 1", "unknown key 'radius'"},
  };
  for (const Slip& slip : slips) {
    const std::string message = MessageWith(slip.old_text, slip.new_text);
    EXPECT_THAT(message, HasSubstr(slip.message)) << slip.new_text;
    EXPECT_THAT(message, HasSubstr("cell.yaml:")) << slip.new_text;
  }
  EXPECT_EQ(MessageWith("units", "units"), "no error");
}

TEST(UncertaintyOperationsFile, AnErrorWithoutAnyRecoveryIsNamed) {
  const std::size_t end = kSections.find("recoveries:");
  EXPECT_THAT([&] { Read(kSections.substr(0, end)); },
              testing::ThrowsMessage<InputError>(HasSubstr("there is no recovery from 'lost'")));
}

}  // namespace
}  // namespace assay::domain::uncertainty_operations_file_test
