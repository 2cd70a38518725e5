#include "sim/view/recording/series.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "tests/sim/view/recording/series_decoder.h"

namespace assay::view::series_test {
namespace {

using Values = std::vector<std::int64_t>;

void ExpectRoundTrip(const Values& values) {
  SeriesDecoder decoder(EncodedSeries(values));
  EXPECT_EQ(decoder.Next(values.size()), values);
  EXPECT_TRUE(decoder.IsAtEnd());
}

TEST(SeriesTest, EveryValueComesBack) {
  ExpectRoundTrip({});
  ExpectRoundTrip({0});
  ExpectRoundTrip({-1});
  ExpectRoundTrip({7, 7, 7, 7, -7, -7, 0, 0, 0});
  ExpectRoundTrip({1, 2, 3, 4, 5, 4, 3, 2, 1});
  ExpectRoundTrip({63, -64, 64, -65, 8191, -8192, 1'000'000'000'000, -1'000'000'000'000});
}

TEST(SeriesTest, RandomWalksComeBack) {
  std::mt19937_64 random(1);
  for (int trial = 0; trial < 200; ++trial) {
    const std::int64_t size = std::int64_t{1} << (random() % 40);
    Values values(random() % 300);
    std::int64_t value = 0;
    for (std::int64_t& next : values) {
      if (random() % 3 != 0) value += static_cast<std::int64_t>(random() % size) - size / 2;
      next = value;
    }
    ExpectRoundTrip(values);
  }
}

TEST(SeriesTest, RestAndEvenMotionTakeAFewBytes) {
  Values rest(3000, 123456);
  EXPECT_LE(EncodedSeries(rest).size(), 8u);
  Values even;
  for (int i = 0; i < 3000; ++i) even.push_back(700 * i);
  EXPECT_LE(EncodedSeries(even).size(), 8u);
}

// A hand accelerates by 2 m/s^2 and brakes again; the unit is 0.01 mm, at 50 Hz.
TEST(SeriesTest, SmoothMotionTakesLessThanTwoBytesAValue) {
  Values values;
  for (int i = 0; i < 100; ++i) {
    const double t = 0.02 * i;
    values.push_back(std::llround(1e5 * (0.5 - 0.5 * std::cos(t))));
  }
  EXPECT_LT(EncodedSeries(values).size(), 2 * values.size());
}

}  // namespace
}  // namespace assay::view::series_test
