#include "sim/noise/noise.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "planner/base/input_files/input_error.h"
#include "planner/base/random.h"
#include "tests/oracle/random_pose.h"
#include "tests/sim/noise/figure15_careful.h"

namespace assay::noise::noise_test {
namespace {

using geometry::Vector3;
using testing::HasSubstr;

constexpr std::uint64_t kSeed = 42;

class NoiseTest : public testing::Test {
 protected:
  NoiseTest()
      : problem_(Figure15()),
        box_(ErrorBox(problem_, OneOfEachStep(problem_))),
        noise_(box_, std::vector<double>(box_.size(), 0)) {}

  void Set(const std::string& name, double value) {
    for (std::size_t i = 0; i < box_.size(); ++i) {
      if (box_[i].name == name) return noise_.Set(i, value);
    }
    FAIL() << name;
  }
  Noise Drawn() const {
    RandomStream random(kSeed, "noise");
    std::vector<double> values;
    for (const Channel& channel : box_) {
      values.push_back(random.Uniform(channel.range.low, channel.range.high));
    }
    return {box_, values};
  }

  domain::Problem problem_;
  std::vector<Channel> box_;
  Noise noise_;
};

// The oracle is T_(O+d) of Spar's equation 2, element by element. The part's frame is turned about
// the world's z, and its origin is displaced along the world's axes.
TEST_F(NoiseTest, TruePoseFollowsSparsEquation2) {
  const double x = 0.002, y = -0.001, z = 0.0015, theta = 0.07;
  Set("dx_peg", x);
  Set("dy_peg", y);
  Set("dz_peg", z);
  Set("theta_peg", theta);
  RandomStream random(kSeed, "poses");
  for (int i = 0; i < 20; ++i) {
    const Pose believed = oracle::RandomPose(random, 0.5);
    const auto b = believed.matrix();
    Eigen::Matrix4d expected = b;
    for (int column = 0; column < 3; ++column) {
      expected(0, column) = std::cos(theta) * b(0, column) - std::sin(theta) * b(1, column);
      expected(1, column) = std::sin(theta) * b(0, column) + std::cos(theta) * b(1, column);
    }
    expected(0, 3) += x;
    expected(1, 3) += y;
    expected(2, 3) += z;
    EXPECT_TRUE(noise_.TruePose(kPeg, believed).matrix().isApprox(expected, 1e-14));
    EXPECT_TRUE(noise_.TruePose(kBlock, believed).matrix().isApprox(b, 1e-15)) << "is another part";
  }
}

// The oracle is T_dM of Spar's equation 1: Trans(x, y, z) Rot(z, theta).
TEST_F(NoiseTest, HandErrorFollowsSparsEquation1) {
  const double theta = 0.1;
  Set("dx_hand@action_4", 0.001);
  Set("dy_hand@action_4", 0.002);
  Set("dz_hand@action_4", 0.003);
  Set("theta_hand@action_4", theta);
  Eigen::Matrix4d expected;
  expected << std::cos(theta), -std::sin(theta), 0, 0.001,  //
      std::sin(theta), std::cos(theta), 0, 0.002,           //
      0, 0, 1, 0.003,                                       //
      0, 0, 0, 1;
  EXPECT_TRUE(noise_.HandError(StepId(3)).matrix().isApprox(expected, 1e-15));
  for (const int other : {0, 1, 2, 4, 5}) {
    EXPECT_EQ(noise_.HandError(StepId(other)).matrix(), Eigen::Matrix4d::Identity());
  }
}

// The table has one height where a part is at the start, and another where it is put down.
TEST_F(NoiseTest, TableHeightsAreOfPlaces) {
  Set("dz_peg", 0.001);
  Set("dz_peg@action_3", -0.002);
  EXPECT_EQ(noise_.TableHeight(kPeg), 0.001);
  EXPECT_EQ(noise_.TableHeight(kBlock), 0);
  EXPECT_EQ(noise_.TableHeight(StepId(2)), -0.002);
  EXPECT_EQ(noise_.TableHeight(StepId(0)), std::nullopt);
}

TEST_F(NoiseTest, SensingErrorsAreOfTheirLook) {
  Set("dx_sensed@action_6", 0.0001);
  Set("dy_sensed@action_6", 0.0002);
  Set("theta_sensed@action_6", -0.001);
  EXPECT_EQ(noise_.Sensed(StepId(5)).displacement, Vector3(0.0001, 0.0002, 0));
  EXPECT_EQ(noise_.Sensed(StepId(5)).yaw, -0.001);
  EXPECT_EQ(noise_.Sensed(StepId(4)).displacement, Vector3::Zero());
}

TEST_F(NoiseTest, ToleranceErrorsAreOfTheWorkcell) {
  problem_.tolerances = {.clearance = 1e-4, .friction = 0.05, .pad_friction = 0.02};
  box_ = ErrorBox(problem_, OneOfEachStep(problem_));
  noise_ = Noise(box_, std::vector<double>(box_.size(), 0));
  Set("clearance", 5e-5);
  Set("pad_friction", -0.01);
  EXPECT_EQ(noise_.Of(Effect::kClearance), 5e-5);
  EXPECT_EQ(noise_.Of(Effect::kFriction), 0);
  EXPECT_EQ(noise_.Of(Effect::kPadFriction), -0.01);
}

TEST_F(NoiseTest, NoNoiseChangesNothing) {
  const Noise none;
  const Pose pose = problem_.part(kPeg).X_WorldPart;
  EXPECT_TRUE(none.TruePose(kPeg, pose).isApprox(pose, 1e-15));
  EXPECT_EQ(none.HandError(StepId(0)).matrix(), Eigen::Matrix4d::Identity());
  EXPECT_EQ(Text(none), "");
}

TEST_F(NoiseTest, CopiesAreIndependent) {
  Noise copy = noise_;
  copy.Set(0, 0.001);
  EXPECT_EQ(noise_.values()[0], 0);
}

TEST_F(NoiseTest, TextNamesWhatIsNotZero) {
  Set("dx_block", 0.0025);
  Set("dz_hand@action_3", -1e-05);
  EXPECT_EQ(Text(noise_), "dx_block=0.0025 dz_hand@action_3=-1e-05");
}

TEST_F(NoiseTest, TextReadsBackToTheBit) {
  const Noise drawn = Drawn();
  EXPECT_EQ(ParseNoise(Text(drawn), box_).values(), drawn.values());
  EXPECT_EQ(ParseNoise("", box_).values(), std::vector<double>(box_.size(), 0));
}

std::string WhyNot(const std::string& text, const std::vector<Channel>& box) {
  try {
    ParseNoise(text, box);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST_F(NoiseTest, RefusesWhatIsNoErrorOfTheBox) {
  EXPECT_THAT(WhyNot("dx_blocks=0.001", box_), HasSubstr("'dx_blocks'"));
  EXPECT_THAT(WhyNot("dx_blocks=0.001", box_), HasSubstr("dx_block, dy_block"));
  EXPECT_THAT(WhyNot("dx_block", box_), HasSubstr("'dx_block'"));
  EXPECT_THAT(WhyNot("dx_block=", box_), HasSubstr("is no number"));
  EXPECT_THAT(WhyNot("dx_block=1e-4x", box_), HasSubstr("'1e-4x' is no number"));
  EXPECT_THAT(WhyNot("dx_block=nan", box_), HasSubstr("outside"));
  EXPECT_THAT(WhyNot("dx_block=0.001 dy_block=-0.003", box_), HasSubstr("dy_block=-0.003"));
  EXPECT_EQ(WhyNot("dx_block=0.001 dy_block=-0.002", box_), "");
}

// A person may round the corner's 0.002794 up when writing it.
TEST_F(NoiseTest, TakesWhatIsOutsideByRoundingAsTheEnd) {
  const double high = box_[0].range.high;
  const Noise read = ParseNoise("dx_block=" + std::to_string(high), box_);
  EXPECT_NEAR(read.values()[0], high, 1e-6);
  EXPECT_LE(ParseNoise("dx_block=0.0027940000001", box_).values()[0], high);
  EXPECT_THAT(WhyNot("dx_block=0.00279401", box_), HasSubstr("outside"));
}

}  // namespace
}  // namespace assay::noise::noise_test
