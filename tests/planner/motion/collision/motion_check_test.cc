#include "planner/motion/collision/motion_check.h"

#include <gtest/gtest.h>

#include "planner/geometry/pose.h"
#include "tests/planner/motion/arm_scene.h"
#include "tests/scenario_in.h"

namespace assay::motion::motion_check_test {
namespace {

double Tilt(const CollisionScene& scene, const JointVector& q) {
  const domain::Workcell& workcell = scene.workcell();
  const Pose X_WorldTool =
      workcell.X_WorldBase() * scene.arm().Forward(q) * workcell.gripper().X_FlangeTool();
  return std::acos(std::clamp(-X_WorldTool.linear()(2, 2), -1.0, 1.0));
}

// Oracle: a motion that is found to be free is free at steps of about a millimetre of the hand.
TEST(MotionCheck, WhatIsFreeIsFreeAtEveryStep) {
  const CollisionScene scene(Clutter(), PegInTheHand());
  MotionCheck check(scene, {.clearance = 0.01});
  RandomStream random(81, "free");
  int free = 0;
  for (int i = 0; i < 20; ++i) {
    const JointVector from = scene.workcell().home();
    const JointVector to =
        from + random.Uniform(0.1, 0.6) * (RandomPosture(scene.arm(), random) - from);
    if (check.FindObstruction(from, to)) continue;
    ++free;
    const int steps = static_cast<int>((to - from).cwiseAbs().sum() / 0.01);
    for (int k = 0; k <= steps; ++k) {
      const JointVector q = from + static_cast<double>(k) / steps * (to - from);
      ASSERT_TRUE(IsClear(scene, q, 0.01)) << i;
    }
  }
  EXPECT_GT(free, 5);
}

// An obstruction is at the place that is stated, or within the distance that is left undecided.
TEST(MotionCheck, WhatIsInTheWayIsThere) {
  const CollisionScene scene(Clutter(), PegInTheHand());
  MotionCheck check(scene, {.clearance = 0.01});
  RandomStream random(82, "obstructed");
  int obstructed = 0;
  for (int i = 0; i < 60; ++i) {
    const JointVector from = scene.workcell().home();
    const JointVector to = RandomPosture(scene.arm(), random);
    const auto obstruction = check.FindObstruction(from, to);
    if (!obstruction) continue;
    ++obstructed;
    ASSERT_EQ(obstruction->kind, Obstruction::Kind::kPair);
    const LinkPoses X_BaseLink = scene.arm().LinkPoses(obstruction->at);
    EXPECT_LE(scene.Separation(obstruction->pair, X_BaseLink, 1), 0.01 + MotionCheck::kUndecided);
  }
  EXPECT_GT(obstructed, 10);
}

// Wrist links 1 and 3 of the UR5e are always less than 10 mm from each other.
TEST(MotionCheck, AnArmNeedNotKeepItsOwnLinksFarFromEachOther) {
  const domain::Problem problem = ScenarioIn("ur5e-table", "spar-fig13");
  const JointVector home = problem.workcell->home();
  const CollisionScene scene(problem, {.opening = 0.05});
  MotionCheck check(scene, {.clearance = 0.015});
  EXPECT_FALSE(check.FindObstruction(home, home));
  const LinkPoses X_BaseLink = scene.arm().LinkPoses(home);
  EXPECT_TRUE(std::ranges::any_of(scene.pairs(), [&](const BodyPair& pair) {
    return scene.IsOfRobot(pair.first) && scene.IsOfRobot(pair.second) &&
           scene.Separation(pair, X_BaseLink, 0.015) < 0.015;
  }));
}

// A motion and its reverse are equally free.
TEST(MotionCheck, BackIsAsForth) {
  const CollisionScene scene(Clutter(), PartsAtTheStart());
  MotionCheck check(scene, {});
  RandomStream random(83, "back");
  for (int i = 0; i < 40; ++i) {
    const JointVector a = RandomPosture(scene.arm(), random);
    const JointVector b = a + 0.2 * (RandomPosture(scene.arm(), random) - a);
    EXPECT_EQ(check.FindObstruction(a, b).has_value(), check.FindObstruction(b, a).has_value());
  }
}

TEST(MotionCheck, LimitsOfTheJoints) {
  const CollisionScene scene(Clutter(), PartsAtTheStart());
  MotionCheck check(scene, {});
  JointVector beyond = scene.workcell().home();
  beyond[4] = scene.arm().limits()[4].upper + 0.01;
  const auto obstruction = check.FindObstruction(scene.workcell().home(), beyond);
  ASSERT_TRUE(obstruction.has_value());
  EXPECT_EQ(obstruction->kind, Obstruction::Kind::kLimits);
}

TEST(MotionCheck, UprightAtEveryStep) {
  const CollisionScene scene(Clutter(), PartsAtTheStart());
  const double tilt = 0.3;
  MotionCheck check(scene, {.clearance = 0, .upright = Upright{.tilt = tilt}});
  MotionCheck anyhow(scene, {.clearance = 0});
  RandomStream random(84, "upright");
  int upright = 0;
  for (int i = 0; i < 200; ++i) {
    const JointVector from = scene.workcell().home();
    const JointVector to = from + 0.2 * (RandomPosture(scene.arm(), random) - from);
    if (anyhow.FindObstruction(from, to)) continue;
    double greatest = 0;
    for (int k = 0; k <= 500; ++k)
      greatest = std::max(greatest, Tilt(scene, from + k / 500.0 * (to - from)));
    const auto obstruction = check.FindObstruction(from, to);
    if (!obstruction) {
      ++upright;
      EXPECT_LE(greatest, tilt + 1e-9);
    } else {
      EXPECT_GE(greatest, tilt - 0.01);
      EXPECT_EQ(obstruction->kind, Obstruction::Kind::kTilt);
    }
  }
  EXPECT_GT(upright, 5);
}

// A motion without length asks whether the arm may rest there.
// Returns surroundings in which every standing part is where one of its errors brings it: turned
// about the vertical through its origin, and moved in any direction.
Surroundings WithSomeErrors(Surroundings surroundings, RandomStream& random) {
  for (domain::PlacedPart& placed : surroundings.parts) {
    PlaceError& error = surroundings.errors[static_cast<std::size_t>(placed.part.index())];
    Pose& X_WorldPart = placed.X_WorldPart;
    X_WorldPart.linear() =
        geometry::RotationZ(error.turn * std::clamp(random.Uniform(-2, 2), -1.0, 1.0)).linear() *
        X_WorldPart.linear();
    const Vector3 way(random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 1));
    X_WorldPart.translation() += error.shift * way.normalized();
    error = {};
  }
  return surroundings;
}

// Returns whether some of many errors of the parts lets a body touch another on the motion.
bool TouchesWithSomeErrors(const Surroundings& surroundings, const JointVector& from,
                           const JointVector& to, RandomStream& random) {
  for (int i = 0; i < 40; ++i) {
    const CollisionScene scene(Clutter(), WithSomeErrors(surroundings, random));
    for (const double share : {0.0, random.Uniform(0, 0.2), random.Uniform(0, 1), 1.0}) {
      if (!IsClear(scene, from + share * (to - from), 1e-9)) return true;
    }
  }
  return false;
}

// Returns a posture in which the hand, or what it holds, is nearer than `distance` to a part.
JointVector RandomPostureNearAPart(const CollisionScene& scene, double distance,
                                   RandomStream& random) {
  while (true) {
    const JointVector q = RandomPostureAtTheTable(scene, 0.001, random);
    const Nearness nearest = scene.Nearest(q);
    const bool is_part = !scene.body(nearest.pair.first).identity.part.IsNone();
    if (is_part && scene.IsCarried(nearest.pair.second) && nearest.distance < distance) return q;
  }
}

// Errors may bring a part to the hand in the posture in which a motion begins. If the clearance is
// to be certain, such a motion is refused. Otherwise it is accepted, because the posture is given.
TEST(MotionCheck, CertainClearanceHoldsInGivenPostures) {
  constexpr double kShift = 0.02;
  RandomStream random(84, "given");
  int certain = 0;
  int uncertain = 0;
  for (int i = 0; i < 40; ++i) {
    Surroundings surroundings = PegInTheHand();
    surroundings.errors.resize(Clutter().parts.size());
    for (const domain::PlacedPart& placed : surroundings.parts) {
      surroundings.errors[static_cast<std::size_t>(placed.part.index())] = {
          .shift = kShift, .turn = random.Uniform(0, 0.5)};
    }
    const CollisionScene scene(Clutter(), surroundings);
    const JointVector from = RandomPostureNearAPart(scene, 0.04, random);
    const JointVector to = from + 0.01 * (RandomPosture(scene.arm(), random) - from);
    MotionRules rules = {.clearance = 0.005, .given = {from}};
    const bool is_free = !MotionCheck(scene, rules).FindObstruction(from, to);
    rules.certain_clearance = 0;
    const bool is_certain = !MotionCheck(scene, rules).FindObstruction(from, to);
    EXPECT_TRUE(is_free || !is_certain) << i;
    const bool touches = TouchesWithSomeErrors(surroundings, from, to, random);
    EXPECT_FALSE(is_certain && touches) << i;
    certain += is_certain;
    uncertain += is_free && touches;
  }
  EXPECT_GT(certain, 3);
  EXPECT_GT(uncertain, 3);
}

// The robot works on parts that it must touch. Their errors are the concern of other conditions.
TEST(MotionCheck, PartsAtWorkMayBeNearInGivenPostures) {
  Surroundings surroundings = PegInTheHand();
  surroundings.errors.assign(Clutter().parts.size(), {});
  const PartId block = surroundings.parts.front().part;
  surroundings.errors[static_cast<std::size_t>(block.index())].shift = 0.04;
  const CollisionScene scene(Clutter(), surroundings);
  RandomStream random(85, "work");
  JointVector q = scene.workcell().home();
  do {
    q = RandomPostureNearAPart(scene, 0.03, random);
  } while (scene.body(scene.Nearest(q).pair.first).identity.part != block);
  MotionRules rules = {.clearance = 0.005, .given = {q}, .certain_clearance = 0};
  EXPECT_TRUE(MotionCheck(scene, rules).FindObstruction(q, q));
  rules.at_work = {block};
  EXPECT_FALSE(MotionCheck(scene, rules).FindObstruction(q, q));
}

TEST(MotionCheck, RestIsAMotionOfNothing) {
  const CollisionScene scene(Clutter(), PartsAtTheStart());
  MotionCheck check(scene, {.clearance = 0.02});
  RandomStream random(85, "rest");
  for (int i = 0; i < 200; ++i) {
    const JointVector q = RandomPosture(scene.arm(), random);
    EXPECT_EQ(check.FindObstruction(q, q).has_value(), !IsClear(scene, q, 0.02));
  }
}

}  // namespace
}  // namespace assay::motion::motion_check_test
