#include "sim/sense/palette.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/sim/scene/peg_and_block.h"

namespace assay::sense::palette_test {
namespace {

using scene::kBlock;
using scene::kPeg;

class PaletteTest : public testing::Test {
 protected:
  // Returns the surface in a small picture of one colour. Each channel is from 0 to 1.
  Surface SurfaceOf(double red, double green, double blue, PartId part) const {
    render::Image image{2, 2, {}};
    for (int i = 0; i < 4; ++i) {
      for (const double channel : {red, green, blue}) {
        image.rgb.push_back(static_cast<std::uint8_t>(std::lround(255 * channel)));
      }
    }
    const SurfaceMap map = palette.Segment(image, part);
    EXPECT_EQ(map.size, 2);
    for (const Surface surface : map.surfaces) EXPECT_EQ(surface, map.surfaces.front());
    return map.surfaces.front();
  }

  const domain::Problem problem = scene::PegAndBlock();
  const scene::Scene scene{problem, {}};
  const Palette palette{scene};
};

TEST_F(PaletteTest, KnowsEveryColorOfThePartInAnyLight) {
  for (const double light : {1.0, 0.6, 0.25}) {
    for (const PartId part : {kBlock, kPeg}) {
      for (const Eigen::Vector4f& c : problem.part(part).model->colors()) {
        EXPECT_EQ(SurfaceOf(light * c[0], light * c[1], light * c[2], part), Surface::kPart);
        EXPECT_EQ(
            SurfaceOf(light * c[0], light * c[1], light * c[2], part == kBlock ? kPeg : kBlock),
            Surface::kOtherPart);
      }
    }
    EXPECT_EQ(SurfaceOf(light * 0.84, light * 0.80, light * 0.73, kPeg), Surface::kTable);
  }
}

TEST_F(PaletteTest, WhatIsDarkOrOfNoKnownColorIsSomethingElse) {
  EXPECT_EQ(SurfaceOf(0.01, 0.02, 0.03, kBlock), Surface::kElse);
  EXPECT_EQ(SurfaceOf(0.1, 0.9, 0.1, kBlock), Surface::kElse);
  EXPECT_EQ(SurfaceOf(0.6, 0.62, 0.65, kBlock), Surface::kElse);  // floor and steel
}

TEST_F(PaletteTest, OutsideOfThePictureIsSomethingElse) {
  const SurfaceMap map{2, {Surface::kPart, Surface::kTable, Surface::kPart, Surface::kPart}};
  EXPECT_EQ(map.At(0.5, 0.5), Surface::kPart);
  EXPECT_EQ(map.At(1.99, 0.01), Surface::kTable);
  for (const auto& [x, y] : {std::pair{-0.01, 1.0}, {1.0, -0.01}, {2.0, 1.0}, {1.0, 2.0}}) {
    EXPECT_EQ(map.At(x, y), Surface::kElse);
  }
}

}  // namespace
}  // namespace assay::sense::palette_test
