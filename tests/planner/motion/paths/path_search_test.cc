#include "planner/motion/paths/path_search.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/geometry/pose.h"
#include "planner/motion/collision/collision_scene.h"
#include "tests/planner/motion/arm_scene.h"

namespace assay::motion::path_search_test {
namespace {

using ::testing::HasSubstr;

constexpr double kClearance = 0.01;
constexpr double kRoom = 0.012;  // metres, clearance at the ends, more than is required

// Returns a posture with the tool upright above a place of the table.
JointVector Above(const CollisionScene& scene, double x, double y, double z) {
  const domain::Workcell& workcell = scene.workcell();
  const Pose X_WorldTool = geometry::Translation(x, y, z) * geometry::RotationX(M_PI);
  const kinematics::JointVector& home = workcell.home();
  const auto solutions = workcell.arm().Inverse(workcell.FlangeFor(X_WorldTool), home);
  for (const auto& solution : solutions) {
    if (solution.indicators != workcell.arm().IndicatorsOf(home)) continue;
    return workcell.arm().NearestInRange(solution.q, home).value();
  }
  return home;
}

double Tilt(const CollisionScene& scene, const JointVector& q) {
  const domain::Workcell& workcell = scene.workcell();
  const Pose X_WorldTool =
      workcell.X_WorldBase() * scene.arm().Forward(q) * workcell.gripper().X_FlangeTool();
  return std::acos(std::clamp(-X_WorldTool.linear()(2, 2), -1.0, 1.0));
}

// Calls `look` along the path at steps at which no body moves more than a millimetre.
template <class Look>
void AlongByMillimetres(const CollisionScene& scene, const JointPath& path, const Look& look) {
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const JointVector way = path[i + 1] - path[i];
    double motion = 0;
    for (const BodyPair& pair : scene.pairs()) {
      motion = std::max(motion, scene.GreatestMotion(pair, way.cwiseAbs()));
    }
    const int steps = static_cast<int>(std::ceil(motion / 1e-3));
    for (int k = 0; k <= steps; ++k) look(path[i] + static_cast<double>(k) / steps * way);
  }
}

// The parameter says whether the hand holds the peg.
class RandomQueries : public ::testing::TestWithParam<bool> {};

// Law and oracle: paths join the requested ends within the limits, and every pair of bodies is
// clear at every millimetre.
TEST_P(RandomQueries, ArePathsThatAreFree) {
  const CollisionScene scene(Clutter(), GetParam() ? PegInTheHand() : PartsAtTheStart());
  RandomStream random(101, "queries");
  for (int i = 0; i < 2; ++i) {
    const JointVector from = RandomPostureAtTheTable(scene, kRoom, random);
    const JointVector to = RandomPostureAtTheTable(scene, kRoom, random);
    const PathResult result =
        FindPath(scene, {.from = from, .to = to, .rules = {.clearance = kClearance}});
    const auto* path = std::get_if<JointPath>(&result);
    ASSERT_NE(path, nullptr) << std::get<PathFailure>(result).what;
    EXPECT_EQ(path->front(), from);
    EXPECT_EQ(path->back(), to);
    AlongByMillimetres(scene, *path, [&](const JointVector& q) {
      ASSERT_TRUE(scene.arm().InRange(q));
      ASSERT_TRUE(IsClear(scene, q, kClearance)) << i;
    });
  }
}

INSTANTIATE_TEST_SUITE_P(EmptyHandAndPeg, RandomQueries, ::testing::Bool());

// The brick stands between two low places of the tool, so the straight way goes through it.
TEST(PathSearch, GoesAroundTheBrickUpright) {
  const CollisionScene scene(Clutter(), PartsAtTheStart(0));
  const Vector3 brick = Clutter().part(PartId(2)).X_WorldPart.translation();
  const JointVector from = Above(scene, brick.x(), brick.y() + 0.22, 0.08);
  const JointVector to = Above(scene, brick.x(), brick.y() - 0.22, 0.08);
  const double tilt = 10 * M_PI / 180;
  const MotionRules rules{.clearance = kClearance, .upright = Upright{.tilt = tilt}};
  MotionCheck check(scene, rules);
  const auto straight = check.FindObstruction(from, to);
  ASSERT_TRUE(straight.has_value());
  EXPECT_THAT(Describe(scene, rules, *straight), HasSubstr("brick"));
  const PathResult result = FindPath(scene, {.from = from, .to = to, .rules = rules});
  const auto* path = std::get_if<JointPath>(&result);
  ASSERT_NE(path, nullptr) << std::get<PathFailure>(result).what;
  AlongByMillimetres(scene, *path, [&](const JointVector& q) {
    ASSERT_LE(Tilt(scene, q), tilt + 1e-9);
    ASSERT_TRUE(IsClear(scene, q, kClearance));
  });
}

TEST(PathSearch, SameRequestSamePath) {
  const CollisionScene scene(Clutter(), PartsAtTheStart());
  RandomStream random(102, "determinism");
  const PathRequest request{.from = RandomPostureAtTheTable(scene, kRoom, random),
                            .to = RandomPostureAtTheTable(scene, kRoom, random)};
  const PathResult first = FindPath(scene, request);
  // A search must leave no state behind.
  FindPath(scene, {.from = request.to, .to = request.from, .seed = 7});
  const PathResult second = FindPath(scene, request);
  EXPECT_EQ(std::get<JointPath>(first), std::get<JointPath>(second));
}

TEST(PathSearch, SaysWhatIsInTheWayAtTheEnds) {
  const CollisionScene scene(Clutter(), PartsAtTheStart(0));
  const Vector3 brick = Clutter().part(PartId(2)).X_WorldPart.translation();
  const JointVector blocked = Above(scene, brick.x(), brick.y(), brick.z());
  const JointVector& home = scene.workcell().home();
  const PathResult to = FindPath(scene, {.from = home, .to = blocked});
  EXPECT_EQ(std::get<PathFailure>(to).reason, PathFailure::Reason::kGoal);
  EXPECT_THAT(std::get<PathFailure>(to).what, HasSubstr("brick"));
  const PathResult from = FindPath(scene, {.from = blocked, .to = home});
  EXPECT_EQ(std::get<PathFailure>(from).reason, PathFailure::Reason::kStart);
  EXPECT_THAT(std::get<PathFailure>(from).what, HasSubstr("brick"));
}

// With a budget of zero, the failure names what obstructs the straight motion.
TEST(PathSearch, SaysWhatIsInTheWayOnTheWay) {
  const CollisionScene scene(Clutter(), PartsAtTheStart(0));
  const Vector3 brick = Clutter().part(PartId(2)).X_WorldPart.translation();
  const PathResult result =
      FindPath(scene, {.from = Above(scene, brick.x(), brick.y() + 0.22, 0.08),
                       .to = Above(scene, brick.x(), brick.y() - 0.22, 0.08),
                       .budget = 0});
  EXPECT_EQ(std::get<PathFailure>(result).reason, PathFailure::Reason::kBudget);
  EXPECT_THAT(std::get<PathFailure>(result).what, HasSubstr("brick"));
}

}  // namespace
}  // namespace assay::motion::path_search_test
