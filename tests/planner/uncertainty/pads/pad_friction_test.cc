#include "planner/uncertainty/pads/pad_friction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "planner/base/random.h"

namespace assay::uncertainty::pad_friction_test {
namespace {

constexpr std::uint64_t kSeed = 27;

// Returns cells with a total friction of one newton. They cover a rectangle with the half widths
// `half` about `middle`.
std::vector<PadCell> Rectangle(const Vector2& half, const Vector2& middle, int per_side = 8) {
  std::vector<PadCell> cells;
  for (int i = 0; i < per_side; ++i) {
    for (int j = 0; j < per_side; ++j) {
      const Vector2 share = (2 * Vector2(i, j) + Vector2::Ones()) / per_side - Vector2::Ones();
      cells.push_back({middle + share.cwiseProduct(half), 1.0 / (per_side * per_side)});
    }
  }
  return cells;
}

// Returns a lower bound of the true ratio by the maximum principle (Goyal, Ruina and Papadopoulos
// 1991). A load is borne if and only if there is no motion in which its power exceeds the
// dissipation of friction. Only a finite number of motions is tried.
double RatioByPower(const std::vector<PadCell>& cells, const Vector2& center, const PlaneLoad& load,
                    double size) {
  constexpr int kSteps = 90;
  double greatest = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double angle = 2 * std::numbers::pi * i / kSteps;
    const Vector2 way(std::cos(angle), std::sin(angle));
    for (int k = -kSteps / 2; k <= kSteps / 2; ++k) {
      const double mix = std::numbers::pi * k / kSteps;
      const Vector2 v = std::cos(mix) * way;
      const double turn = std::sin(mix) / size;
      double dissipated = 0;
      for (const PadCell& cell : cells) {
        const Vector2 r = cell.at - center;
        dissipated += cell.friction * (v + turn * Vector2(-r.y(), r.x())).norm();
      }
      greatest = std::max(greatest, (load.force.dot(v) + load.torsion * turn) / dissipated);
    }
  }
  return greatest;
}

PlaneLoad Draw(RandomStream& random, double size) {
  const double angle = random.Uniform(-std::numbers::pi, std::numbers::pi);
  const double mix = random.Uniform(-std::numbers::pi / 2, std::numbers::pi / 2);
  return {.force = std::cos(mix) * Vector2(std::cos(angle), std::sin(angle)),
          .torsion = size * std::sin(mix)};
}

TEST(PadFriction, BearsItsFrictionAsAForceInEveryDirection) {
  const PadFriction pads(Rectangle({0.008, 0.005}, {0.001, -0.002}));
  for (const Vector2& way : {Vector2(1, 0), Vector2(0, -1), Vector2(0.6, 0.8)}) {
    EXPECT_NEAR(pads.RatioOf({.force = 0.4 * way}), 0.4, 1e-12);
  }
}

// The torsion is the mean distance from the middle times the friction. For a disc the mean distance
// is 2/3 of its radius. For a square of half width a it is (sqrt(2) + asinh(1)) / 3 * a. Cells bear
// a little less.
TEST(PadFriction, BearsTheMeanDistanceAsTorsion) {
  const double a = 0.008;
  const PadFriction pads(Rectangle({a, a}, {0, 0}));
  const double exact = (std::sqrt(2.0) + std::asinh(1.0)) / 3 * a;
  const double ratio = pads.RatioOf({.torsion = exact});
  EXPECT_GE(ratio, 1);
  EXPECT_LE(ratio, 1.01);
  EXPECT_EQ(ratio, pads.RatioOf({.torsion = -exact}));
}

// The ratio may be up to a quarter too large, because it overestimates motions off the line for
// long patches or for two different ones.
TEST(PadFriction, NeverBearsMoreThanFrictionDissipates) {
  RandomStream random(kSeed, "pad friction");
  for (int i = 0; i < 60; ++i) {
    const Vector2 half(random.Uniform(0.002, 0.01), random.Uniform(0.002, 0.01));
    const double size = half.norm() / 2;
    std::vector<PadCell> cells = Rectangle(half, {0, 0}, 6);
    // The second pad may touch with a smaller patch than the first.
    const std::vector<PadCell> other = Rectangle(half / 2, half / random.Uniform(2, 8), 6);
    if (i % 2 == 1) cells.insert(cells.end(), other.begin(), other.end());
    const PadFriction pads(cells);
    const PlaneLoad load = Draw(random, size);
    const double least = RatioByPower(cells, pads.center(), load, size);
    const double ratio = pads.RatioOf(load);
    EXPECT_GE(ratio, least - 1e-12) << "seed " << kSeed << ", case " << i;
    EXPECT_LE(ratio, 1.25 * least) << "seed " << kSeed << ", case " << i;
  }
}

TEST(PadFriction, IsANorm) {
  RandomStream random(kSeed, "norm");
  const PadFriction pads(Rectangle({0.008, 0.008}, {0, 0}));
  for (int i = 0; i < 60; ++i) {
    const PlaneLoad load = Draw(random, 0.006);
    const double ratio = pads.RatioOf(load);
    EXPECT_NEAR(pads.RatioOf({-load.force, -load.torsion}), ratio, 1e-12);
    EXPECT_NEAR(pads.RatioOf({3 * load.force, 3 * load.torsion}), 3 * ratio, 1e-12);
  }
}

TEST(PadFriction, WithoutFrictionNothingIsBorne) {
  EXPECT_TRUE(std::isinf(PadFriction({}).RatioOf({.force = {1, 0}})));
}

}  // namespace
}  // namespace assay::uncertainty::pad_friction_test
