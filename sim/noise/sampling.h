#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "sim/noise/noise.h"

namespace assay::noise {

// How trials take their noise from the error box.
enum class Mode {
  kNone,            // no errors: the control arm
  kUniform,         // each channel by itself, uniform over its range
  kVertices,        // corners of the box
  kLowDiscrepancy,  // points that fill the box evenly
};
std::string_view Name(Mode mode);             // "low-discrepancy"
const std::vector<std::string>& ModeNames();  // in the order of the enumeration

// The point with this number, from 1, of the sequence with this seed. It depends on nothing else:
// trials can be done in any order, anywhere.
Noise Sample(const std::vector<Channel>& box, Mode mode, std::uint64_t seed, int number);

// Values in [0, 1), one for each dimension, of the point with this number (from 1).
//
// Corners: entries 0 and 1. The first points, twice as many as the power of two above `dimensions`,
// are the rows of a Hadamard matrix, each followed by its opposite: for any two channels all four
// combinations come equally often; then random ones.
std::vector<double> CornerPoint(int dimensions, std::uint64_t seed, int number);
// How many are such rows and their opposites.
int CornerDesignSize(int dimensions);
// An additive recurrence with powers of the generalized golden ratio, shifted by the seed.
std::vector<double> EvenPoint(int dimensions, std::uint64_t seed, int number);

}  // namespace assay::noise
