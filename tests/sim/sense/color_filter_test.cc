#include "sim/sense/color_filter.h"

#include <gtest/gtest.h>

#include <cmath>

#include "planner/base/random.h"

namespace assay::sense::color_filter_test {
namespace {

const Color kGreen(0.16, 0.45, 0.22);
const Color kPale(0.65, 0.82, 0.95);

bool Passes(const ColorFilter& filter, const Color& color) {
  render::Image image{1, 1, {}};
  for (const double channel : color) {
    image.rgb.push_back(
        static_cast<std::uint8_t>(std::lround(255 * std::clamp(channel, 0.0, 1.0))));
  }
  return filter.Pass(image).front() != 0;
}

// Law: hue and saturation do not change if all channels are multiplied by the same factor.
TEST(ColorFilter, BrightnessDoesNotMatter) {
  for (const Color& color : {kGreen, kPale}) {
    for (const double light : {0.3, 0.6, 1.0}) {
      EXPECT_TRUE(Passes(ColorFilter(color), light * color)) << light;
    }
  }
}

TEST(ColorFilter, OtherHuesGreyAndDarkDoNotPass) {
  const ColorFilter green(kGreen);
  EXPECT_FALSE(Passes(green, kPale));
  EXPECT_FALSE(Passes(green, {0.45, 0.16, 0.22}));
  EXPECT_FALSE(Passes(green, {0.45, 0.45, 0.45}));
  EXPECT_FALSE(Passes(green, 0.15 * kGreen));
  EXPECT_FALSE(Passes(ColorFilter(kPale), kGreen));
}

// The hues of two reds are 350 and 10 degrees.
TEST(ColorFilter, HueIsACircle) {
  const ColorFilter red(Color(0.8, 0.1, 0.12));
  EXPECT_TRUE(Passes(red, {0.8, 0.12, 0.1}));
  EXPECT_TRUE(red.Overlaps(ColorFilter(Color(0.8, 0.12, 0.1))));
}

// Law: if a colour passes two filters, the filters overlap.
TEST(ColorFilter, WhatPassesTwoFiltersOverlaps) {
  RandomStream random(5, "colors");
  const auto draw = [&] {
    return Color(random.Uniform(0, 1), random.Uniform(0, 1), random.Uniform(0, 1));
  };
  for (int i = 0; i < 300; ++i) {
    const ColorFilter a(draw());
    const ColorFilter b(draw());
    for (int k = 0; k < 20; ++k) {
      const Color pixel = draw();
      if (Passes(a, pixel) && Passes(b, pixel)) {
        EXPECT_TRUE(a.Overlaps(b)) << pixel.transpose();
      }
    }
  }
}

TEST(ColorFilter, GreyHasNoHue) {
  EXPECT_TRUE(ColorFilter(kGreen).HasHue());
  EXPECT_TRUE(ColorFilter(kPale).HasHue());
  EXPECT_FALSE(ColorFilter(Color(0.8, 0.8, 0.85)).HasHue());
}

}  // namespace
}  // namespace assay::sense::color_filter_test
