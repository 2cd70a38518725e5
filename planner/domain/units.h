#pragma once

#include "planner/base/document.h"
#include "planner/geometry/pose.h"

namespace assay::domain {

// Units of a file's lengths and angles: how many metres, how many radians is one of them.
struct Units {
  double length = 1;
  double angle = 1;
};

// Reads `units: {length: inch | mm | cm | m, angle: degree | radian}`; SI where it is left out.
Units ReadUnits(const Value& root);

// A range of allowed values, in metres, radians or whatever the value is measured in.
struct Range {
  double low = 0;
  double high = 0;
};

// The number times `unit`; an InputError unless it lies in the range, which the message tells in
// the file's own unit.
double ReadWithin(const Value& value, double unit, const Range& range);

// A length in metres, at most 100 m either way: what is longer is a slip, and would overflow later.
double ReadLength(const Value& value, const Units& units);
// An angle in radians, at most two turns either way.
double ReadAngle(const Value& value, const Units& units);

// A list of two or of three lengths, in metres.
geometry::Vector2 ReadVector2(const Value& value, const Units& units);
geometry::Vector3 ReadVector3(const Value& value, const Units& units);

// `[[x axis], [y axis], [z axis], [position]]`, as Spar's tm lists the columns of a transform. The
// axes must be orthonormal to 1e-6 and right-handed.
geometry::Pose ReadColumns(const Value& value, const Units& units);

}  // namespace assay::domain
