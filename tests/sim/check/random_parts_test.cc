#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <iostream>
#include <optional>
#include <utility>
#include <vector>

#include "planner/base/random.h"
#include "planner/domain/parts/part_file.h"
#include "tests/sim/check/random_scenes.h"

// Checks all that certificates claim about parts of random shapes, which are picked up in one
// stable pose and put down in another one.
namespace assay::check::random_parts_test {
namespace {

constexpr std::uint64_t kSeed = 27;

// For a longer test: ASSAY_RANDOM_PARTS=500 scenes, and ASSAY_RANDOM_PARTS_CORNERS=20 corners of
// each proved one. ASSAY_RANDOM_PARTS_FIRST=160 leaves out the scenes before this one.

// Returns the file of a block with up to three arms, which are boxes that stick out of its sides.
std::string PartText(RandomStream& random) {
  const Vector3 half(random.Uniform(6, 35), random.Uniform(10, 45), random.Uniform(8, 60));
  std::string text =
      "format: assay-part/1\nname: part\ninitial: Z\nunits: {length: mm, angle: degree}\n";
  text += fmt::format("density: {}\n", std::pow(10, random.Uniform(1.5, 4)));
  text += fmt::format("friction: {}\n", OneOf(random, std::array{0.1, 0.15, 0.25, 0.4}));
  text += "solids:\n" + BoxText("block", -half, half);
  const int arms = OneOf(random, std::array{0, 1, 1, 2, 3});
  for (int arm = 0; arm < arms; ++arm) {
    const int axis = random.Index(3);
    const double side = random.Index(2) == 0 ? -1 : 1;
    Vector3 middle;
    Vector3 extent;
    for (const int i : {0, 1, 2}) {
      middle[i] = random.Uniform(-half[i], half[i]);
      extent[i] = random.Uniform(2, 25);
    }
    extent[axis] = random.Uniform(5, 60);
    middle[axis] = side * (half[axis] - 2 + extent[axis]);  // 2 mm of the arm are in the block
    text += BoxText(fmt::format("arm{}", arm), middle - extent, middle + extent);
  }
  return text + "features:\n  1: {face: block, normal: +z, what: top}\n";
}

std::string ScenarioText(RandomStream& random, const domain::PartModel& model) {
  const auto& poses = model.stable_poses();
  const int start = random.Index(static_cast<int>(poses.size()));
  std::string goals;
  for (int pose = 0; pose < static_cast<int>(poses.size()); ++pose) {
    if (pose != start) goals += (goals.empty() ? "" : ", ") + poses[pose].label;
  }
  const double scale = std::pow(10, random.Uniform(-1, 0.6));
  const auto error = [&](std::array<double, 3> factors, double most) {
    return std::min(most, scale * OneOf(random, factors));
  };
  const std::array<const char*, 5> workcells = {"puma762-table", "ur5e-table", "iiwa7-table",
                                                "ur5e-wsg50", "two-tables"};
  std::string text = "format: assay-scenario/1\nunits: {length: mm, angle: degree}\nclearance: 1\n";
  text += fmt::format("workcell: {}\n", OneOf(random, workcells));
  text += fmt::format("rules: {{pad_friction: {}, grip_force: {}}}\n",
                      OneOf(random, std::array{0.08, 0.1, 0.15, 0.2, 0.5}),
                      OneOf(random, std::array{20, 40, 60, 80}));
  text += "parts:\n  part:\n    model: part\n";
  text += fmt::format("    pose: {{stable: {}, at: [600, {}], yaw: {}}}\n", poses[start].label,
                      OneOf(random, std::array{-250, 200}), random.Uniform(-180, 180));
  text += fmt::format("    error: {{x: {}, y: {}, z: {}, theta: {}}}\n", error({0, 1, 1}, 4),
                      error({0, 1, 1}, 4), error({0, 1, 3}, 2.5), error({0, 1, 3}, 5));
  text += "gripper:\n";
  text += fmt::format("  error: {{x: {}, y: {}, z: {}, theta: {}}}\n", random.Uniform(0, 0.5),
                      random.Uniform(0, 0.5), random.Uniform(0, 0.5), random.Uniform(0, 0.5));
  return text + "sensing: []\ngoal:\n  - located: {part: part, stable: [" + goals + "]}\n";
}

struct Scene {
  std::string part;
  std::string scenario;
};

// Returns the problem of a scene, whose files are put into a folder for models. Returns none if the
// part rests in one pose only, or if the program refuses a file: arms may cover the whole top of
// the block, or reach beyond the table.
std::optional<domain::Problem> ProblemOf(Scene& scene, RandomStream& random,
                                         const std::filesystem::path& models) {
  try {
    const Document part = Document::Parse(scene.part, "part.yaml");
    const auto model = domain::PartFile::Read(part, 0.001);
    if (model->stable_poses().size() < 2) return {};
    std::ofstream(models / "parts/part/part.yaml") << scene.part;
    scene.scenario = ScenarioText(random, *model);
    return domain::ReadProblem(Document::Parse(scene.scenario, "random.yaml"), models);
  } catch (const InputError&) {
    return {};
  }
}

TEST(RandomParts, WhatIsProvedKeepsToItAtTheCorners) {
  const int corners = Asked("ASSAY_RANDOM_PARTS_CORNERS", 1);
  const int first = Asked("ASSAY_RANDOM_PARTS_FIRST", 0);
  const int scenes = Asked("ASSAY_RANDOM_PARTS", 28);
  int proved = 0;
  for (int number = first; number < first + scenes; ++number) {
    RandomStream random(kSeed, fmt::format("random part {}", number));
    Scene scene{.part = PartText(random), .scenario = {}};
    auto problem =
        ProblemOf(scene, random, ModelsWithPart(fmt::format("random-{}", number), "part"));
    if (!problem) continue;
    const Planned planned = PlanFor(*std::move(problem), {.partial_plans = 20'000});
    if (!planned.is_proved) continue;
    ++proved;
    std::cout << "scene " << number << " is proved\n" << std::flush;
    ExpectToKeepItsCertificate(
        planned, kSeed, corners,
        fmt::format("seed {}, scene {}\n{}\n{}\n", kSeed, number, scene.part, scene.scenario));
  }
  EXPECT_GT(proved, 0);
  std::cout << proved << " of " << scenes << " scenes are proved\n";
}

}  // namespace
}  // namespace assay::check::random_parts_test
