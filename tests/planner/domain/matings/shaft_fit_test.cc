#include "planner/domain/matings/shaft_fit.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "planner/base/random.h"
#include "planner/domain/problem/problem_file.h"
#include "planner/geometry/collision.h"
#include "planner/geometry/pose.h"
#include "tests/planner/domain/parts.h"

namespace assay::domain::shaft_fit_test {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

Problem Load(const std::string& scenario) {
  const std::string root = ASSAY_SOURCE_DIR;
  return ReadProblem(Document::Load(root + "/scenarios/" + scenario + ".yaml"), root + "/models");
}

// Returns whether the held part collides with the fixed one after a move from its seat.
bool IsStopped(const Problem& problem, const Mating& mating, const Vector3& moved) {
  return Overlaps(problem.part(mating.held).model->shape(),
                  geometry::Translation(moved) * mating.X_FixedHeld,
                  problem.part(mating.fixed).model->shape(), Pose::Identity(), 0);
}

// The oracle uses only the solids of the parts, and no features and walls.
TEST(ShaftFit, GapsAreHowFarTheSeatedPartCanMove) {
  for (const char* scenario :
       {"spar-fig15", "two-pegs", "keyed", "uncertain-sensing", "uncertain-squeezing",
        "mate-octagonal", "mate-stepped", "mate-t-slot", "round-peg"}) {
    const Problem problem = Load(scenario);
    for (const Mating& mating : problem.matings) {
      const std::vector<FitGap> gaps = GapsOf(problem, mating);
      ASSERT_GE(gaps.size(), 2u) << scenario;
      for (const auto& [across, low, high] : gaps) {
        EXPECT_NEAR(across.dot(mating.mating_vector), 0, 1e-9) << scenario;
        EXPECT_FALSE(IsStopped(problem, mating, (high - 1e-6) * across)) << scenario;
        EXPECT_TRUE(IsStopped(problem, mating, (high + 1e-6) * across)) << scenario;
        EXPECT_FALSE(IsStopped(problem, mating, (low - 1e-6) * -across)) << scenario;
        EXPECT_TRUE(IsStopped(problem, mating, (low + 1e-6) * -across)) << scenario;
      }
    }
  }
}

// If the circle of a round shaft is inside the walls, the shaft is inside the walls however it is
// turned.
TEST(ShaftFit, WhatHoldsOfTheCircleHoldsForEveryTurn) {
  const Problem problem = Load("round-peg");
  const Mating& mating = problem.matings.front();
  const std::vector<ShaftFit> fits = FitsOf(problem, mating);
  ASSERT_EQ(fits.size(), 1u);
  const ShaftFit& fit = fits.front();
  const std::optional<double> radius = RadiusOfRound(CrossSection(fit));
  ASSERT_TRUE(radius.has_value());
  EXPECT_NEAR(*radius, 0.75 * kInch / std::cos(M_PI / 64), 1e-9);
  RandomStream random(5, "round fit");
  int inside = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vector3 shift(0, random.Uniform(-5e-4, 5e-4), random.Uniform(-5e-4, 5e-4));
    const Pose X_FixedHeld = geometry::Translation(shift) * mating.X_FixedHeld *
                             geometry::RotationX(random.Uniform(-M_PI, M_PI));
    const Vector3 center = X_FixedHeld * fit.shaft.X_PartFeature.translation();
    const bool fits_circle = std::ranges::all_of(SideWalls(fit, 0), [&](const SideWall& wall) {
      return wall.normal.dot(center) > wall.offset + *radius;
    });
    if (!fits_circle) continue;
    ++inside;
    EXPECT_TRUE(FitsInside(fits, X_FixedHeld)) << "seed 5, draw " << i;
    EXPECT_FALSE(Overlaps(problem.part(mating.held).model->shape(), X_FixedHeld,
                          problem.part(mating.fixed).model->shape(), Pose::Identity(), 1e-6))
        << "seed 5, draw " << i;
  }
  EXPECT_GT(inside, 500);
}

TEST(ShaftFit, OffTheMiddleOneGapIsWiderByAsMuchAsTheOtherIsNarrower) {
  for (const char* scenario : {"spar-fig15", "uncertain-sensing"}) {
    const Problem problem = Load(scenario);
    Mating mating = problem.matings.front();
    const std::vector<FitGap> centred = GapsOf(problem, mating);
    const Vector3 off(1e-4, 2e-4, -1e-4);
    mating.X_FixedHeld.translation() += off;
    const std::vector<FitGap> moved = GapsOf(problem, mating);
    ASSERT_EQ(moved.size(), centred.size());
    for (std::size_t i = 0; i < moved.size(); ++i) {
      const double along = off.dot(moved[i].across);
      EXPECT_NEAR(moved[i].low - centred[i].low, along, 1e-12) << scenario;
      EXPECT_NEAR(moved[i].high - centred[i].high, -along, 1e-12) << scenario;
    }
  }
}

// A nut. Its body is a hexagonal prism of three boxes, one for each pair of sides. Its hole is the
// intersection of three pockets.
const char* const kNut = R"(format: assay-part/1
name: nut
initial: NU
units: {length: mm, angle: degree}
density: 1000
friction: 0.3
solids:
  across: {box: [[-30, -30, 0], [30, 30, 40]]}
  left: {box: [[-22, -9, 10], [22, 9, 40]], turn: {axis: [0, 0, 1], angle: 60}}
  right: {box: [[-22, -9, 10], [22, 9, 40]], turn: {axis: [0, 0, 1], angle: 120}}
pockets:
  hole: {cut_from: across, box: [[-12, -13.8564065, 10], [12, 13.8564065, 40]], widen: [x, y]}
  hole-left: {cut_from: left, box: [[-12, -14, 10], [12, 14, 40]], widen: [x]}
  hole-right: {cut_from: right, box: [[-12, -14, 10], [12, 14, 40]], widen: [x]}
features:
  1: {hole: [hole, hole-left, hole-right], axis: [0, 0, 1]}
  2: {face: across, normal: [0, 0, -1]}
)";
const char* const kBolt = R"(format: assay-part/1
name: bolt
initial: BL
units: {length: mm, angle: degree}
density: 1000
friction: 0.3
solids:
  head: {box: [[-25, -25, 0], [25, 25, 20]]}
  across: {box: [[-12, -6.9282032, -30], [12, 6.9282032, 0]]}
  left: {box: [[-12, -6.9282032, -30], [12, 6.9282032, 0]], turn: {axis: [0, 0, 1], angle: 60}}
  right: {box: [[-12, -6.9282032, -30], [12, 6.9282032, 0]], turn: {axis: [0, 0, 1], angle: 120}}
features:
  1: {shaft: [across, left, right], axis: [0, 0, -1]}
  2: {face: head, normal: [0, 0, 1]}
)";
constexpr double kClearance = 0.0008;

Problem BoltInNut() {
  Problem problem;
  problem.parts.resize(2);
  problem.parts[0].name = "bolt";
  problem.parts[0].model = ParsePart(kBolt, kClearance);
  problem.parts[1].name = "nut";
  problem.parts[1].model = ParsePart(kNut, kClearance);
  return problem;
}

// Returns a square bar from -tip to -top along z, and a plate with a square hole, from -thickness
// to 0. Both are in metres.
std::string Bar(double tip, double top) {
  return fmt::format(R"(format: assay-part/1
name: bar
initial: BA
units: {{length: m, angle: degree}}
density: 1000
friction: 0.3
solids:
  bar: {{box: [[-0.01, -0.01, {}], [0.01, 0.01, {}]]}}
features:
  1: {{shaft: bar, axis: [0, 0, -1]}}
)",
                     -tip, -top);
}
std::string Plate(double thickness) {
  return fmt::format(R"(format: assay-part/1
name: plate
initial: PL
units: {{length: m, angle: degree}}
density: 1000
friction: 0.3
solids:
  plate: {{box: [[-0.03, -0.03, {}], [0.03, 0.03, 0]]}}
pockets:
  hole: {{cut_from: plate, box: [[-0.01, -0.01, {}], [0.01, 0.01, 0]], widen: [x, y]}}
features:
  1: {{hole: hole, axis: [0, 0, 1]}}
)",
                     -thickness, -thickness);
}

const Mating kBarDown = {.held = PartId(0),
                         .fixed = PartId(1),
                         .features = {{FeatureNumber(1), FeatureNumber(1)}},
                         .X_FixedHeld = Pose::Identity(),
                         .mating_vector = Vector3(0, 0, -0.05)};

Mating Seated(int of_bolt, int of_nut) {
  return {.held = PartId(0),
          .fixed = PartId(1),
          .features = {{FeatureNumber(of_bolt), FeatureNumber(of_nut)}},
          .X_FixedHeld = geometry::Translation(0, 0, 0.04),
          .mating_vector = Vector3(0, 0, -0.05)};
}

// The gaps are those across the three pairs of sides, and those into the corners at which a pocket
// of the body ends.
TEST(ShaftFit, AHexagonIsHeldAllAround) {
  const Problem problem = BoltInNut();
  const Mating mating = Seated(1, 1);
  EXPECT_TRUE(HasShaftInHole(problem, mating));
  const std::vector<FitGap> gaps = GapsOf(problem, mating);
  ASSERT_THAT(gaps, SizeIs(4));
  for (const auto& [across, low, high] : gaps) {
    EXPECT_NEAR(low, kClearance, 1e-9);
    EXPECT_NEAR(high, kClearance, 1e-9);
    EXPECT_FALSE(IsStopped(problem, mating, (high - 1e-6) * across));
    EXPECT_TRUE(IsStopped(problem, mating, (high + 1e-6) * across));
  }
}

// However a seated part is pushed and turned, it is within its play.
TEST(ShaftFit, NothingThatFitsIsFartherOffThanThePlay) {
  const Problem problem = BoltInNut();
  const Mating mating = Seated(1, 1);
  const SeatPlay play = PlayInSeat(problem, mating, 0);
  for (int i = 0; i < 36; ++i) {
    const double angle = i * std::numbers::pi / 18;
    const Vector3 direction(std::cos(angle), std::sin(angle), 0);
    double farthest = 0;
    while (!IsStopped(problem, mating, farthest * direction)) farthest += 1e-5;
    EXPECT_LE(farthest - 1e-5, play.shift) << i;
    EXPECT_GE(play.shift, kClearance);
  }
  double turn = 0;
  const auto is_turned_in = [&](double by) {
    return !Overlaps(problem.parts[0].model->shape(), mating.X_FixedHeld * geometry::RotationZ(by),
                     problem.parts[1].model->shape(), Pose::Identity(), 0);
  };
  while (is_turned_in(turn)) turn += 1e-4;
  EXPECT_LE(turn - 1e-4, play.turn);
}

// The bar is from -tip to -top along z, the plate from -thickness to 0, in metres.
struct BarInPlate {
  double thickness = 0;
  double tip = 0;
  double top = 0;
  double clearance = 0;

  Problem Read() const {
    Problem problem;
    problem.parts.resize(2);
    problem.parts[0].name = "bar";
    problem.parts[0].model = ParsePart(Bar(tip, top), clearance);
    problem.parts[1].name = "plate";
    problem.parts[1].model = ParsePart(Plate(thickness), clearance);
    return problem;
  }
};

// Returns by how much the bar can tilt about the middle of what is in the hole, up to 1 radian.
double TiltUntilStopped(const Problem& problem, double middle, const Vector3& axis) {
  const auto fits = [&](double tilt) {
    const Pose tilted = geometry::Translation(0, 0, middle) * Eigen::AngleAxisd(tilt, axis) *
                        geometry::Translation(0, 0, -middle);
    return !Overlaps(problem.parts[0].model->shape(), tilted, problem.parts[1].model->shape(),
                     Pose::Identity(), 0);
  };
  double tilt = 0;
  while (tilt < 1 && fits(tilt + 1e-3)) tilt += 1e-3;
  return tilt;
}

// A bar through a plate tilts until it touches the two edges of the hole. How far it sticks out
// behind the plate makes no difference. A pin that is shorter than its hole tilts until its own
// edges touch.
TEST(ShaftFit, ATiltedShaftThatFitsIsWithinThePlay) {
  for (const BarInPlate& each :
       {BarInPlate{0.005, 0.04, -0.01, 0.0008}, BarInPlate{0.005, 0.04, 0, 0.0008},
        BarInPlate{0.03, 0.03, 0, 0.0008}, BarInPlate{0.04, 0.03, 0.024, 0.0008},
        BarInPlate{0.04, 0.03, 0.004, 0.0008}, BarInPlate{0.01, 0.03, 0.004, 0.0008}}) {
    const Problem problem = each.Read();
    const double middle = (std::min(each.thickness, each.tip) + std::max(0.0, each.top)) / -2;
    const SeatPlay play = PlayInSeat(problem, kBarDown, 0);
    for (const double direction : {0.0, 0.4, std::numbers::pi / 4, 1.1, std::numbers::pi / 2}) {
      const Vector3 axis(std::cos(direction), std::sin(direction), 0);
      EXPECT_LE(TiltUntilStopped(problem, middle, axis), play.turn)
          << each.thickness << " " << each.tip << " " << each.top << " " << direction;
    }
  }
}

// The gap of 0.1 mm over 5 mm bounds the tilt about each of two axes.
TEST(ShaftFit, ThePlayOfAThinPlateIsThatOfItsThickness) {
  const SeatPlay play = PlayInSeat(BarInPlate{0.005, 0.04, -0.01, 0.00005}.Read(), kBarDown, 0);
  EXPECT_NEAR(play.turn - play.spin, std::sqrt(2) * 0.02, 0.003);
}

// The play is used up exactly at the ends of the gaps.
TEST(ShaftFit, FitsInsideAsFarAsTheGaps) {
  for (const char* scenario : {"keyed", "uncertain-sensing", "mate-stepped"}) {
    const Problem problem = Load(scenario);
    const Mating& mating = problem.matings.front();
    const std::vector<ShaftFit> fits = FitsOf(problem, mating);
    EXPECT_TRUE(FitsInside(fits, mating.X_FixedHeld)) << scenario;
    for (const auto& [across, low, high] : GapsOf(problem, mating)) {
      const auto moved = [&](double by) {
        return FitsInside(fits, geometry::Translation(by * across) * mating.X_FixedHeld);
      };
      EXPECT_TRUE(moved(high - 1e-9) && moved(-low + 1e-9)) << scenario;
      EXPECT_FALSE(moved(high + 1e-9) || moved(-low - 1e-9)) << scenario;
    }
  }
}

TEST(ShaftFit, FacesHaveNoFit) {
  const Problem problem = BoltInNut();
  for (const auto& mating : {Seated(1, 2), Seated(2, 1), Seated(2, 2)}) {
    EXPECT_THAT(FitsOf(problem, mating), IsEmpty());
    EXPECT_FALSE(HasShaftInHole(problem, mating));
  }
}

TEST(Slots, TheNarrowestOfParallelWallsAndEachDirectionOnce) {
  const Vector3 x = Vector3::UnitX(), y = Vector3::UnitY();
  const std::vector<Slot> slots =
      SlotsOf({{x, -2}, {-x, -3}, {Vector3(-x), -1}, {y, -5}, {Vector3(x), -1.5}});
  ASSERT_THAT(slots, SizeIs(1));
  const double sense = slots[0].across.x();
  EXPECT_EQ(sense * (sense > 0 ? slots[0].low : slots[0].high), -1.5);
  EXPECT_EQ(sense * (sense > 0 ? slots[0].high : slots[0].low), 1);
  EXPECT_FALSE(HoldAllAround(slots)) << "nothing faces the wall along y";
  EXPECT_TRUE(HoldAllAround(SlotsOf({{x, -2}, {-x, -3}, {y, -5}, {Vector3(-y), -5}})));
}

}  // namespace
}  // namespace assay::domain::shaft_fit_test
