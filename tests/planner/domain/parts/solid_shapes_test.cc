#include "planner/domain/parts/solids/solid_shapes.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/base/random.h"
#include "planner/geometry/hull.h"
#include "planner/geometry/solids/mass_properties.h"
#include "tests/planner/domain/parts.h"

namespace assay::domain::solid_shapes_test {
namespace {

using geometry::Vector3;
using testing::HasSubstr;

constexpr std::uint64_t kSeed = 19;
constexpr double kPi = std::numbers::pi;
const Units kUnits = {kMillimetres, kDegrees};

SolidShape Shape(const std::string& text, Roundness roundness = Roundness::kAround,
                 const Widening& widening = {}) {
  return ReadShape(Document::Parse(text, "part.yaml").root(), kUnits, roundness, widening);
}

double VolumeOf(const SolidShape& shape) {
  double volume = 0;
  for (const geometry::ConvexHull& piece : shape.pieces) volume += geometry::Volume(piece);
  return volume * 1e9;  // cubic millimetres
}

bool IsIn(const SolidShape& shape, const Vector3& p) {
  return std::ranges::any_of(shape.pieces,
                             [&](const auto& piece) { return Contains(piece, p, 1e-12); });
}

TEST(SolidShapes, VolumesHaveTheirClosedForms) {
  EXPECT_NEAR(VolumeOf(Shape("box: [[0, 0, 0], [1, 2, 3]]")), 6, 1e-9);
  EXPECT_NEAR(VolumeOf(Shape("hull: [[0, 0, 0], [6, 0, 0], [0, 6, 0], [0, 0, 6]]")), 36, 1e-9);
  const std::string square = "outline: [[0, 0], [4, 0], [4, 4], [0, 4]]";
  EXPECT_NEAR(VolumeOf(Shape("prism: {" + square + ", from: 0, to: 2}")), 32, 1e-9);
  EXPECT_NEAR(VolumeOf(Shape("prism: {" + square +
                             ", holes: [[[1, 1], [1, 2], [3, 2], [3, 1]]], from: 0, to: 2}")),
              28, 1e-9);
  const std::string el = "outline: [[0, 0], [4, 0], [4, 1], [1, 1], [1, 4], [0, 4]]";
  EXPECT_NEAR(VolumeOf(Shape("prism: {" + el + ", from: -1, to: 1}")), 14, 1e-9);
  for (const int sides : {4, 8, 32, 128}) {
    const double around = sides * std::tan(kPi / sides);
    const std::string count = fmt::format("sides: {}", sides);
    const std::string axle = "from: [1, 2, 3], to: [1, 2, 13], " + count;
    EXPECT_NEAR(VolumeOf(Shape("cylinder: {" + axle + ", radius: 2}")), around * 4 * 10, 1e-6);
    EXPECT_NEAR(VolumeOf(Shape("cone: {" + axle + ", radii: [2, 1]}")),
                around * 10 * (4 + 2 + 1) / 3, 1e-6);
    EXPECT_NEAR(VolumeOf(Shape("cone: {" + axle + ", radii: [0, 3]}")), around * 10 * 9 / 3, 1e-6);
    EXPECT_NEAR(
        VolumeOf(Shape("prism: {regular: {" + count + ", across_flats: 4}, from: 0, to: 10}")),
        around * 4 * 10, 1e-6);
  }
}

// A solid contains the circle, and the circle contains a pocket.
TEST(SolidShapes, RoundSolidsAreAroundTheCircleAndRoundPocketsWithinIt) {
  RandomStream random(kSeed, "round");
  for (const int sides : {4, 12, 64}) {
    const std::string text =
        fmt::format("cylinder: {{from: [10, 0, 0], to: [30, 15, 5], radius: 7, sides: {}}}", sides);
    const SolidShape around = Shape(text, Roundness::kAround);
    const SolidShape within = Shape(text, Roundness::kWithin);
    const Vector3 from(0.01, 0, 0);
    const Vector3 to(0.03, 0.015, 0.005);
    const Vector3 axis = (to - from).normalized();
    for (int i = 0; i < 2000; ++i) {
      const Vector3 across =
          Vector3(random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 1));
      const Vector3 radial = (across - axis.dot(across) * axis).normalized();
      const double radius = random.Uniform(0, 0.011);
      const Vector3 p = from + random.Uniform(0.01, 0.99) * (to - from) + radius * radial;
      if (radius < 0.007) {
        EXPECT_TRUE(IsIn(around, p)) << "seed " << kSeed;
      }
      if (radius > 0.007 / std::cos(kPi / sides) + 1e-9) {
        EXPECT_FALSE(IsIn(around, p));
      }
      if (radius > 0.007) {
        EXPECT_FALSE(IsIn(within, p)) << "seed " << kSeed;
      }
      if (radius < 0.007 * std::cos(kPi / sides) - 1e-9) {
        EXPECT_TRUE(IsIn(within, p));
      }
    }
  }
}

TEST(SolidShapes, APrismLiesAlongItsAxis) {
  for (int axis = 0; axis < 3; ++axis) {
    const SolidShape prism = Shape(fmt::format(
        "prism: {{outline: [[0, 0], [2, 0], [2, 3], [0, 3]], axis: {}, from: 5, to: 6}}",
        "xyz"[axis]));
    Vector3 low = Vector3::Zero();
    Vector3 high;
    high[(axis + 1) % 3] = 0.002;
    high[(axis + 2) % 3] = 0.003;
    low[axis] = 0.005;
    high[axis] = 0.006;
    Eigen::AlignedBox3d bounds;
    for (const Vector3& vertex : prism.pieces.front().vertices) bounds.extend(vertex);
    EXPECT_LT((bounds.min() - low).norm() + (bounds.max() - high).norm(), 1e-15) << axis;
  }
}

// Every wall that lies along the axis is set back by the clearance, and the ends stay.
TEST(SolidShapes, WideningMovesTheSidesAcrossTheAxis) {
  const Widening widening = {.across = true, .by = 0.0005};
  for (const std::string text :
       {"prism: {outline: [[0, 0], [9, 0], [6, 7]], from: 0, to: 4}",
        "prism: {regular: {sides: 8, across_flats: 10, center: [1, 2]}, axis: y, from: 0, to: 4}",
        "cylinder: {from: [0, 0, 0], to: [0, 0, 4], radius: 5, sides: 16}"}) {
    const SolidShape narrow = Shape(text, Roundness::kAround);
    const SolidShape wide = Shape(text, Roundness::kAround, widening);
    ASSERT_EQ(wide.pieces.size(), 1u);
    EXPECT_EQ(wide.moved_sides.size() + 2, wide.pieces.front().facets.size()) << text;
    for (const geometry::Facet& facet : wide.pieces.front().facets) {
      const auto same = std::ranges::find_if(narrow.pieces.front().facets, [&](const auto& other) {
        return (other.normal - facet.normal).norm() < 1e-9;
      });
      ASSERT_NE(same, narrow.pieces.front().facets.end());
      const bool moves = std::ranges::any_of(wide.moved_sides, [&](const Vector3& normal) {
        return (normal - facet.normal).norm() < 1e-9;
      });
      EXPECT_NEAR(facet.offset - same->offset, moves ? 0.0005 : 0, 1e-9) << text;
    }
  }
}

TEST(SolidShapes, EachSlipIsNamed) {
  const auto error_of = [](const std::string& text, const Widening& widening) -> std::string {
    try {
      Shape(text, Roundness::kWithin, widening);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  };
  struct Slip {
    const char* text;
    const char* message;
  };
  for (const Slip& slip : std::vector<Slip>{
           {"ball: 3", "no shape"},
           {"{box: [[0, 0, 0], [1, 1, 1]], hull: []}", "both a box and a hull"},
           {"cylinder: {from: [0, 0, 0], to: [0, 0, 0], radius: 1}", "only 0 mm long"},
           {"cylinder: {from: [0, 0, 0], to: [0, 0, 1], radius: 0}", "out of range"},
           {"cylinder: {from: [0, 0, 0], to: [0, 0, 1], radius: 1, sides: 6}", "no multiple of 4"},
           {"cylinder: {from: [0, 0, 0], to: [0, 0, 1], radius: 1, sides: 1000}", "256"},
           {"cylinder: {from: [0, 0, 0], to: [0, 0, 1], diameter: 1}", "allowed: from, to, radius"},
           {"cone: {from: [0, 0, 0], to: [0, 0, 1], radii: [0, 0]}", "both ends"},
           {"cone: {from: [0, 0, 0], to: [0, 0, 1], radii: [1]}", "two radii, not 1"},
           {"hull: [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]]", "in one plane"},
           {"prism: {outline: [[0, 0], [1, 1], [1, 0], [0, 1]], from: 0, to: 1}", "sides meet"},
           {"prism: {outline: [[0, 0], [1, 0], [1, 1]], from: 1, to: 0}", "long"},
           {"prism: {outline: [[0, 0], [9, 0], [9, 9]], holes: [[[0, 0], [1, 0], [1, 1]]], from: "
            "0, to: 1}",
            "not inside"},
           {"prism: {outline: [[0, 0], [9, 0], [9, 9], [0, 9]], holes: [[[1, 1], [3, 1], [2, 3]], "
            "[[2, 2], [4, 2], [3, 4]]], from: 0, to: 1}",
            "meets another"}}) {
    EXPECT_THAT(error_of(slip.text, {}), HasSubstr(slip.message)) << slip.text;
  }
  const Widening closing = {.across = true, .by = -0.002};
  EXPECT_THAT(error_of("{cylinder: {from: [0, 0, 0], to: [0, 0, 1], radius: 2}}", closing),
              HasSubstr("closes the pocket"));
  EXPECT_THAT(
      error_of("{prism: {outline: [[0, 0], [3, 0], [3, 3], [0, 3]], from: 0, to: 1}}", closing),
      HasSubstr("closes the pocket"));
}

}  // namespace
}  // namespace assay::domain::solid_shapes_test
