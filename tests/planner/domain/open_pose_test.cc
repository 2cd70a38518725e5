#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/planner/domain/scenario.h"

namespace assay::domain::open_pose_test {
namespace {

std::string TextWith(const std::string& first, const std::string& second) {
  return "format: assay-scenario/1\nworkcell: puma762-table\nparts:\n  one: {model: brick, pose: " +
         first + "}\n  two: {model: brick, pose: " + second +
         "}\ngoal: [located: {part: one, stable: [upright]}]\n";
}

constexpr const char* kHere = "{stable: upright, at: [0.5, 0]}";
constexpr const char* kOpen =
    "{one-of: {near: {stable: upright, at: [0.5, 0.3]}, far: {stable: upright, at: [0.8, 0.3]}}}";
constexpr const char* kOpenToo =
    "{one-of: {left: {stable: upright, at: [0.5, 0]}, right: {stable: upright, at: [0.5, -0.3]}}}";

std::vector<Problem> WorldsOf(const std::string& text) {
  return ReadWorlds(Document::Parse(text, "scenario.yaml"), ModelsFolder(), {});
}

std::string ErrorOf(const std::string& text) {
  try {
    WorldsOf(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(OpenPose, WithoutOneThereIsOneWorld) {
  const std::vector<Problem> worlds = WorldsOf(TextWith(kHere, "{stable: upright, at: [0.8, 0]}"));
  ASSERT_EQ(worlds.size(), 1U);
  EXPECT_TRUE(worlds[0].open_poses.empty());
}

TEST(OpenPose, TheLastPartsPosesChangeFastest) {
  const std::vector<Problem> worlds = WorldsOf(TextWith(kOpenToo, kOpen));
  ASSERT_EQ(worlds.size(), 4U);
  std::vector<std::pair<int, int>> chosen;
  for (const Problem& world : worlds) {
    chosen.emplace_back(world.open_poses[0].chosen, world.open_poses[1].chosen);
  }
  EXPECT_EQ(chosen, (std::vector<std::pair<int, int>>{{0, 0}, {0, 1}, {1, 0}, {1, 1}}));
  EXPECT_DOUBLE_EQ(worlds[1].parts[1].X_WorldPart.translation().x(), 0.8);
  EXPECT_DOUBLE_EQ(worlds[2].parts[0].X_WorldPart.translation().y(), -0.3);
}

TEST(OpenPose, EveryWorldMustBeRight) {
  EXPECT_NE(ErrorOf(TextWith(kHere,
                             "{one-of: {a: {stable: upright, at: [0.8, 0]}, "
                             "b: {stable: upright, at: [0.5, 0]}}}"))
                .find("overlaps part 'one'"),
            std::string::npos);
  EXPECT_NE(ErrorOf(TextWith(kHere, "{one-of: {a: {stable: upright, at: [0.8, 0]}}}"))
                .find("scenario.yaml:5:"),
            std::string::npos);
}

}  // namespace
}  // namespace assay::domain::open_pose_test
