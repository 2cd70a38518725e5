#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <optional>
#include <string>
#include <utility>

#include "planner/base/random.h"
#include "planner/domain/parts/part_file.h"
#include "tests/sim/check/random_scenes.h"

// Checks all that certificates claim about random shafts that are put into their holes.
namespace assay::check::random_matings_test {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kSeed = 27;

// For a longer test: ASSAY_RANDOM_MATINGS=500 scenes, and ASSAY_RANDOM_MATINGS_CORNERS=20 corners
// of each proved one. ASSAY_RANDOM_MATINGS_FIRST=160 leaves out the scenes before this one.

// A rectangular shaft and its hole, in millimetres. The shaft goes down from z = 0 of its part.
struct Shaft {
  double half_x = 0;
  double half_y = 0;
  double length = 0;
};

double Between(RandomStream& random, double low, double high) {
  return std::exp(random.Uniform(std::log(low), std::log(high)));
}

std::string PartHead(RandomStream& random, const std::string& name, const std::string& initial) {
  return fmt::format(
      "format: assay-part/1\nname: {}\ninitial: {}\nunits: {{length: mm, angle: degree}}\n"
      "density: {}\nfriction: {}\nsolids:\n",
      name, initial, Between(random, 100, 5000), OneOf(random, std::array{0.1, 0.15, 0.25, 0.4}));
}

// Returns the file of a plate with the shaft below it. It may have a handle above it, and an arm at
// its side.
std::string PegText(RandomStream& random, const Shaft& shaft) {
  const auto overhang = [&] { return random.Index(2) == 0 ? 0.0 : random.Uniform(2, 20); };
  const Vector3 low(-shaft.half_x - overhang(), -shaft.half_y - overhang(), 0);
  const Vector3 high(shaft.half_x + overhang(), shaft.half_y + overhang(), random.Uniform(8, 40));
  std::string text = PartHead(random, "peg", "P") + BoxText("plate", low, high);
  text += BoxText("shaft", {-shaft.half_x, -shaft.half_y, -shaft.length},
                  {shaft.half_x, shaft.half_y, 0});
  if (random.Index(2) == 0) {
    const Vector3 half(random.Uniform(8, 25), random.Uniform(8, 25), 0);
    const Vector3 top(0, 0, high.z() + random.Uniform(15, 60));
    text += BoxText("handle", Vector3(0, 0, high.z()) - half, top + half);
  }
  if (random.Index(3) == 0) {
    text += BoxText("arm", {high.x() - 2, -4, 0}, {high.x() + random.Uniform(10, 80), 6, 8});
  }
  return text +
         "features:\n  1: {face: plate, normal: +z, what: top}\n"
         "  7: {shaft: shaft, axis: -z, what: shaft}\n";
}

// Returns the file of a block with the hole in its upper side, at z = `height`.
std::string BlockText(RandomStream& random, const Shaft& shaft, double height) {
  const auto margin = [&] { return random.Uniform(6, 45); };
  const double floor = height - shaft.length - random.Uniform(2, 8);
  std::string text = PartHead(random, "block", "B");
  text += BoxText("body", {-shaft.half_x - margin(), -shaft.half_y - margin(), 0},
                  {shaft.half_x + margin(), shaft.half_y + margin(), height});
  text += fmt::format(
      "pockets:\n  hole: {{cut_from: body, box: [[{}, {}, {}], [{}, {}, {}]], widen: [x, y]}}\n",
      -shaft.half_x, -shaft.half_y, floor, shaft.half_x, shaft.half_y, height);
  return text +
         "features:\n  1: {face: body, normal: +z, what: top}\n"
         "  7: {hole: hole, axis: +z, what: hole}\nstable_poses: {flat: -z}\n";
}

std::string ScenarioText(RandomStream& random, const Shaft& shaft, double height,
                         const domain::PartModel& peg) {
  const std::array<const char*, 4> workcells = {"puma762-table", "puma762-table", "ur5e-table",
                                                "iiwa7-table"};
  const double scale = Between(random, 0.02, 0.5);
  const auto error = [&](double most) { return scale * random.Uniform(0, most); };
  const auto& poses = peg.stable_poses();
  std::string text = fmt::format(
      "format: assay-scenario/1\nunits: {{length: mm, angle: degree}}\nclearance: {}\n"
      "workcell: {}\nrules: {{pad_friction: {}, grip_force: {}}}\nsensing: []\nparts:\n",
      Between(random, 0.3, 2), OneOf(random, workcells),
      OneOf(random, std::array{0.1, 0.15, 0.2, 0.3}), random.Uniform(30, 150));
  text += fmt::format(
      "  block:\n    model: block\n    pose: {{stable: flat, at: [550, 150], yaw: {}}}\n",
      random.Uniform(-180, 180));
  text += fmt::format("    error: {{x: {}, y: {}, z: {}, theta: {}}}\n", error(1), error(1),
                      error(0.3), error(0.5));
  text += fmt::format(
      "  peg:\n    model: peg\n    pose: {{stable: {}, at: [500, -200], yaw: {}}}\n",
      poses[random.Index(static_cast<int>(poses.size()))].label, random.Uniform(-180, 180));
  text += fmt::format("    error: {{x: {}, y: {}, z: {}, theta: {}}}\n", error(3), error(3),
                      error(1), error(2));
  text += fmt::format("gripper: {{error: {{x: {}, y: {}, z: {}, theta: {}}}}}\n", error(0.3),
                      error(0.3), error(0.3), error(0.2));
  return text + fmt::format(
                    "goal:\n  - assembled: {{held: peg, fixed: block, features: [[7], [7]], "
                    "mating_vector: [0, 0, {}],\n"
                    "      pose: {{columns: [[1, 0, 0], [0, 1, 0], [0, 0, 1], [0, 0, {}]]}}}}\n",
                    -shaft.length - 15, height);
}

struct Scene {
  std::string peg;
  std::string block;
  std::string scenario;

  std::string Text(int number) const {
    return fmt::format("seed {}, scene {}\n{}\n{}\n{}\n", kSeed, number, peg, block, scenario);
  }
};

// Returns the problem of a random scene. Returns none if the program refuses one of its files.
std::optional<domain::Problem> ProblemOf(Scene& scene, RandomStream& random, int number) {
  const fs::path models = ModelsWithPart(fmt::format("random-mating-{}", number), "peg");
  fs::create_directories(models / "parts/block");
  const double half = random.Uniform(4, 22);
  const Shaft shaft{half, random.Index(2) == 0 ? half : random.Uniform(4, 22),
                    random.Uniform(8, 60)};
  const double height = shaft.length + random.Uniform(12, 50);
  scene.peg = PegText(random, shaft);
  scene.block = BlockText(random, shaft, height);
  std::ofstream(models / "parts/peg/part.yaml") << scene.peg;
  std::ofstream(models / "parts/block/part.yaml") << scene.block;
  try {
    const auto peg = domain::PartFile::Read(Document::Parse(scene.peg, "part.yaml"), 0.001);
    scene.scenario = ScenarioText(random, shaft, height, *peg);
    return domain::ReadProblem(Document::Parse(scene.scenario, "mating.yaml"), models);
  } catch (const InputError&) {
    return {};
  }
}

TEST(RandomMatings, WhatIsProvedKeepsToItAtTheCorners) {
  const int corners = Asked("ASSAY_RANDOM_MATINGS_CORNERS", 1);
  const int first = Asked("ASSAY_RANDOM_MATINGS_FIRST", 0);
  const int scenes = Asked("ASSAY_RANDOM_MATINGS", 5);
  int proved = 0;
  for (int number = first; number < first + scenes; ++number) {
    RandomStream random(kSeed, fmt::format("random mating {}", number));
    Scene scene;
    auto problem = ProblemOf(scene, random, number);
    if (!problem) continue;
    const Planned planned =
        PlanFor(*std::move(problem), {.partial_plans = 20'000}, {.snapshots = 1'000});
    if (!planned.is_proved) continue;
    ++proved;
    std::cout << "scene " << number << " is proved\n" << std::flush;
    ExpectToKeepItsCertificate(planned, kSeed, corners, scene.Text(number));
  }
  EXPECT_GT(proved, 0);
  std::cout << proved << " of " << scenes << " scenes are proved\n";
}

}  // namespace
}  // namespace assay::check::random_matings_test
