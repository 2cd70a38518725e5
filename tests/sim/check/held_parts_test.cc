#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "planner/base/random.h"
#include "sim/check/trial_verdicts/trial.h"
#include "sim/noise/error_box.h"
#include "sim/noise/sampling.h"
#include "tests/sim/check/random_scenes.h"

// Checks the precondition `holding` against the engine, for parts of many weights between pads of
// many frictions and forces.
namespace assay::check::held_parts_test {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kSeed = 27;
const fs::path kModels = ASSAY_SOURCE_DIR "/models";

// For a longer test: ASSAY_HELD_SCENES=500 scenes, and ASSAY_HELD_CORNERS=20 corners of each proved
// one. ASSAY_HELD_FIRST=160 leaves out the scenes before this one.

// The quantities that differ between scenes. `tolerance` is a fraction of the pads' friction.
struct Draw {
  double density = 1;  // density of the peg over that of the stock peg
  double pad_friction = 0.15;
  double grip_force = 100;  // newtons
  double tolerance = 0;
  double block_yaw = 30;  // degrees
  double peg_yaw = -120;
  bool mates = true;  // false: the peg is put down elsewhere

  std::string Text() const {
    return fmt::format(
        "seed {}: density x {:.4g}, pads {:.4g} +- {:.4g}, {:.4g} N, yaws {:.4g} and {:.4g}, {}",
        kSeed, density, pad_friction, tolerance * pad_friction, grip_force, block_yaw, peg_yaw,
        mates ? "mated" : "put down");
  }
};

double Between(RandomStream& random, double low, double high) {
  return std::exp(random.Uniform(std::log(low), std::log(high)));
}

Draw DrawScene(RandomStream& random) {
  Draw draw;
  draw.density = Between(random, 0.05, 20);
  draw.pad_friction = Between(random, 0.02, 1);
  draw.grip_force = Between(random, 5, 150);
  draw.tolerance = random.Uniform(0, 1) < 0.3 ? 0 : random.Uniform(0, 1);
  draw.block_yaw = random.Uniform(-180, 180);
  draw.peg_yaw = random.Uniform(-180, 180);
  draw.mates = random.Uniform(0, 1) < 0.7;
  return draw;
}

// Returns a folder of the stock models in which the peg has `density` times its usual density.
fs::path ModelsWith(double density) {
  const fs::path folder = ModelsWithPart(fmt::format("models-{:.17g}", density), "peg");
  if (!fs::exists(folder / "parts/block")) {
    fs::create_directory_symlink(kModels / "parts/block", folder / "parts/block");
  }
  std::ifstream stock(kModels / "parts/peg/part.yaml");
  std::ofstream own(folder / "parts/peg/part.yaml");
  for (std::string line; std::getline(stock, line);) {
    const bool is_density = line.starts_with("density:");
    own << (is_density ? fmt::format("density: {:.17g}", 700 * density) : line) << "\n";
  }
  return folder;
}

domain::Problem ProblemOf(const Draw& draw) {
  const std::string text = fmt::format(
      R"(format: assay-scenario/1
units: {{length: mm, angle: degree}}
workcell: puma762-table
clearance: 1
rules: {{grip_force: {}, pad_friction: {}}}
tolerances: {{clearance: {}, friction: {}, pad_friction: {}}}
parts:
  block:
    model: block
    pose: {{stable: on-back, at: [600, 50], yaw: {}}}
    error: {{x: 0.05, y: 0.05, z: 0.02, theta: 0.02}}
  peg:
    model: peg
    pose: {{stable: on-side, at: [500, -200], yaw: {}}}
    error: {{x: 0.05, y: 0.05, z: 0.02, theta: 0.02}}
gripper: {{error: {{x: 0.02, y: 0.02, z: 0.02, theta: 0.01}}}}
sensing: [overhead-camera]
resolvers: [sensing, squeezing]
goal:
)",
      draw.grip_force, draw.pad_friction, 0.3 * draw.tolerance, 0.2 * draw.tolerance,
      draw.tolerance * draw.pad_friction * 0.999, draw.block_yaw, draw.peg_yaw);
  const char* goal = draw.mates ? R"(  - assembled:
      held: peg
      fixed: block
      features: [[7, 8], [7, 8]]
      pose: {columns: [[-1, 0, 0], [0, 1, 0], [0, 0, -1], [76.2, 0, 82.55]]}
      mating_vector: [-101.6, 0, 0]
)"
                                : R"(  - located: {part: peg, stable: [shaft-up]}
)";
  return domain::ReadProblem(Document::Parse(text + goal, "held-parts.yaml"),
                             ModelsWith(draw.density));
}

Verdict AtCorner(const Planned& planned, int corner) {
  const Experiment experiment{planned.problem, planned.plan};
  const auto box = noise::ErrorBox(planned.problem, planned.plan);
  execution::ExecutorOptions options;
  options.sample_rate = 0;
  const noise::Noise noise =
      noise::Sample(planned.problem, box, noise::Mode::kVertices, kSeed, corner);
  return RunTrial(experiment, noise, options).verdict;
}

// Every corner of the error box succeeds if the whole plan is proved. Nothing falls, slips or
// topples.
TEST(HeldParts, WhatIsProvedKeepsToItAtTheCorners) {
  RandomStream random(kSeed, "held parts");
  const int corners = Asked("ASSAY_HELD_CORNERS", 1);
  int proved = 0;
  const int first = Asked("ASSAY_HELD_FIRST", 0);
  const int scenes = Asked("ASSAY_HELD_SCENES", 4);
  for (int scene = 0; scene < scenes; ++scene) {
    const Draw draw = DrawScene(random);
    if (scene < first) continue;
    const Planned planned = PlanFor(ProblemOf(draw), {});
    if (!planned.is_proved) continue;
    ++proved;
    std::cout << "scene " << scene << " is proved\n" << std::flush;
    for (int corner = 1; corner <= corners; ++corner) {
      const Verdict verdict = AtCorner(planned, corner);
      EXPECT_EQ(verdict.outcome, TrialOutcome::kSucceeded)
          << draw.Text() << ", scene " << scene << ", corner " << corner << ": " << verdict.reason;
    }
  }
  EXPECT_GT(proved, 0);
  RecordProperty("proved", proved);
  std::cout << proved << " of " << scenes - first << " scenes are proved\n";
}

}  // namespace
}  // namespace assay::check::held_parts_test
