#include "planner/domain/reachability/tool_path.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "planner/base/random.h"
#include "planner/domain/workcell/workcell_file.h"
#include "planner/geometry/pose.h"
#include "tests/planner/domain/scenario.h"

namespace assay::domain::tool_path_test {
namespace {

using geometry::Matrix3;
using kinematics::InverseSolution;
using kinematics::JointVector;

std::shared_ptr<const Workcell> PumaTable() {
  return WorkcellFile::Read(ModelsFolder() / "workcells/puma762-table/workcell.yaml");
}

const Matrix3 kDown = geometry::RotationX(std::numbers::pi).linear();

Matrix3 RandomLeaningTool(RandomStream& random) {
  const double turn = std::numbers::pi;
  return (geometry::RotationZ(random.Uniform(-turn, turn)) *
          geometry::RotationX(turn + random.Uniform(-1.2, 1.2)) *
          geometry::RotationZ(random.Uniform(-turn, turn)))
      .linear();
}

Vector3 RandomPoint(RandomStream& random) {
  return {random.Uniform(0.2, 1.2), random.Uniform(-0.7, 0.7), random.Uniform(0, 0.5)};
}

std::optional<JointVector> SolutionLike(const Workcell& workcell, const Matrix3& R_WorldTool,
                                        const Vector3& p, const kinematics::Indicators& indicators,
                                        const JointVector& reference) {
  Pose X_WorldTool = geometry::Translation(p);
  X_WorldTool.linear() = R_WorldTool;
  for (const InverseSolution& s :
       workcell.arm().Inverse(workcell.FlangeFor(X_WorldTool), reference)) {
    if (s.indicators == indicators) return workcell.arm().NearestInRange(s.q, reference);
  }
  return std::nullopt;
}

// Oracle: follows the path in each configuration with a check at every millimetre and turns of at
// most 1 degree in between. Every path that it allows must be allowed with checks at every 25 mm.
bool FollowsDensely(const Workcell& workcell, const Matrix3& R_WorldTool, const Vector3& from,
                    const Vector3& to) {
  const int steps = static_cast<int>(std::ceil((to - from).norm() / 0.001));
  Pose X_WorldTool = geometry::Translation(from);
  X_WorldTool.linear() = R_WorldTool;
  for (const InverseSolution& start :
       workcell.arm().Inverse(workcell.FlangeFor(X_WorldTool), workcell.home())) {
    std::optional<JointVector> q = workcell.arm().NearestInRange(start.q, workcell.home());
    for (int i = 1; q && i <= steps; ++i) {
      const Vector3 p = from + static_cast<double>(i) / steps * (to - from);
      const auto next = SolutionLike(workcell, R_WorldTool, p, start.indicators, *q);
      const bool near = next && (*next - *q).cwiseAbs().maxCoeff() < 0.4 / 26;
      q = near ? next : std::nullopt;
    }
    if (q) return true;
  }
  return false;
}

TEST(ToolPath, AgreesWithDenseFollowing) {
  const auto workcell = PumaTable();
  RandomStream random(11, "tool paths");
  int followed = 0;
  int differ = 0;
  constexpr int kTrials = 1500;
  for (int trial = 0; trial < kTrials; ++trial) {
    const Matrix3 R = RandomLeaningTool(random);
    const std::array<Vector3, 2> line = {RandomPoint(random), RandomPoint(random)};
    const bool dense = FollowsDensely(*workcell, R, line[0], line[1]);
    const bool coarse = CanFollow(*workcell, R, line);
    EXPECT_TRUE(coarse || !dense) << "trial " << trial;
    followed += dense ? 1 : 0;
    differ += coarse != dense ? 1 : 0;
  }
  EXPECT_GT(followed, kTrials / 10);
  EXPECT_LT(differ, kTrials / 50) << "what happens between looks matters seldom";
}

TEST(ToolPath, DownToTheTableAndBack) {
  const auto workcell = PumaTable();
  const std::array<Vector3, 3> path = {Vector3(0.6, 0, 0.4), {0.6, 0, 0.02}, {0.6, 0, 0.4}};
  EXPECT_TRUE(CanFollow(*workcell, kDown, path));
}

TEST(ToolPath, EveryCornerMustBeInReach) {
  const auto workcell = PumaTable();
  const Vector3 near(0.6, 0, 0.3);
  const Vector3 far(1.6, 0, 0.3);
  EXPECT_TRUE(CanFollow(*workcell, kDown, std::array{near}));
  EXPECT_FALSE(CanFollow(*workcell, kDown, std::array{far}));
  EXPECT_FALSE(CanFollow(*workcell, kDown, std::array{near, far}));
  EXPECT_FALSE(CanFollow(*workcell, kDown, std::array{far, near}));
  EXPECT_FALSE(CanFollow(*workcell, kDown, std::array{near, far, near}));
}

Pose PoseOf(const Matrix3& R_WorldTool, const Vector3& p) {
  Pose X_WorldTool = geometry::Translation(p);
  X_WorldTool.linear() = R_WorldTool;
  return X_WorldTool;
}

TEST(ToolPath, WithoutTurnsReachIsTheSame) {
  const auto workcell = PumaTable();
  RandomStream random(13, "reach");
  int followed = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const Matrix3 R = RandomLeaningTool(random);
    const std::array<Vector3, 3> path = {RandomPoint(random), RandomPoint(random),
                                         RandomPoint(random)};
    const std::array<Pose, 3> poses = {PoseOf(R, path[0]), PoseOf(R, path[1]), PoseOf(R, path[2])};
    const PathReach reach = ReachAlong(*workcell, poses);
    EXPECT_EQ(reach.start.has_value(), reach.reached == path.size());
    for (std::size_t length = 1; length <= path.size(); ++length) {
      EXPECT_EQ(CanFollow(*workcell, R, std::span(path).first(length)), length <= reach.reached)
          << "trial " << trial;
    }
    followed += reach.start ? 1 : 0;
  }
  EXPECT_GT(followed, 10);
}

// From the returned start, the joints follow the way in small steps.
TEST(ToolPath, TheStartIsOfAConfigurationThatComesToTheEnd) {
  const auto workcell = PumaTable();
  RandomStream random(14, "turns");
  int followed = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const Pose from = PoseOf(RandomLeaningTool(random), RandomPoint(random));
    const Eigen::AngleAxisd turn(0.5, RandomPoint(random).normalized());
    const Vector3 line = 0.05 * RandomPoint(random);
    const Pose to = PoseOf(from.linear() * turn, from.translation() + line);
    const PathReach reach = ReachAlong(*workcell, std::array{from, to});
    if (!reach.start) continue;
    ++followed;
    const Pose start = workcell->arm().Forward(*reach.start);
    EXPECT_TRUE(start.isApprox(workcell->FlangeFor(from), 1e-6)) << "trial " << trial;
    const kinematics::Indicators indicators = workcell->arm().IndicatorsOf(*reach.start);
    std::optional<JointVector> q = reach.start;
    for (int i = 1; q && i <= 100; ++i) {
      const Matrix3 R = from.linear() * Eigen::AngleAxisd(i * 0.005, turn.axis());
      q = SolutionLike(*workcell, R, from.translation() + i * 0.01 * line, indicators, *q);
    }
    EXPECT_TRUE(q.has_value()) << "trial " << trial;
  }
  EXPECT_GT(followed, 10);
}

// If a path can be followed, so can its beginnings.
TEST(ToolPath, PrefixesOfAPathCanBeFollowed) {
  const auto workcell = PumaTable();
  RandomStream random(12, "prefixes");
  int followed = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const Matrix3 R = RandomLeaningTool(random);
    const std::vector<Vector3> path = {RandomPoint(random), RandomPoint(random),
                                       RandomPoint(random)};
    if (!CanFollow(*workcell, R, path)) continue;
    ++followed;
    EXPECT_TRUE(CanFollow(*workcell, R, std::span(path).first(2))) << trial;
    EXPECT_TRUE(CanFollow(*workcell, R, std::span(path).first(1))) << trial;
  }
  EXPECT_GT(followed, 10);
}

}  // namespace
}  // namespace assay::domain::tool_path_test
