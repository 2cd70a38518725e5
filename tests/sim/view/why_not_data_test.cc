#include "sim/view/why_not_data.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <numbers>

#include "planner/geometry/pose.h"
#include "planner/motion/paths/straight_line.h"
#include "tests/sim/view/viewed_execution.h"

namespace assay::view::why_not_data_test {
namespace {

using Json = nlohmann::ordered_json;

const domain::Problem& Problem() { return Figure15().scenario.problem; }

domain::PartId PartNamed(const std::string& name) {
  for (std::size_t i = 0; i < Problem().parts.size(); ++i) {
    if (Problem().parts[i].name == name) return domain::PartId(i);
  }
  return domain::PartId::None();
}

Json ShownOf(const plan::Situation& situation) {
  const Json all =
      WhyNotOf({{"Reasons", {{"a sentence", situation}}}}, Problem(), Figure15().scene);
  return all[0]["reasons"][0];
}

geometry::Vector3 PositionOf(const Json& shown, const std::string& body) {
  for (const Json& ghost : shown["ghosts"]) {
    if (ghost["body"] != body) continue;
    return {ghost["pose"][0].get<double>(), ghost["pose"][1].get<double>(),
            ghost["pose"][2].get<double>()};
  }
  ADD_FAILURE() << "no ghost of " << body;
  return geometry::Vector3::Zero();
}

TEST(WhyNotData, ASentenceAloneIsJustASentence) {
  const Json all =
      WhyNotOf({{"Limits", {{.text = "one"}, {.text = "two"}}}}, Problem(), Figure15().scene);
  EXPECT_EQ(all, Json::parse(R"([{"title": "Limits", "reasons": [{"text": "one"},
                                                                 {"text": "two"}]}])"));
}

// A part that is where it starts needs no ghost.
TEST(WhyNotData, PartsAreDrawnWhereTheyAreNot) {
  const domain::PartId peg = PartNamed("peg");
  const domain::PartId block = PartNamed("block");
  const Json shown = ShownOf({.parts = {{peg, geometry::Translation(0.5, 0.1, 0.2)},
                                        {block, Problem().part(block).X_WorldPart}}});
  EXPECT_EQ(shown["ghosts"].size(), 1u);
  EXPECT_TRUE(PositionOf(shown, "part/peg").isApprox(geometry::Vector3(0.5, 0.1, 0.2)));
  EXPECT_EQ(shown["marked"], Json({"part/block"}));
}

// The hand is drawn at a pose that no arm needs to reach. The middle between the fingers moves
// along with the tool.
TEST(WhyNotData, AHandIsDrawnAtItsPose) {
  const auto shown_at = [](const geometry::Pose& X_WorldTool) {
    return ShownOf({.hand = plan::PlacedHand{domain::RobotId(0), X_WorldTool, 0.04, {}}});
  };
  const geometry::Pose down = geometry::RotationX(std::numbers::pi);
  const Json near = shown_at(down);
  const Json far = shown_at(geometry::Translation(5, 6, 7) * down);
  EXPECT_EQ(near["ghosts"].size(), 3u) << "the hand and two fingers";
  for (const char* body : {"gripper/hand", "gripper/finger_left", "gripper/finger_right"}) {
    EXPECT_LT((PositionOf(far, body) - PositionOf(near, body) - geometry::Vector3(5, 6, 7)).norm(),
              1e-5);
  }
  const geometry::Vector3 apart =
      PositionOf(near, "gripper/finger_left") - PositionOf(near, "gripper/finger_right");
  EXPECT_NEAR(apart.z(), 0, 1e-5) << "the tool points straight down";
}

// With a posture, the whole arm is drawn. What collides is marked by its name in the engine.
TEST(WhyNotData, AnArmIsDrawnInItsPosture) {
  const domain::Workcell& workcell = *Problem().workcell;
  const kinematics::JointVector q = workcell.home();
  const Json shown =
      ShownOf({.hand = plan::PlacedHand{domain::RobotId(0), motion::ToolAt(workcell, q), 0.04, q},
               .colliding = {{.robot = domain::RobotId(0), .piece = "forearm"},
                             {.part = PartNamed("block")},
                             {.robot = domain::RobotId(0), .piece = "fingers"},
                             {}},
               .excess = plan::Excess{domain::Dimension::kAngle, 0.5, 0.2}});
  EXPECT_GT(shown["ghosts"].size(), 6u);
  EXPECT_EQ(shown["marked"],
            Json({"arm/forearm", "part/block", "gripper/finger_left", "gripper/finger_right"}));
  EXPECT_EQ(shown["excess"], Json::parse(R"({"unit": "rad", "value": 0.5, "limit": 0.2})"));
  PositionOf(shown, "arm/forearm");
}

}  // namespace
}  // namespace assay::view::why_not_data_test
