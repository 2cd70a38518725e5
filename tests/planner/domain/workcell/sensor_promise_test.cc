#include "planner/domain/workcell/sensor_promise.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "planner/base/input_files/input_error.h"
#include "planner/base/random.h"
#include "planner/domain/workcell/uncertainty_operations_file.h"

namespace assay::domain::sensor_promise_test {
namespace {

using testing::HasSubstr;

constexpr double kInch = 0.0254;
constexpr double kDegree = 0.017453292519943295;

// A workcell file with comments and a layout that no writer of YAML would keep.
std::string Workcell(const std::string& error) {
  return "format: assay-workcell/1\n"
         "units: {length:   inch, angle: degree}   # as on the drawing\n"
         "\n"
         "sensors:\n"
         "  side-camera: {error: {z: 0.5}}\n"
         "  overhead-camera:   # above\n"
         "    error:  " +
         error +
         "\n"
         "    description: looks down\n"
         "recoveries: {}\n";
}

const SensorPromise kPromise = {
    .x = 0.0123 * kInch, .y = 0.02 * kInch, .z = 3 * kInch, .theta = 0.05101 * kDegree};
const std::string kWritten = "{x: 0.013, y: 0.020, z: 3.0, theta: 0.052}";

std::string Written(const std::string& text) {
  return WithPromise(text, "cell.yaml", "overhead-camera", kPromise, "10 placements");
}

SensorModel CameraOf(const std::string& text) {
  const Document document = Document::Parse(text, "cell.yaml");
  return *ReadUncertaintyOperations(document.root(), ReadUnits(document.root()))
              .FindSensor("overhead-camera");
}

TEST(SensorPromise, TakesThePlaceOfTheOldOneAndOfNothingElse) {
  EXPECT_EQ(Written(Workcell("{x: 0.3, y: 0.3}")),
            Workcell(kWritten + "  # calibrated: 10 placements"));
}

TEST(SensorPromise, TheCommentIsThatOfTheLastCalibration) {
  const std::string others = "  # do not touch";
  const std::string once = Written(Workcell("{x: 0.3}" + others));
  EXPECT_EQ(once, Workcell(kWritten + "  # calibrated: 10 placements" + others));
  EXPECT_EQ(Written(once), once);
  EXPECT_EQ(WithPromise(once, "cell.yaml", "overhead-camera", kPromise, "20 placements"),
            Workcell(kWritten + "  # calibrated: 20 placements" + others));
}

// A comment in a YAML file goes to the end of the line. Inside a map that is written on one line,
// it would also comment out the closing braces.
TEST(SensorPromise, HasNoCommentWithinALine) {
  const std::string text =
      "format: assay-workcell/1\n"
      "units: {length: inch, angle: degree}\n"
      "sensors: {overhead-camera: {error: {x: [-1, 2]}, description: looks down}}";
  std::string expected = text;
  expected.replace(expected.find("{x: [-1, 2]}"), 12, kWritten);
  EXPECT_EQ(Written(text), expected);
}

// Law: the promise that is read back is at least the given one, and at most a tenth more.
TEST(SensorPromise, IsReadBackRoundedUp) {
  RandomStream random(3, "promises");
  const auto draw = [&] { return std::pow(10, random.Uniform(-7, -1)); };
  for (int i = 0; i < 1000; ++i) {
    const SensorPromise promise = {.x = draw(), .y = draw(), .z = draw(), .theta = draw()};
    const SensorModel read = CameraOf(
        WithPromise(Workcell("{x: 1}"), "cell.yaml", "overhead-camera", promise, "a note"));
    for (const auto& [given, interval] : {std::pair(promise.x, read.x),
                                          {promise.y, read.y},
                                          {promise.z, read.z},
                                          {promise.theta, read.theta}}) {
      EXPECT_EQ(interval.low, -interval.high);
      EXPECT_GE(interval.high, given * (1 - 1e-9));
      EXPECT_LE(interval.high, given * 1.1 * (1 + 1e-9));
    }
  }
}

TEST(SensorPromise, WhatCannotBeReplacedIsToldWithItsPlace) {
  const auto message = [](const std::string& text) -> std::string {
    try {
      Written(text);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_THAT(message(Workcell("{x: 1,\n             y: 2}")),
              HasSubstr("cell.yaml:7:13: the promise is not written on one line"));
  EXPECT_THAT(message(Workcell("{x: 1, # a brace }\n             y: 2}")),
              HasSubstr("cell.yaml:7:13: the promise is not written on one line"));
  EXPECT_THAT(message(Workcell("\n      x: 1")), HasSubstr("is not written on one line"));
  EXPECT_THAT(message("format: assay-workcell/1\nsensors: {other: {error: {x: 1}}}\n"),
              HasSubstr("missing key 'overhead-camera'"));
}

}  // namespace
}  // namespace assay::domain::sensor_promise_test
