#include "sim/check/measurements/fit.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "planner/base/random.h"
#include "planner/domain/problem/problem_file.h"
#include "planner/geometry/pose.h"

namespace assay::check::fit_test {
namespace {

using geometry::Pose;
using geometry::Vector3;

// Spar's peg and block with a clearance of 0.5 mm: a square shaft of 38.1 mm in a square hole.
class FitTest : public testing::Test {
 protected:
  FitTest()
      : problem_(domain::ReadProblem(Document::Load(ASSAY_SOURCE_DIR "/scenarios/spar-fig15.yaml"),
                                     ASSAY_SOURCE_DIR "/models")),
        mating_(problem_.matings.front()),
        direction_(mating_.mating_vector.normalized()) {}

  // Returns the margins if the peg starts at its planned pose with this error in the block's frame.
  FitMargins With(const Pose& error) const {
    const Pose start = geometry::Translation(-mating_.mating_vector) * error * mating_.X_FixedHeld;
    return MarginsOfFits(problem_, mating_, {start, direction_});
  }

  static constexpr double kClearance = 0.0005;
  domain::Problem problem_;
  domain::Mating mating_;
  Vector3 direction_;
};

TEST_F(FitTest, ACentredShaftHasTheClearanceOnEachSide) {
  const FitMargins margins = With(Pose::Identity());
  EXPECT_NEAR(margins.entry, kClearance, 1e-9);
  EXPECT_NEAR(margins.slide_in, kClearance, 1e-9);
}

TEST_F(FitTest, ADisplacementTakesFromOneSide) {
  RandomStream random(1, "fit");
  for (int i = 0; i < 100; ++i) {
    const double y = random.Uniform(-0.001, 0.001);
    const double z = random.Uniform(-0.001, 0.001);
    const double along = random.Uniform(-0.003, 0.003);
    const FitMargins margins = With(geometry::Translation(along, y, z));
    EXPECT_NEAR(margins.slide_in, kClearance - std::max(std::abs(y), std::abs(z)), 1e-9);
    EXPECT_NEAR(margins.entry, margins.slide_in, 1e-9);
  }
}

// The axis of the hole is along x of the block, at y = 0, z = 82.55 mm. A turn by an angle about it
// brings a corner of the shaft from (h, h) out to h (cos + sin).
TEST_F(FitTest, ATurnAboutTheAxisBringsCornersOut) {
  const Vector3 axis(0, 0, 3.25 * 0.0254);
  const double half = 0.75 * 0.0254;
  for (const double angle : {-0.02, 0.005, 0.01}) {
    Pose turn = Pose::Identity();
    turn.linear() = Eigen::AngleAxisd(angle, Vector3::UnitX()).toRotationMatrix();
    const FitMargins margins =
        With(geometry::Translation(axis) * turn * geometry::Translation(-axis));
    const double out = half * (std::cos(angle) + std::abs(std::sin(angle))) - half;
    EXPECT_NEAR(margins.slide_in, kClearance - out, 1e-9) << angle;
  }
}

// A turn about y of the block leans the shaft across the walls whose normals are along z, and
// across no others.
TEST_F(FitTest, ALeanIsTheSineOfItsAngleAcrossOnePairOfWalls) {
  Pose tilt = Pose::Identity();
  tilt.linear() = Eigen::AngleAxisd(0.004, Vector3::UnitY()).toRotationMatrix();
  const std::vector<Lean> leans = LeansInSlots(problem_, mating_, {tilt * mating_.X_FixedHeld, {}});
  ASSERT_EQ(leans.size(), 2);
  for (const Lean& lean : leans) {
    const bool across_z = lean.slot.ends_with("1)");
    EXPECT_EQ(across_z, !lean.slot.ends_with("0)")) << lean.slot;
    EXPECT_NEAR(lean.sine, across_z ? std::sin(0.004) : 0, 1e-12) << lean.slot;
  }
}

// The clearance is also right where the tip's face extends beyond the shaft, as on a key and on the
// head of a T-slide.
TEST(FitOfParts, ACentredShaftHasTheClearanceOnEachSide) {
  for (const char* name :
       {"spar-fig15", "keyed", "mate-stepped", "mate-octagonal", "mate-t-slot"}) {
    const domain::Problem problem = domain::ReadProblem(
        Document::Load(fmt::format("{}/scenarios/{}.yaml", ASSAY_SOURCE_DIR, name)),
        ASSAY_SOURCE_DIR "/models");
    const domain::Mating& mating = problem.matings.front();
    const Pose start = geometry::Translation(-mating.mating_vector) * mating.X_FixedHeld;
    const FitMargins margins =
        MarginsOfFits(problem, mating, {start, mating.mating_vector.normalized()});
    EXPECT_NEAR(margins.entry, problem.clearance, 1e-9) << name;
    EXPECT_NEAR(margins.slide_in, problem.clearance, 1e-9) << name;
  }
}

}  // namespace
}  // namespace assay::check::fit_test
