#include "sim/noise/possible_start.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "planner/base/input_files/input_error.h"
#include "planner/domain/parts/part_model.h"
#include "planner/geometry/hull.h"
#include "planner/geometry/polygon.h"
#include "planner/geometry/solids/separation.h"
#include "sim/noise/sampling.h"
#include "tests/planner/domain/scenario.h"

namespace assay::noise::possible_start_test {
namespace {

using testing::HasSubstr;

constexpr std::uint64_t kSeed = 3;
constexpr PartId kBlock(0);
constexpr PartId kBrick(1);
constexpr PartId kFar(2);

// A brick stands half a millimetre beside the block, and another one far from both. Each may be
// 3 mm off.
constexpr char kNeighbours[] = R"(
format: assay-scenario/1
units: {length: mm, angle: degree}
workcell: puma762-table
parts:
  block: {model: block, pose: {stable: on-back, at: [600, 50]}, error: {x: 3, y: 3, z: 0.1, theta: 1}}
  brick: {model: brick, pose: {stable: upright, at: [664.0, 130]}, error: {x: 3, y: 3, theta: 1}}
  far: {model: brick, pose: {stable: upright, at: [600, -300]}, error: {x: 3, y: 3, theta: 1}}
goal:
  - located: {part: far, stable: [upright]}
)";

constexpr char kCarried[] = R"(
format: assay-scenario/1
units: {length: inch, angle: degree}
workcell: puma762-table
parts:
  lower: {model: brick, pose: {stable: upright, at: [24, 2]}, error: {z: 0.05}}
  upper: {model: brick, error: {x: 0.1}}
  other: {model: brick, pose: {stable: upright, at: [24, -8]}}
initially:
  - assembled: {held: upper, fixed: lower, features: [[6], [5]],
                pose: {columns: [[1, 0, 0], [0, 1, 0], [0, 0, 1], [0, 0, 4]]},
                mating_vector: [0, 0, -1]}
goal:
  - located: {part: other, stable: [upright]}
)";

class PossibleStartTest : public testing::Test {
 protected:
  // Returns the greatest separation of the block and the brick. It is negative if they overlap.
  double Gap(const Noise& noise) const {
    const Pose X_WorldBlock = noise.TruePose(kBlock, problem_.part(kBlock).X_WorldPart);
    const Pose X_WorldBrick = noise.TruePose(kBrick, problem_.part(kBrick).X_WorldPart);
    double least = 1;
    for (const auto& of_block : Transformed(problem_.part(kBlock).model->pieces(), X_WorldBlock)) {
      for (const auto& of_brick :
           Transformed(problem_.part(kBrick).model->pieces(), X_WorldBrick)) {
        least = std::min(least, geometry::Separation(of_block, of_brick));
      }
    }
    return least;
  }
  Noise Drawn(Mode mode, int number) const { return Sample(problem_, box_, mode, kSeed, number); }
  // Returns the noise that is drawn if no other part is near.
  Noise DrawnAlone(Mode mode, int number) const {
    domain::Problem alone = problem_;
    alone.parts[kBrick.index()].X_WorldPart.translation().x() += 0.5;
    return Sample(alone, box_, mode, kSeed, number);
  }

  const domain::Problem problem_ = domain::ParseScenario(kNeighbours);
  const std::vector<Channel> box_ = ErrorBox(problem_, {});
};

TEST_F(PossibleStartTest, NoSampleOverlaps) {
  const PossibleStart start(problem_);
  for (const Mode mode : {Mode::kUniform, Mode::kVertices, Mode::kLowDiscrepancy}) {
    int impossible = 0;
    for (int number = 1; number <= 200; ++number) {
      const Noise noise = Drawn(mode, number);
      ASSERT_GT(Gap(noise), -1e-8) << Name(mode) << ' ' << number;
      ASSERT_FALSE(start.FirstOverlap(noise));
      for (std::size_t i = 0; i < box_.size(); ++i) {
        ASSERT_GE(noise.values()[i], box_[i].range.low);
        ASSERT_LE(noise.values()[i], box_[i].range.high);
      }
      ASSERT_EQ(noise.values(), Drawn(mode, number).values());
      const Noise alone = DrawnAlone(mode, number);
      if (Gap(alone) > 1e-8) {
        ASSERT_EQ(noise.values(), alone.values());
      } else {
        ++impossible;
        ASSERT_NE(noise.values(), alone.values());
      }
    }
    EXPECT_GT(impossible, 20) << Name(mode);
  }
}

// The errors of the two parts are shrunk by one factor until the parts touch. All other errors
// stay.
TEST_F(PossibleStartTest, CornersAreMovedBackUntilThePartsJustTouch) {
  int moved = 0;
  for (int number = 1; number <= 100; ++number) {
    const Noise corner = DrawnAlone(Mode::kVertices, number);
    if (Gap(corner) > 0) continue;
    ++moved;
    const Noise noise = Drawn(Mode::kVertices, number);
    EXPECT_LT(Gap(noise), 1e-7);
    const double factor = noise.values()[0] / corner.values()[0];
    EXPECT_LT(factor, 1);
    for (std::size_t i = 0; i < box_.size(); ++i) {
      const bool is_far = box_[i].part == kFar;
      EXPECT_NEAR(noise.values()[i], (is_far ? 1 : factor) * corner.values()[i], 1e-15)
          << box_[i].name;
    }
  }
  EXPECT_GT(moved, 10);
}

// If a trial has worked on a part already, the errors of this part stay as they are.
TEST_F(PossibleStartTest, OnlyWhatDiffersIsMovedBack) {
  const PossibleStart start(problem_);
  const Noise none(box_, std::vector<double>(box_.size(), 0));
  Noise possible = none;
  Noise wanted = none;
  for (std::size_t i = 0; i < box_.size(); ++i) {
    if (box_[i].name == "dx_block") {
      possible.Set(i, 0.0004);
      wanted.Set(i, 0.0004);
    }
    if (box_[i].name == "dx_brick") wanted.Set(i, -0.003);
  }
  ASSERT_LT(Gap(wanted), 0);
  const Noise moved = start.MovedBack(wanted, possible);
  EXPECT_NEAR(Gap(moved), 0, 1e-8);
  for (std::size_t i = 0; i < box_.size(); ++i) {
    if (box_[i].name != "dx_brick") {
      EXPECT_EQ(moved.values()[i], wanted.values()[i]);
    }
  }
}

TEST_F(PossibleStartTest, AnImpossibleStartIsRefused) {
  const PossibleStart start(problem_);
  EXPECT_NO_THROW(start.Require(ParseNoise("dx_block=0.0004", box_)));
  try {
    start.Require(ParseNoise("dx_block=0.001", box_));
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("'block' and 'brick' overlap at the start"));
  }
}

// The table of the carrier raises both parts, so that the upper one neither floats nor overlaps.
TEST(CarriedPart, IsRaisedWithItsCarrier) {
  const domain::Problem problem = domain::ParseScenario(kCarried);
  const std::vector<Channel> box = ErrorBox(problem, {});
  for (const Channel& channel : box) EXPECT_NE(channel.name, "dz_upper");
  const Noise noise = ParseNoise("dz_lower=0.001", box);
  EXPECT_EQ(HeightAtStart(problem, noise, PartId(1)), 0.001);
  std::vector<Pose> believed;
  for (const domain::Part& part : problem.parts) believed.push_back(part.X_WorldPart);
  const std::vector<Pose> truly = TruePoses(problem, noise, believed);
  for (const std::size_t i : {0u, 1u, 2u}) {
    EXPECT_NEAR(truly[i].translation().z(), believed[i].translation().z() + (i < 2 ? 0.001 : 0),
                1e-15);
  }
}

TEST(DrawUntilPossible, CountsRejectedDraws) {
  int draws = 0;
  EXPECT_EQ(DrawUntilPossible([&] { return ++draws == 4; }), 3);
  EXPECT_EQ(DrawUntilPossible([] { return false; }), std::nullopt);
}

}  // namespace
}  // namespace assay::noise::possible_start_test
