#include "planner/domain/problem/pose_error_file.h"

#include <fmt/format.h>

#include <numbers>

namespace assay::domain {
namespace {

constexpr Range kLengthErrors = {-1, 1};  // metres
constexpr Range kAngleErrors = {-std::numbers::pi, std::numbers::pi};

Interval ReadInterval(const Value& value, const Unit& unit, const Range& range) {
  if (!value.IsList()) {
    const double half_width = ReadWithin(value, unit, range);
    if (half_width < 0) {
      value.Fail(fmt::format("the half-width {} is negative", Beside(value.Text(), unit)),
                 InUnit(kAtLeastZero, unit));
    }
    return {-half_width, half_width};
  }
  const std::vector<Value> ends = value.Items();
  if (ends.size() != 2) {
    value.Fail(fmt::format("a list of length {}", ends.size()), "a half-width or [low, high]");
  }
  const Interval interval = {ReadWithin(ends[0], unit, range), ReadWithin(ends[1], unit, range)};
  if (interval.low > interval.high) {
    value.Fail(fmt::format("the lower end {} is greater than the upper end {}",
                           Beside(ends[0].Text(), unit), Beside(ends[1].Text(), unit)),
               "[low, high]");
  }
  if (interval.low > 0 || interval.high < 0) {
    value.Fail(fmt::format("the interval from {} to {} does not contain 0",
                           Beside(ends[0].Text(), unit), Beside(ends[1].Text(), unit)),
               "an interval that contains 0; move the pose instead");
  }
  return interval;
}

}  // namespace

PoseError ReadPoseError(const Value& map, const Units& units, const PoseError& otherwise) {
  map.AllowOnly({"x", "y", "z", "theta"});
  PoseError error = otherwise;
  if (const auto x = map.Find("x")) error.x = ReadInterval(*x, units.length, kLengthErrors);
  if (const auto y = map.Find("y")) error.y = ReadInterval(*y, units.length, kLengthErrors);
  if (const auto z = map.Find("z")) error.z = ReadInterval(*z, units.length, kLengthErrors);
  if (const auto theta = map.Find("theta")) {
    error.theta = ReadInterval(*theta, units.angle, kAngleErrors);
  }
  return error;
}

}  // namespace assay::domain
