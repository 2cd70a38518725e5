#include "planner/uncertainty/standing/dragging.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>

#include "planner/domain/parts/part_file.h"
#include "planner/geometry/pose.h"
#include "planner/uncertainty/error_sets/possible_masses.h"
#include "planner/uncertainty/standing/support.h"
#include "tests/planner/uncertainty/part_on_table.h"
#include "tests/scratch_file.h"

namespace assay::uncertainty::dragging_test {
namespace {

using geometry::Vector2;

constexpr double kThick = 0.005;  // of the sheet, metres

std::shared_ptr<const domain::PartModel> Sheet(double friction) {
  const std::filesystem::path folder = ScratchFile("sheet");
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "part.yaml") << fmt::format(R"(format: assay-part/1
name: sheet
initial: S
units: {{length: mm, angle: degree}}
density: 700
friction: {}
solids: {{body: {{box: [[-150, -100, 0], [150, 100, 5]]}}}}
features:
  1: {{face: body, normal: +z, what: top}}
stable_poses: {{flat: -z}}
)",
                                                     friction);
  return domain::PartFile::Load(folder / "part.yaml", 0);
}

// Spar's block stands on a sheet, with another block beside it. A third block stands on the table.
struct BlockOnSheet {
  domain::Problem problem = UprightBlock({0, 0, 0});
  domain::MatingId mating{0};
  PartId bystander = Add("bystander", problem.part(kBlock).model, {0.7, 0.1, kThick});
  PartId far = Add("far", problem.part(kBlock).model, {0.6, -0.4, 0});
  PartId sheet;

  explicit BlockOnSheet(double friction) {
    for (domain::Part& part : problem.parts) part.error = {};
    problem.parts[kBlock.index()].X_WorldPart.translation().z() = kThick;
    problem.gripper_error.theta = {-0.01, 0.01};
    sheet = Add("sheet", Sheet(friction), {0.64, 0.14, 0});
  }

  PartId Add(const std::string& name, std::shared_ptr<const domain::PartModel> model,
             const Vector3& at) {
    domain::Part part = problem.part(kBlock);
    part.name = name;
    part.model = std::move(model);
    part.X_WorldPart = geometry::Translation(at.x(), at.y(), at.z());
    problem.parts.push_back(part);
    return PartId(static_cast<int>(problem.parts.size()) - 1);
  }

  // Returns what a peg drags along that comes in a hand that leans and errs about its approach
  // vector.
  std::vector<Drag> Drags() const {
    UncertainWorld world(problem, Propagation::kSound);
    world.SetHeld(problem.mating(mating).held, {.x = 0, .z = 0});
    const geometry::Pose turned(Eigen::AngleAxisd(0.3, Vector3(1, 2, 3).normalized()));
    return DragsOf(world, mating, {"leaning", turned, 0.05}, world.DrawManipulator());
  }
};

// The push must overcome one of two frictions: between block and sheet, under the weight of the
// block, or between sheet and table, under the weight of both.
TEST(Sliding, TheSmootherOfTwoLayersSlides) {
  for (const double friction : {0.02, 0.3, 0.9}) {
    const BlockOnSheet scene(friction);
    const UncertainWorld world(scene.problem, Propagation::kSound);
    const double block = GreatestWeight(scene.problem, kBlock);
    const double own = scene.problem.part(kBlock).model->friction();
    const double upper = std::max(own, friction) * (7 + block);
    const double lower = friction * (7 + block + GreatestWeight(scene.problem, scene.sheet));
    EXPECT_NEAR(SlidingRatio(world, kBlock, {{{}, 7, 3}}), 3 / std::min(upper, lower), 1e-9)
        << friction;
  }
}

TEST(Dragging, ASmoothSheetMovesWithAllThatStandsOnIt) {
  const BlockOnSheet scene(0.02);
  const std::vector<Drag> drags = scene.Drags();
  ASSERT_EQ(drags.size(), 3);
  EXPECT_EQ(drags.front().part, kBlock);
  EXPECT_GT(ReachOfDrag(scene.problem, drags, scene.sheet), 0);
  EXPECT_GT(ReachOfDrag(scene.problem, drags, scene.bystander), 0);
  EXPECT_EQ(ReachOfDrag(scene.problem, drags, scene.far), 0);
  EXPECT_TRUE(BlockOnSheet(0.9).Drags().empty()) << "a rough sheet stays where it is";
}

// The fixed part moves by any displacement and turn within its bounds. What moves rigidly with it
// stays within its own bounds.
TEST(Dragging, BoundsContainRigidMotions) {
  const BlockOnSheet scene(0.02);
  const std::vector<Drag> drags = scene.Drags();
  ASSERT_FALSE(drags.empty());
  const auto at = [&](PartId part) -> Vector2 {
    return scene.problem.part(part).X_WorldPart.translation().head<2>();
  };
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(-1, 1);
  for (int i = 0; i < 1000; ++i) {
    const double turn = share(random) * drags.front().turn;
    const double direction = share(random) * 3.2;
    const Vector2 moved = drags.front().way * Vector2(std::cos(direction), std::sin(direction));
    for (const Drag& drag : drags) {
      const Vector2 arm = at(drag.part) - at(kBlock);
      const Vector2 off = moved + Eigen::Rotation2Dd(turn) * arm - arm;
      EXPECT_LE(off.cwiseAbs().maxCoeff(), drag.way * (1 + 1e-12));
      EXPECT_LE(std::abs(turn), drag.turn);
    }
  }
}

}  // namespace
}  // namespace assay::uncertainty::dragging_test
