#include "planner/motion/collision/collision_scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "planner/domain/workcell/workcell_file.h"
#include "planner/geometry/collision.h"
#include "planner/geometry/pose.h"
#include "tests/planner/motion/arm_scene.h"

namespace assay::motion::collision_scene_test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

BodyId Find(const CollisionScene& scene, const std::string& name) {
  for (std::size_t i = 0; i < scene.bodies().size(); ++i) {
    if (scene.bodies()[i].name == name) return BodyId(i);
  }
  return BodyId::None();
}

bool IsTested(const CollisionScene& scene, const std::string& a, const std::string& b) {
  const BodyId first = Find(scene, a);
  const BodyId second = Find(scene, b);
  return std::ranges::any_of(scene.pairs(), [&](const BodyPair& pair) {
    return pair == BodyPair{first, second} || pair == BodyPair{second, first};
  });
}

TEST(CollisionScene, HomeIsFree) {
  for (const Surroundings& surroundings : {PartsAtTheStart(), PegInTheHand()}) {
    const CollisionScene scene(Clutter(), surroundings);
    const Nearness nearest = scene.Nearest(scene.workcell().home());
    EXPECT_GT(nearest.distance, 0.01) << scene.Describe(nearest.pair);
  }
}

TEST(CollisionScene, WhatMayTouchIsNotTested) {
  const CollisionScene scene(Clutter(), PegInTheHand());
  EXPECT_FALSE(IsTested(scene, "peg", "fingers"));
  EXPECT_FALSE(IsTested(scene, "peg", "hand"));
  EXPECT_FALSE(IsTested(scene, "block", "table"));
  EXPECT_FALSE(IsTested(scene, "upper_arm", "forearm"));
  EXPECT_TRUE(IsTested(scene, "peg", "table"));
  EXPECT_TRUE(IsTested(scene, "peg", "brick"));
  EXPECT_TRUE(IsTested(scene, "peg", "forearm"));
  EXPECT_TRUE(IsTested(scene, "hand", "upper_arm"));
  EXPECT_TRUE(IsTested(scene, "upper_arm", "table"));
  EXPECT_TRUE(IsTested(scene, "forearm", "floor"));
}

// The tool is lowered over the brick until the pads are inside it. The pair is hand or finger and
// brick.
TEST(CollisionScene, NamesThePairThatTouches) {
  const CollisionScene scene(Clutter(), PartsAtTheStart(0));
  const domain::Workcell& workcell = scene.workcell();
  const Pose X_WorldBrick = Clutter().part(PartId(2)).X_WorldPart;
  const double height = X_WorldBrick.translation().z();
  const Pose down = geometry::Translation(X_WorldBrick.translation().x(),
                                          X_WorldBrick.translation().y(), height) *
                    geometry::RotationX(M_PI);
  const auto solutions = workcell.arm().Inverse(workcell.FlangeFor(down));
  ASSERT_FALSE(solutions.empty());
  const Nearness nearest = scene.Nearest(solutions[0].q);
  EXPECT_EQ(nearest.distance, 0);
  EXPECT_THAT(scene.Describe(nearest.pair), ::testing::HasSubstr("brick"));
}

// Oracle: hand and fingers against each part by boxes alone, as the executor measures.
TEST(CollisionScene, HandAndPartsAgreeWithTheirBoxes) {
  const CollisionScene scene(Clutter(), PartsAtTheStart(0.05));
  const domain::Workcell& workcell = scene.workcell();
  const geometry::CollisionShape hand = workcell.HandShape(0.05);
  RandomStream random(71, "hand");
  for (int i = 0; i < 100; ++i) {
    const JointVector q = RandomPosture(scene.arm(), random);
    const LinkPoses X_BaseLink = scene.arm().LinkPoses(q);
    const Pose X_WorldTool =
        workcell.X_WorldBase() * X_BaseLink.back() * workcell.gripper().X_FlangeTool();
    for (const domain::Part& part : Clutter().parts) {
      const BodyId id = Find(scene, part.name);
      const double boxes = Distance(hand, X_WorldTool, part.model->shape(), part.X_WorldPart);
      const double bodies =
          std::min(scene.Separation({id, Find(scene, "hand")}, X_BaseLink, kInfinity),
                   scene.Separation({id, Find(scene, "fingers")}, X_BaseLink, kInfinity));
      EXPECT_NEAR(bodies, boxes, 1e-6);
    }
  }
}

TEST(CollisionScene, SeparationOnlyPrunesBeyondEnough) {
  const CollisionScene scene(Clutter(), PartsAtTheStart());
  RandomStream random(72, "enough");
  for (int i = 0; i < 20; ++i) {
    const LinkPoses X_BaseLink = scene.arm().LinkPoses(RandomPosture(scene.arm(), random));
    for (const BodyPair& pair : scene.pairs()) {
      const double whole = scene.Separation(pair, X_BaseLink, kInfinity);
      const double enough = random.Uniform(0, 0.3);
      const double pruned = scene.Separation(pair, X_BaseLink, enough);
      if (whole < enough) {
        EXPECT_NEAR(pruned, whole, 1e-9);
      } else {
        EXPECT_GE(pruned, enough);
      }
    }
  }
}

// Law: no point of a body moves more than the stated bound, seen from the other body.
TEST(CollisionScene, NoVertexMovesMoreThanIsSaid) {
  const CollisionScene scene(Clutter(), PegInTheHand());
  RandomStream random(73, "motion");
  for (int i = 0; i < 50; ++i) {
    const JointVector from = RandomPosture(scene.arm(), random);
    JointVector to = from;
    for (int j = 0; j < 6; ++j) to[j] += random.Index(2) * random.Uniform(-0.5, 0.5);
    const LinkPoses before = scene.arm().LinkPoses(from);
    const LinkPoses after = scene.arm().LinkPoses(to);
    for (const BodyPair& pair : scene.pairs()) {
      const double greatest = scene.GreatestMotion(pair, (to - from).cwiseAbs());
      const int a = scene.body(pair.first).link;
      const int b = scene.body(pair.second).link;
      const Pose X_AB_before = before[a].inverse() * before[b];
      const Pose X_AB_after = after[a].inverse() * after[b];
      for (const RoundedHull& hull : scene.body(pair.second).hulls) {
        for (const Vector3& p : hull.vertices()) {
          EXPECT_LE((X_AB_after * p - X_AB_before * p).norm(), greatest + 1e-12);
        }
      }
    }
  }
}

// Law: the distance of two arms at their homes does not depend on which of them acts.
TEST(CollisionScene, AnotherRobotStandsAtItsHome) {
  domain::Problem problem = Clutter();
  problem.parts.clear();
  problem.workcell =
      domain::WorkcellFile::Read(ASSAY_SOURCE_DIR "/models/workcells/two-pumas/workcell.yaml");
  const domain::Problem turned = WorkedBy(problem, domain::RobotId(1));
  const double opening = problem.workcell->gripper().max_opening();
  const CollisionScene left(problem, {.opening = opening});
  const CollisionScene right(turned, {.opening = opening});
  EXPECT_TRUE(IsTested(left, "forearm", "hand of right"));
  EXPECT_FALSE(IsTested(left, "hand of right", "table"));
  const auto apart = [](const CollisionScene& scene, const std::string& own,
                        const std::string& of) {
    return scene.Separation({Find(scene, of), Find(scene, own)},
                            scene.arm().LinkPoses(scene.workcell().home()), kInfinity);
  };
  for (const char* a : {"base", "upper_arm", "forearm", "hand"}) {
    for (const char* b : {"base", "upper_arm", "forearm", "hand", "fingers"}) {
      EXPECT_NEAR(apart(left, a, std::string(b) + " of right"),
                  apart(right, b, std::string(a) + " of left"), 1e-6)
          << a << ", " << b;
    }
  }
}

}  // namespace
}  // namespace assay::motion::collision_scene_test
