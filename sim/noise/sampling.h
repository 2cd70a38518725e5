#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "sim/noise/noise.h"

namespace assay::noise {

// The way in which trials take their noise from the error box.
enum class Mode {
  kNone,            // no errors, for comparison
  kUniform,         // each channel independently, uniform over its range
  kVertices,        // corners of the box
  kLowDiscrepancy,  // points that fill the box evenly
};
std::string_view Name(Mode mode);             // "low-discrepancy"
const std::vector<std::string>& ModeNames();  // in the order of the enumeration

// Returns the point with this number, from 1, in the sequence with this seed. The point depends on
// nothing else, so that trials can be done in any order, anywhere. The start is always possible
// (PossibleStart): uniform points with which parts would overlap at the start are drawn anew, and
// other points are moved back toward the believed poses.
Noise Sample(const domain::Problem& problem, const std::vector<Channel>& box, Mode mode,
             std::uint64_t seed, int number);

// CornerPoint and EvenPoint return the point with this number (from 1), with one value in [0, 1]
// for each dimension.
//
// The values of a corner are 0 and 1. The first points are the rows of a Hadamard matrix, each
// followed by its opposite, so that all four combinations of any two channels come equally often.
// Their number is twice the power of two above `dimensions`. Later points are random corners.
std::vector<double> CornerPoint(int dimensions, std::uint64_t seed, int number);
// Returns the number of points that are rows of the matrix and their opposites.
int CornerDesignSize(int dimensions);
// Uses an additive recurrence with powers of the generalized golden ratio, shifted by the seed.
std::vector<double> EvenPoint(int dimensions, std::uint64_t seed, int number);

}  // namespace assay::noise
