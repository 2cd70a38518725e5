#include "sim/render/image.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "planner/base/random.h"
#include "sim/render/picture.h"
#include "sim/render/picture_library.h"

namespace assay::render::image_test {
namespace {

Image Noise(int width, int height) {
  Image image{width, height, {}};
  RandomStream random(3, "noise");
  for (int i = 0; i < 3 * width * height; ++i) {
    image.rgb.push_back(static_cast<std::uint8_t>(random.Index(256)));
  }
  return image;
}

Image Plain(int width, int height, std::uint8_t value) {
  return {width, height, std::vector<std::uint8_t>(std::size_t{3} * width * height, value)};
}

std::optional<Image> Decoded(const std::string& png) {
  return Pictures().Decode(std::vector<std::uint8_t>(png.begin(), png.end()));
}

TEST(EncodedPng, KeepsEveryPixel) {
  for (const auto& [width, height] : {std::pair{1, 1}, {7, 5}, {64, 33}}) {
    const Image image = Noise(width, height);
    EXPECT_TRUE(Decoded(EncodedPng(image)) == image);
  }
}

TEST(Decode, RefusesWhatIsNoPicture) {
  EXPECT_EQ(Decoded("no picture"), std::nullopt);
  EXPECT_EQ(Decoded(""), std::nullopt);
}

TEST(ContactSheet, IsNoWiderThanItMayBe) {
  const std::vector<CaptionedImage> images(6, {"step", Plain(960, 720, 120)});
  const Image sheet = ContactSheet(images, 6);
  EXPECT_LT(sheet.width, 2600);
  EXPECT_GT(sheet.width, 2300);
  EXPECT_EQ(ContactSheet(images, 1).width, ContactSheet({images[0]}, 1).width);
  EXPECT_GT(ContactSheet(images, 1).width, 960);
}

// The columns and rows of the smallest rectangle that holds all different pixels.
struct Changed {
  int left = 1 << 20, right = -1, top = 1 << 20, bottom = -1;
};
Changed Difference(const Image& a, const Image& b) {
  Changed changed;
  for (int i = 0; i < a.width * a.height; ++i) {
    const auto at = static_cast<std::size_t>(3 * i);
    if (std::equal(&a.rgb[at], &a.rgb[at] + 3, &b.rgb[at])) continue;
    changed.left = std::min(changed.left, i % a.width);
    changed.right = std::max(changed.right, i % a.width);
    changed.top = std::min(changed.top, i / a.width);
    changed.bottom = std::max(changed.bottom, i / a.width);
  }
  return changed;
}

// A label begins at its point. If two labels have the same point, the second one is below the first
// and changes nothing within the first one's box.
TEST(WithLabels, NoneIsOnAnother) {
  const Image plain = Plain(640, 480, 90);
  constexpr Colour kRed{"#ff0000"};
  for (const auto& [x, y] : {std::pair(100.0, 200.0), {600.0, 100.0}, {320.0, 240.0}}) {
    const Label first{"edge 21 on edge 14", x, y, kRed};
    const Label second{"vertex 3 on face 8", x, y, kRed};
    const Image one = WithLabels(plain, {first});
    const Changed box = Difference(plain, one);
    EXPECT_GE(box.right - box.left, 100);
    EXPECT_LE(box.left, x + 1);
    EXPECT_GE(box.right, x - 1);
    const Image both = WithLabels(plain, {first, second});
    const Changed below = Difference(one, both);
    EXPECT_GT(below.bottom, box.bottom + 5) << x;
    int within = 0;  // changed pixels, except near the line from the point
    for (int row = box.top; row <= box.bottom; ++row) {
      for (int column = box.left; column <= box.right; ++column) {
        if (std::abs(column - x) <= 15) continue;
        const auto at = static_cast<std::size_t>(3 * (row * plain.width + column));
        within += std::equal(&one.rgb[at], &one.rgb[at] + 3, &both.rgb[at]) ? 0 : 1;
      }
    }
    EXPECT_LE(within, 2 * (box.right - box.left)) << "more than a border";
  }
  EXPECT_TRUE(WithLabels(plain, {}) == plain);
}

TEST(ContactSheet, PutsImagesInRows) {
  std::vector<CaptionedImage> images;
  for (int i = 0; i < 5; ++i) {
    images.push_back({"step", Plain(80, 60, static_cast<std::uint8_t>(40 * i))});
  }
  const Image sheet = ContactSheet(images, 3);
  EXPECT_GT(sheet.width, 3 * 80);
  EXPECT_LT(sheet.width, 4 * 80);
  EXPECT_GT(sheet.height, 2 * 60);
  EXPECT_LT(sheet.height, 3 * 60);
  // The fourth image begins the second row.
  const int x = (sheet.width - 3 * 80) / 4 + 40;
  const int y = sheet.height * 3 / 4 - 15;
  EXPECT_EQ(sheet.rgb[3 * (std::size_t(y) * sheet.width + x)], 120);
}

TEST(ContactSheet, HasNoEmptyColumns) {
  const std::vector<CaptionedImage> two(2, {"step", Plain(50, 50, 9)});
  EXPECT_EQ(ContactSheet(two, 8), ContactSheet(two, 2));
}

TEST(ContactSheet, CutsCaptionsThatAreTooLong) {
  const std::vector<CaptionedImage> short_one = {{"a", Plain(120, 50, 9)}};
  const std::vector<CaptionedImage> long_one = {{std::string(500, 'a'), Plain(120, 50, 9)}};
  const Image sheet = ContactSheet(long_one, 1);
  EXPECT_EQ(sheet.width, ContactSheet(short_one, 1).width);
  for (int y = 0; y < sheet.height; ++y) {  // the right margin stays white
    EXPECT_EQ(sheet.rgb[3 * (std::size_t(y) * sheet.width + sheet.width - 2)], 255);
  }
}

TEST(ContactSheet, ShowsTheLegendBelowAll) {
  const std::vector<CaptionedImage> images(3, {"step", Plain(240, 60, 9)});
  const Image without = ContactSheet(images, 2);
  const Image with = ContactSheet(images, 2, {{kPredicted, "ghosts"}});
  ASSERT_EQ(with.width, without.width);
  ASSERT_GT(with.height, without.height);
  const auto has_colour = [&](int first_row, int last_row) {
    const auto [red, green, blue] = kPredicted.Rgb();
    for (int i = first_row * with.width; i < last_row * with.width; ++i) {
      const std::uint8_t* pixel = &with.rgb[std::size_t{3} * i];
      if (pixel[0] == red && pixel[1] == green && pixel[2] == blue) return true;
    }
    return false;
  };
  EXPECT_TRUE(has_colour(without.height - 12, with.height));
  EXPECT_FALSE(has_colour(0, without.height - 12));
}

}  // namespace
}  // namespace assay::render::image_test
