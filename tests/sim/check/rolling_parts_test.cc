#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "sim/check/trial_verdicts/trial.h"
#include "sim/noise/error_box.h"
#include "tests/scratch_file.h"
#include "tests/sim/check/certified.h"

namespace assay::check::rolling_parts_test {
namespace {

namespace fs = std::filesystem;

// Returns a folder of models with a bar whose wing, `wing` metres long, draws its centre of mass to
// an edge of the face on which it lies.
fs::path ModelsWith(double wing) {
  const fs::path stock = ASSAY_SOURCE_DIR "/models";
  const fs::path folder = ScratchFile(fmt::format("models-{}", wing));
  fs::create_directories(folder / "parts/bar");
  for (const char* same : {"grippers", "robots", "workcells"}) {
    if (!fs::exists(folder / same)) fs::create_directory_symlink(stock / same, folder / same);
  }
  std::ofstream(folder / "parts/bar/part.yaml") << fmt::format(R"(format: assay-part/1
name: bar
initial: B
units: {{length: mm, angle: degree}}
density: 539
friction: 0.19
solids:
  body: {{box: [[-10.6, -16.6, 0], [10.6, 16.6, 84.5]]}}
  wing: {{box: [[10.6, -5.6, 11.3], [{}, 11.3, 66.3]]}}
features:
  1: {{face: body, normal: [0, 0, -1], what: under}}
)",
                                                               10.6 + 1000 * wing);
  return folder;
}

domain::Problem ProblemOf(double wing) {
  return domain::ReadProblem(Document::Parse(R"(format: assay-scenario/1
units: {length: mm, angle: degree}
workcell: puma762-table
rules: {pad_friction: 0.145, grip_force: 68}
parts:
  bar:
    model: bar
    pose: {stable: BP5, at: [626, 200], yaw: -22}
    error: {x: 0.066, y: 0.066, z: 0.05, theta: 0.363}
gripper: {error: {x: 0.034, y: 0.034, z: 0.034, theta: 0.017}}
goal:
  - located: {part: bar, stable: [BP1]}
)",
                                             "rolling-parts.yaml"),
                             ModelsWith(wing));
}

// Returns the claim on the bar's turn about the closing direction, after it has been grasped at its
// ends. The bar is turned on the table, and the hand about its own axis, by these angles in
// radians.
Claim TwistOf(const Certified& certified, double turn, double hand) {
  const auto box = noise::ErrorBox(certified.problem, certified.plan);
  const plan::StepId pickup = FirstStep(domain::kPickup, certified.plan);
  const noise::Noise noise = noise::ParseNoise(
      fmt::format("theta_bar={} theta_hand@{}={}", turn, certified.plan.step(pickup).name, hand),
      box);
  execution::ExecutorOptions options;
  options.sample_rate = 0;
  options.last = pickup;
  const Trial trial = RunTrial({certified.problem, certified.plan}, noise, options);
  const auto twist = std::ranges::find_if(trial.claims, [&](const Claim& claim) {
    return claim.name == "twist of bar" && claim.about == Claimed::kAfter;
  });
  EXPECT_NE(twist, trial.claims.end());
  return *twist;
}

// Pads of a leaning hand may roll a bar whose wing draws its centre of mass to an edge. With more
// friction they rolled it by a tenth of a degree, but then they count as pads that may jam.
TEST(RollingParts, StayInTheirCertificates) {
  for (const double wing : {0.033, 0.025, 0.014}) {
    const Certified certified = CertifiedPlan(ProblemOf(wing));
    for (const double turn : {0.0063, -0.0063}) {
      for (const double hand : {0.00029, -0.00029}) {
        const Claim twist = TwistOf(certified, turn, hand);
        EXPECT_FALSE(twist.IsViolated())
            << "wing " << wing << " m, turn " << turn << ", hand " << hand << ": " << twist.observed
            << " in [" << twist.predicted.low << ", " << twist.predicted.high << "]";
      }
    }
  }
}

}  // namespace
}  // namespace assay::check::rolling_parts_test
