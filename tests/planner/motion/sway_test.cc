#include "planner/motion/sway.h"

#include <gtest/gtest.h>

#include "planner/motion/motion_check.h"
#include "planner/motion/straight_line.h"
#include "tests/planner/motion/arm_scene.h"

namespace assay::motion::sway_test {
namespace {

constexpr double kStep = 0.02;  // metres

const domain::Workcell& Cell() { return *Clutter().workcell; }

// A line of some centimetres from a posture above the table.
std::optional<JointPath> RandomLine(const CollisionScene& scene, RandomStream& random) {
  const JointVector from = RandomPostureAtTheTable(scene, 0, random);
  const Vector3 to = ToolAt(Cell(), from).translation() +
                     Vector3(random.Uniform(-0.05, 0.05), random.Uniform(-0.05, 0.05), 0.05);
  const LineResult line = FollowLine(Cell(), from, to, kStep);
  if (!line.path) return std::nullopt;
  return line.path->q;
}

plan::ToolDoubt RandomDoubt(RandomStream& random) {
  const double size = random.Uniform(0, 1);
  return {.shift = size * Vector3(0.004, 0.004, 0.002), .turn = size * 0.06, .spin = size * 0.01};
}

Pose Off(const Pose& X_WorldTool, const plan::ToolDoubt& doubt, RandomStream& random) {
  const auto any = [&](double half) { return random.Uniform(-half, half); };
  Pose off = X_WorldTool;
  off.linear() = geometry::RotationZ(any(doubt.turn)).linear() * X_WorldTool.linear() *
                 geometry::RotationZ(any(doubt.spin)).linear();
  for (int axis = 0; axis < 3; ++axis) off.translation()[axis] += any(doubt.shift[axis]);
  return off;
}

double RoomAt(const JointVector& q) {
  double room = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 6; ++k) {
    const kinematics::JointLimits& limits = Cell().arm().limits()[k];
    room = std::min({room, q[k] - limits.lower, limits.upper - q[k]});
  }
  return room;
}

// Oracle: errors drawn at random at points between the looks. Bounds hold, and are mostly no more
// than four times what draws find.
TEST(Sway, BoundsWhatErrorsDoToTheJoints) {
  const CollisionScene scene(Clutter(), PartsAtTheStart());
  RandomStream random(91, "sway");
  int bounded = 0;
  int tight = 0;
  for (int i = 0; i < 60; ++i) {
    const auto path = RandomLine(scene, random);
    if (!path) continue;
    const plan::ToolDoubt doubt = RandomDoubt(random);
    const Sway sway = SwayAlong(Cell(), *path, doubt);
    if (!sway.is_bounded || sway.room <= 0) continue;
    ++bounded;
    JointVector seen = JointVector::Zero();
    for (int k = 0; k < 300; ++k) {
      const auto piece =
          static_cast<std::size_t>(random.Uniform() * static_cast<double>(path->size() - 1));
      const Pose a = ToolAt(Cell(), (*path)[piece]);
      Pose planned = a;
      planned.translation() +=
          random.Uniform() * (ToolAt(Cell(), (*path)[piece + 1]).translation() - a.translation());
      const auto q = PostureLike(Cell(), planned, (*path)[piece]);
      ASSERT_TRUE(q);
      const auto off = PostureLike(Cell(), Off(planned, doubt, random), *q);
      ASSERT_TRUE(off) << i;
      const JointVector turn = (*off - *q).cwiseAbs();
      ASSERT_TRUE((turn.array() <= sway.turn.array()).all()) << i << "\n"
                                                             << turn.transpose() << "\n"
                                                             << sway.turn.transpose();
      ASSERT_LE(sway.room, RoomAt(*off) + 1e-9);
      seen = seen.cwiseMax(turn);
    }
    if (sway.turn.maxCoeff() < 4 * seen.maxCoeff() + 1e-4) ++tight;
  }
  EXPECT_GT(bounded, 20);
  EXPECT_GT(tight, bounded / 2);
}

TEST(Sway, WithoutErrorsThereIsNone) {
  const CollisionScene scene(Clutter(), PartsAtTheStart());
  RandomStream random(92, "no error");
  std::optional<JointPath> path;
  while (!path) path = RandomLine(scene, random);
  const Sway sway = SwayAlong(Cell(), *path, {});
  ASSERT_TRUE(sway.is_bounded);
  EXPECT_LT(sway.turn.maxCoeff(), 1e-3);
}

// With axes 4 and 6 in line any error, however small, may turn joint 4 by half a turn.
TEST(Sway, IsNotBoundedNearSingularPostures) {
  JointVector wrist = Cell().home();
  wrist[4] = 0;
  EXPECT_FALSE(SwayAlong(Cell(), {wrist}, {}).is_bounded);
  EXPECT_TRUE(SwayAlong(Cell(), {Cell().home()}, {.shift = {0, 0, 0}, .turn = 0.05}).is_bounded);
}

TEST(Sway, RoomEndsWhereAJointEnds) {
  JointVector q = Cell().home();
  const double limit = Cell().arm().limits()[0].upper;
  q[0] = limit - 0.01;
  const Sway near = SwayAlong(Cell(), {q}, {});
  ASSERT_TRUE(near.is_bounded);
  EXPECT_GT(near.room, 0);
  EXPECT_LE(near.room, 0.01);
  const Sway beyond = SwayAlong(Cell(), {q}, {.shift = {0.02, 0.02, 0}});
  EXPECT_FALSE(beyond.is_bounded && beyond.room > 0);
}

// Oracle: wherever joints are within the sway of a motion that is free, links keep the clearance.
TEST(Sway, IsKeptClearOf) {
  const CollisionScene scene(Clutter(), PegInTheHand());
  constexpr double kClearance = 0.005;
  const JointVector sway = JointVector::Constant(0.02);
  MotionCheck check(scene,
                    {.clearance = kClearance, .sway = sway, .bodies = MotionRules::Bodies::kArm});
  RandomStream random(93, "clear of sway");
  int free = 0;
  for (int i = 0; i < 20; ++i) {
    const JointVector from = scene.workcell().home();
    const JointVector to =
        from + random.Uniform(0.1, 0.4) * (RandomPosture(scene.arm(), random) - from);
    if (check.FindObstruction(from, to)) continue;
    ++free;
    for (int k = 0; k < 200; ++k) {
      JointVector q = from + random.Uniform() * (to - from);
      for (int j = 0; j < 6; ++j) q[j] += random.Uniform(-sway[j], sway[j]);
      const LinkPoses X_BaseLink = scene.arm().LinkPoses(q);
      for (const BodyPair& pair : scene.pairs()) {
        if (scene.IsCarried(pair.second)) continue;
        ASSERT_GE(scene.Separation(pair, X_BaseLink, kClearance), kClearance) << i;
      }
    }
  }
  EXPECT_GT(free, 5);
}

}  // namespace
}  // namespace assay::motion::sway_test
