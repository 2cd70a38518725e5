#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "planner/base/random.h"
#include "planner/domain/matings/mating_success.h"
#include "planner/domain/matings/shaft_fit.h"
#include "planner/geometry/pose.h"
#include "planner/plan/certificates/condition_table.h"
#include "planner/uncertainty/preconditions/certify.h"
#include "tests/planner/uncertainty/action_lists.h"

// The precondition `in place`: a mated part ends as near its place as a successful assembly allows.
namespace assay::uncertainty::place_test {
namespace {

using geometry::Pose;

constexpr double kMillimetre = 1e-3;
constexpr double kClearance = 2;  // millimetres
constexpr double kTooNarrow = 0.5;

// The peg goes into the block. Its place is `off` millimetres off the middle of the hole, along the
// block's z. The block's error along this direction is up to `error` millimetres.
domain::Problem PegInBlock(double clearance, double off, double error) {
  const std::string text = fmt::format(
      R"(format: assay-scenario/1
units: {{length: mm, angle: degree}}
workcell: puma762-table
clearance: {}
parts:
  block:
    model: block
    pose: {{stable: on-back, at: [600, 50], yaw: 0}}
    error: {{x: 0, y: {}, z: 0, theta: 0}}
  peg:
    model: peg
    pose: {{stable: on-side, at: [500, -200], yaw: -120}}
    error: {{x: 0, y: 0, z: 0, theta: 0}}
gripper: {{error: {{x: 0, y: 0, z: 0, theta: 0}}}}
sensing: []
goal:
  - assembled:
      held: peg
      fixed: block
      features: {}
      pose: {{columns: [[-1, 0, 0], [0, 1, 0], [0, 0, -1], [76.2, 0, {}]]}}
      mating_vector: [-101.6, 0, 0]
)",
      clearance, error, off == 0 ? "[[7, 8], [7, 8]]" : "[[7], [7]]", 82.55 + off);
  return domain::ReadProblem(Document::Parse(text, "place.yaml"), ASSAY_SOURCE_DIR "/models");
}

std::vector<plan::CertifiedPrecondition> InPlace(const domain::Problem& problem) {
  std::vector<plan::CertifiedPrecondition> claims;
  for (const CertifiedAction& action : Certify(problem, FirstPlan(problem))) {
    std::ranges::copy_if(
        action.certificate.preconditions, std::back_inserter(claims),
        [](const auto& claim) { return claim.condition == plan::condition::kInPlace; });
  }
  EXPECT_FALSE(claims.empty());
  return claims;
}

double LeastMargin(const domain::Problem& problem) {
  double margin = std::numeric_limits<double>::infinity();
  for (const auto& claim : InPlace(problem)) margin = std::min(margin, claim.margin);
  return margin;
}

// The walls of the hole let the peg go 3.5 mm off its place, and a success allows 2.2 mm. So only
// the errors can prove the claim. The peg is where the hand puts it, and the block is not. The
// walls along the other axis leave a margin of 0.2 mm.
TEST(InPlace, OffTheMiddleTheErrorsDecide) {
  for (const double error : {0.5, 1.9, 2.1, 2.3, 2.9}) {
    const double room = kClearance + domain::kLateralSlack / kMillimetre - error;
    EXPECT_NEAR(LeastMargin(PegInBlock(kClearance, 1.5, error)) / kMillimetre, std::min(0.2, room),
                1e-6)
        << error;
  }
}

// In the middle of the hole, the walls let the peg go no farther than a success allows.
TEST(InPlace, InTheMiddleTheWallsProveItForAllErrors) {
  for (const double error : {0.0, 2.9, 20.0}) {
    EXPECT_GT(LeastMargin(PegInBlock(kTooNarrow, 0, error)), 0) << error;
  }
}

// Oracle: poses of the peg that are drawn at random, and kept if the shaft is between its walls.
TEST(InPlace, NoPoseBetweenTheWallsIsFartherOffThanClaimed) {
  const domain::Problem problem = PegInBlock(kTooNarrow, 0, 20);
  const domain::Mating& mating = problem.matings[0];
  const std::vector<domain::ShaftFit> fits = domain::FitsOf(problem, mating);
  double claimed = 0;
  for (const auto& claim : InPlace(problem)) {
    if (claim.meaning.starts_with("alignment")) claimed = std::max(claimed, claim.bound);
  }
  const geometry::Vector3 hole = problem.part(mating.held)
                                     .model->FindFeature(mating.features[1].first)
                                     ->X_PartFeature.translation();
  RandomStream random(42, "poses between the walls");
  double farthest = 0;
  for (int draw = 0; draw < 20'000; ++draw) {
    const auto within = [&](double bound) { return random.Uniform(-bound, bound); };
    const geometry::Vector3 shaft = mating.X_FixedHeld.translation();
    const Pose moved = geometry::Translation(0, within(6e-4), within(6e-4)) *
                       geometry::Translation(shaft) * geometry::RotationX(within(0.04)) *
                       geometry::Translation(-shaft) * mating.X_FixedHeld;
    if (!domain::FitsInside(fits, moved)) continue;
    const geometry::Vector3 off = moved * hole - mating.X_FixedHeld * hole;
    farthest = std::max(farthest, std::hypot(off.y(), off.z()));
  }
  EXPECT_LE(farthest, claimed);
  EXPECT_GT(farthest, claimed / 3);  // shift and turn are greatest at different poses
  EXPECT_LT(claimed, domain::AlignmentLimit(problem));
}

}  // namespace
}  // namespace assay::uncertainty::place_test
