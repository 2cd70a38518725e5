#include "planner/domain/parts/occlusion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/domain/actions/condition.h"
#include "planner/domain/matings/mating_classes.h"
#include "planner/domain/problem/problem_file.h"
#include "planner/geometry/pose.h"

namespace assay::domain::occlusion_test {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

Problem Read(const std::string& parts, const std::string& goal) {
  const std::string text =
      "format: assay-scenario/1\nunits: {length: inch, angle: degree}\n"
      "workcell: puma762-table\nparts:\n" +
      parts + "goal:\n" + goal;
  return ReadProblem(Document::Parse(text, "scenario.yaml"),
                     std::string(ASSAY_SOURCE_DIR) + "/models");
}

constexpr char kMating[] =
    "  - assembled: {held: peg, fixed: block, features: [[7, 8], [7, 8]],\n"
    "      pose: {columns: [[-1, 0, 0], [0, 1, 0], [0, 0, -1], [3, 0, 3.25]]},\n"
    "      mating_vector: [-4, 0, 0]}\n";
constexpr char kPeg[] = "  peg: {model: peg, pose: {stable: on-side, at: [20, -8], yaw: -120}}\n";

// The block lies on its back on two flat bricks that are 2 inches high. Its x axis points up.
constexpr char kStacked[] =
    "  left: {model: brick, pose: {stable: flat, at: [24, 8], yaw: 0}}\n"
    "  right: {model: brick, pose: {stable: flat, at: [24, 3], yaw: 0}}\n"
    "  block: {model: block, pose: {columns: [[0, 0, 1], [-1, 0, 0], [0, -1, 0], [24, 8.75, "
    "2]]}}\n";

std::string StackedOn(const std::string& flat) {
  std::string text = kStacked;
  for (auto at = text.find("flat"); at != std::string::npos; at = text.find("flat")) {
    text.replace(at, 4, flat);
  }
  return text;
}

// Returns the stable pose in which the brick is two inches high.
std::string FlatBrick() {
  const Problem problem = Read(
      std::string(kPeg) + "  brick: {model: brick, pose: {stable: BRP1, at: [28, 0], yaw: 0}}\n",
      "  - located: {part: brick, stable: [BRP1]}\n");
  for (const Part& part : problem.parts) {
    if (part.name != "brick") continue;
    for (const StablePose& pose : part.model->stable_poses()) {
      double top = 0;
      for (const Vector3& vertex : part.model->corners()) {
        top = std::max(top, (pose.X_TablePart * vertex).z());
      }
      if (top < 0.0509) return pose.label;
    }
  }
  return "";
}

TEST(Occlusion, OnTheTableItIsWhatTheStablePoseHides) {
  const Problem problem =
      Read(std::string(kPeg) +
               "  block: {model: block, pose: {stable: on-back, at: [24, 5], yaw: 30}}\n",
           kMating);
  for (std::size_t p = 0; p < problem.parts.size(); ++p) {
    const Part& part = problem.parts[p];
    for (const StablePose& pose : part.model->stable_poses()) {
      const Pose X_WorldPart =
          Placement{.x = 0.6, .y = 0.1, .yaw = 0.7}.X_WorldTable() * pose.X_TablePart;
      EXPECT_EQ(OccludedFeatures(problem, PartId(p), X_WorldPart, {}), pose.hidden) << pose.label;
      EXPECT_THAT(
          OccludedFeatures(problem, PartId(p), geometry::Translation(0, 0, 0.1) * X_WorldPart, {}),
          IsEmpty());
    }
  }
}

TEST(Occlusion, ABlockOnBricksIsInTheClassOfItsStablePose) {
  const Problem problem = Read(kPeg + StackedOn(FlatBrick()), kMating);
  for (const Part& part : problem.parts) {
    if (part.name != "block") continue;
    EXPECT_TRUE(part.resting.IsNone());
    EXPECT_THAT(part.hidden, ElementsAre(FeatureNumber(2)));
    ASSERT_FALSE(part.position_class.IsNone());
    EXPECT_EQ(part.model->stable_poses()[part.position_class.index()].name, "on-back");
    EXPECT_THAT(PositionList(problem, problem.matings[0]), Contains(InitialLabel(part)));
  }
}

}  // namespace
}  // namespace assay::domain::occlusion_test
