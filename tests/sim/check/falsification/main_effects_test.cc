#include "sim/check/falsification/main_effects.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "planner/base/random.h"
#include "sim/noise/sampling.h"

namespace assay::check::main_effects_test {
namespace {

using Corner = std::vector<double>;

// An observation that is linear in the errors, with an offset for each start.
struct Observation {
  std::vector<double> slopes;
  std::vector<double> offsets;

  double At(const Corner& corner, std::size_t start) const {
    double value = offsets[start];
    for (std::size_t i = 0; i < slopes.size(); ++i) value += slopes[i] * corner[i];
    return value;
  }
};

double Least(const Observation& observation, double sign) {
  double sum = 0;
  for (const double slope : observation.slopes) sum += std::min(0.0, sign * slope);
  double start = sign * observation.offsets.front();
  for (const double offset : observation.offsets) start = std::min(start, sign * offset);
  return sign * (sum + start);
}

LikelyExtremes Of(const Observation& observation, int corners) {
  const auto errors = static_cast<int>(observation.slopes.size());
  std::vector<Corner> design;
  for (int n = 1; n <= corners; ++n) design.push_back(noise::CornerPoint(errors, 1, n));
  std::vector<CornerResponse> responses;
  for (std::size_t n = 0; n < design.size(); ++n) {
    // Each corner and its opposite come after the same start.
    const std::size_t start = n / 2 % observation.offsets.size();
    responses.push_back({&design[n], start, observation.At(design[n], start)});
  }
  return ByMainEffects(responses);
}

// Over a whole orthogonal array, the main effects of a linear observation are exactly its slopes.
// The extremes found are therefore those over all corners.
TEST(MainEffects, OfALinearObservationFindTheExtremesOfAllCorners) {
  RandomStream random(3, "slopes");
  for (int instance = 0; instance < 100; ++instance) {
    Observation observation{.slopes = {}, .offsets = {0.5}};
    for (int i = 0; i < 7; ++i) observation.slopes.push_back(random.Uniform(-1, 1));
    const LikelyExtremes extremes = Of(observation, 16);
    EXPECT_NEAR(extremes.least.expected, Least(observation, 1), 1e-9);
    EXPECT_NEAR(extremes.greatest.expected, Least(observation, -1), 1e-9);
    EXPECT_NEAR(observation.At(extremes.least.corner, 0), Least(observation, 1), 2e-3);
    EXPECT_NEAR(observation.At(extremes.greatest.corner, 0), Least(observation, -1), 2e-3);
  }
}

TEST(MainEffects, TellStartsApart) {
  const Observation observation{.slopes = {1, -2, 0.5}, .offsets = {0, 5, -7, 1}};
  const LikelyExtremes extremes = Of(observation, 8);
  EXPECT_EQ(extremes.least.start, 2u);
  EXPECT_EQ(extremes.least.corner, (Corner{0, 1, 0}));
  EXPECT_EQ(extremes.greatest.start, 1u);
  EXPECT_EQ(extremes.greatest.corner, (Corner{1, 0, 1}));
}

TEST(MainEffects, OfOneCornerAreNone) {
  const Corner corner = {1, 0};
  const std::vector<CornerResponse> one = {{&corner, 0, 3}};
  EXPECT_EQ(ByMainEffects(one).least.expected, 3);
  EXPECT_EQ(ByMainEffects(one).greatest.expected, 3);
}

}  // namespace
}  // namespace assay::check::main_effects_test
