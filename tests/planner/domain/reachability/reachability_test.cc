#include "planner/domain/reachability/reachability.h"
#include "planner/domain/matings/mating_classes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <iterator>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <vector>

#include "planner/base/random.h"
#include "planner/domain/reachability/action_ways.h"
#include "planner/domain/resting/resting.h"
#include "planner/geometry/box.h"
#include "planner/geometry/collision.h"
#include "planner/geometry/pose.h"
#include "tests/planner/domain/scenario.h"

namespace assay::domain::reachability_test {
namespace {

using geometry::Box;
using testing::HasSubstr;

constexpr double kDegree = std::numbers::pi / 180;
constexpr GraspConditions kIndependentOfPlace =
    GraspCondition::kOpening | GraspCondition::kFacesFree;

bool Has(GraspConditions set, GraspCondition condition) {
  return (set & static_cast<GraspConditions>(condition)) != 0;
}

int GraspCount(const Problem& problem, PartId part) {
  return static_cast<int>(problem.part(part).grasps->size());
}

StablePoseId Named(const Problem& problem, PartId part, const std::string& name) {
  return problem.part(part).model->FindStablePose(name);
}

const Grasp& GraspOf(const Problem& problem, PartId part, int grasp) {
  return problem.part(part).grasps->at(static_cast<std::size_t>(grasp));
}

// Returns the number of positions of a part for regrasping: its stable poses and, as the last one,
// its pose at the start.
int PositionCount(const Problem& problem, PartId part) {
  return static_cast<int>(problem.part(part).model->stable_poses().size()) + 1;
}

bool IsReachable(const Problem& problem, PartId part, int grasp, int position) {
  if (position == PositionCount(problem, part) - 1) {
    return IsReachableAt(problem, part, GraspId(grasp), problem.part(part).X_WorldPart);
  }
  return IsReachableIn(problem, part, GraspId(grasp), StablePoseId(position));
}

std::set<int> GraspsIn(const Problem& problem, PartId part, int position) {
  std::set<int> grasps;
  for (int g = 0; g < GraspCount(problem, part); ++g) {
    if (IsReachable(problem, part, g, position)) grasps.insert(g);
  }
  return grasps;
}

std::set<int> Both(const std::set<int>& a, const std::set<int>& b) {
  std::set<int> both;
  std::ranges::set_intersection(a, b, std::inserter(both, both.end()));
  return both;
}

std::set<int> CommonGrasps(const Problem& problem, PartId part, const std::string& from,
                           const std::string& to) {
  return Both(GraspsIn(problem, part, Named(problem, part, from).index()),
              GraspsIn(problem, part, Named(problem, part, to).index()));
}

// Returns the grasps with which the mating can be made while the fixed part is in a stable pose.
std::set<int> MatingGrasps(const Problem& problem, MatingId id, StablePoseId pose_of_fixed) {
  const Mating& mating = problem.mating(id);
  std::set<int> grasps;
  for (int g = 0; g < GraspCount(problem, mating.held); ++g) {
    if (LeavesMatingFeaturesFree(problem, mating, GraspId(g)) &&
        IsMateReachableIn(problem, id, GraspId(g), pose_of_fixed)) {
      grasps.insert(g);
    }
  }
  return grasps;
}

bool AllowsMating(const Problem& problem, const Mating& mating, StablePoseId pose) {
  const Pose& X = problem.part(mating.fixed).model->stable_poses()[pose.index()].X_TablePart;
  return !HidesMatingFeatures(problem, mating, pose) && InFrictionCone(problem, mating, X);
}

class PegAndBlock : public testing::Test {
 protected:
  const Problem problem_ = LoadScenario("spar-fig13");
  const PartId block_ = PartNamed(problem_, "block");
  const PartId peg_ = PartNamed(problem_, "peg");
  const MatingId mating_{0};
};

// ---- The four facts from which the paper's plans follow ----

TEST_F(PegAndBlock, NoGraspTurnsTheBlockFromItsFaceToItsBack) {
  EXPECT_TRUE(CommonGrasps(problem_, block_, "face-down", "on-back").empty());
  EXPECT_FALSE(CommonGrasps(problem_, block_, "face-down", "on-end").empty());
}

TEST_F(PegAndBlock, OneGraspTurnsTheBlockFromAnEndToItsBack) {
  EXPECT_FALSE(CommonGrasps(problem_, block_, "on-end", "on-back").empty());
  EXPECT_FALSE(CommonGrasps(problem_, block_, "on-other-end", "on-back").empty());
}

TEST_F(PegAndBlock, APegWithItsShaftUpIsRegraspedOverALyingPose) {
  const std::set<int> mating = MatingGrasps(problem_, mating_, Named(problem_, block_, "on-back"));
  const std::set<int> standing =
      GraspsIn(problem_, peg_, Named(problem_, peg_, "shaft-up").index());
  EXPECT_TRUE(Both(mating, standing).empty());
  EXPECT_TRUE(CommonGrasps(problem_, peg_, "shaft-up", "shaft-down").empty());
  EXPECT_FALSE(CommonGrasps(problem_, peg_, "shaft-up", "on-side").empty());
}

TEST_F(PegAndBlock, ALyingPegIsTakenAndInsertedWithOneGrasp) {
  const std::set<int> mating = MatingGrasps(problem_, mating_, Named(problem_, block_, "on-back"));
  for (const char* lying : {"on-side", "on-other-side", "on-lower-side", "on-upper-side"}) {
    const int pose = Named(problem_, peg_, lying).index();
    EXPECT_FALSE(Both(mating, GraspsIn(problem_, peg_, pose)).empty()) << lying;
  }
}

// ---- The masks ----

TEST_F(PegAndBlock, MasksAgreeWithYesAndNo) {
  for (const PartId part : {block_, peg_}) {
    for (int g = 0; g < GraspCount(problem_, part); ++g) {
      for (int p = 0; p < PositionCount(problem_, part) - 1; ++p) {
        EXPECT_EQ(BrokenIn(problem_, part, GraspId(g), StablePoseId(p)) == 0,
                  IsReachableIn(problem_, part, GraspId(g), StablePoseId(p)))
            << GraspOf(problem_, part, g).label << " in " << p;
      }
      const Pose& X = problem_.part(part).X_WorldPart;
      EXPECT_EQ(BrokenAt(problem_, part, GraspId(g), X) == 0,
                IsReachableAt(problem_, part, GraspId(g), X));
    }
  }
  for (int g = 0; g < GraspCount(problem_, peg_); ++g) {
    for (int p = 0; p < PositionCount(problem_, block_) - 1; ++p) {
      EXPECT_EQ(BrokenMatingIn(problem_, mating_, GraspId(g), StablePoseId(p)) == 0,
                IsMateReachableIn(problem_, mating_, GraspId(g), StablePoseId(p)));
    }
  }
}

// Returns the broken conditions, each found again in the most naive way.
GraspConditions NaivelyBroken(const Problem& problem, PartId part, int g, const Pose& X_WorldPart) {
  const Workcell& workcell = *problem.workcell;
  const Grasp& grasp = GraspOf(problem, part, g);
  const Pose X_WorldTool = X_WorldPart * grasp.X_PartTool;
  int broken = 0;
  for (const double side : {-1.0, 1.0}) {
    const Vector3 pressed(0, side * grasp.width / 2, 0);
    const Vector3 outward = X_WorldTool.linear() * Vector3(0, side, 0);
    if ((X_WorldTool * pressed).z() < 1e-6 && outward.z() < -1 + 1e-6) {
      broken |= static_cast<int>(GraspCondition::kFacesFree);
    }
  }
  const double lean = std::acos(std::clamp(-X_WorldTool.linear()(2, 2), -1.0, 1.0));
  if (lean > workcell.rules().tool_lean + 1e-6) {
    broken |= static_cast<int>(GraspCondition::kToolLean);
  }
  std::vector<Box> boxes = workcell.gripper().HandBoxes();
  for (const double opening : {grasp.width, workcell.gripper().max_opening()}) {
    for (const Box& box : workcell.gripper().FingerBoxes(opening)) boxes.push_back(box);
  }
  for (const Box& box : boxes) {
    for (const Vector3& corner : box.Corners()) {
      if ((X_WorldTool * corner).z() < -workcell.rules().contact_allowance - 1e-8) {
        broken |= static_cast<int>(GraspCondition::kTableClear);
      }
    }
  }
  return static_cast<GraspConditions>(broken);
}

TEST_F(PegAndBlock, ConditionsAgreeWithNaiveOnes) {
  const GraspConditions place =
      kIndependentOfPlace |
      static_cast<GraspConditions>(GraspCondition::kToolLean | GraspCondition::kTableClear);
  std::map<GraspConditions, int> met;
  for (const PartId part : {block_, peg_}) {
    const auto& poses = problem_.part(part).model->stable_poses();
    for (int g = 0; g < GraspCount(problem_, part); ++g) {
      for (std::size_t p = 0; p < poses.size(); ++p) {
        const GraspConditions broken =
            BrokenIn(problem_, part, GraspId(g), StablePoseId(p)) & place;
        EXPECT_EQ(broken, NaivelyBroken(problem_, part, g, poses[p].X_TablePart))
            << GraspOf(problem_, part, g).label << " in " << poses[p].label;
        ++met[broken];
      }
    }
  }
  EXPECT_GE(met.size(), 4u) << "the parts try few of the conditions";
}

// All conditions except reach are independent of the place and yaw of the part.
TEST_F(PegAndBlock, ConditionsButReachDoNotDependOnThePlace) {
  RandomStream random(5, "places");
  const int reach = static_cast<int>(GraspCondition::kReach);
  for (const PartId part : {block_, peg_}) {
    const Part& p = problem_.part(part);
    for (int g = 0; g < GraspCount(problem_, part); ++g) {
      const StablePoseId pose(random.Index(static_cast<int>(p.model->stable_poses().size())));
      const Placement placement = {.x = random.Uniform(0.4, 1.0),
                                   .y = random.Uniform(-0.5, 0.5),
                                   .yaw = random.Uniform(-3, 3)};
      EXPECT_EQ(BrokenIn(problem_, part, GraspId(g), pose) & ~reach,
                BrokenAt(problem_, part, GraspId(g), PoseAt(p, pose, placement)) & ~reach)
          << p.name << " " << GraspOf(problem_, part, g).label;
    }
  }
}

TEST_F(PegAndBlock, ReachableInAPoseMeansAtSomePlacement) {
  const StablePoseId pose = Named(problem_, peg_, "on-side");
  const Part& peg = problem_.part(peg_);
  for (int g = 0; g < GraspCount(problem_, peg_); g += 3) {
    bool at_some = false;
    for (const Placement& placement : problem_.workcell->placements()) {
      const Pose X = PoseAt(peg, pose, placement);
      at_some |= OnTable(problem_, peg_, X) && IsReachableAt(problem_, peg_, GraspId(g), X);
    }
    EXPECT_EQ(IsReachableIn(problem_, peg_, GraspId(g), pose), at_some)
        << GraspOf(problem_, peg_, g).label;
  }
}

TEST_F(PegAndBlock, NothingIsReachableFarAway) {
  const Part& block = problem_.part(block_);
  const Pose X = PoseAt(block, Named(problem_, block_, "on-end"), {.x = 3});
  for (int g = 0; g < GraspCount(problem_, block_); ++g) {
    EXPECT_TRUE(Has(BrokenAt(problem_, block_, GraspId(g), X), GraspCondition::kReach));
  }
}

// The grasps were computed for a wider gripper, so the part is wider than the gripper opens.
TEST_F(PegAndBlock, AGraspThatIsTooWideBreaksTheOpening) {
  Problem problem = problem_;
  std::vector<Grasp> wide = *problem.parts[block_.index()].grasps;
  for (Grasp& grasp : wide) grasp.width = problem.workcell->gripper().max_opening() + 0.01;
  problem.parts[block_.index()].grasps = std::make_shared<const std::vector<Grasp>>(wide);
  const StablePoseId pose = Named(problem, block_, "on-end");
  for (int g = 0; g < GraspCount(problem, block_); ++g) {
    EXPECT_TRUE(Has(BrokenIn(problem, block_, GraspId(g), pose), GraspCondition::kOpening));
    EXPECT_FALSE(Has(BrokenIn(problem_, block_, GraspId(g), pose), GraspCondition::kOpening));
  }
}

TEST_F(PegAndBlock, AHandInTheMatedBlockBreaksMateClear) {
  const Mating& mating = problem_.mating(mating_);
  const auto& block = problem_.part(block_).model->shape();
  const Workcell& workcell = *problem_.workcell;
  const StablePoseId back = Named(problem_, block_, "on-back");
  int in_the_way = 0;
  for (int g = 0; g < GraspCount(problem_, peg_); ++g) {
    const Pose X_FixedTool = mating.X_FixedHeld * GraspOf(problem_, peg_, g).X_PartTool;
    const bool overlaps =
        Overlaps(workcell.HandShape(workcell.gripper().max_opening()), X_FixedTool, block,
                 Pose::Identity(), workcell.rules().contact_allowance);
    const bool broken =
        Has(BrokenMatingIn(problem_, mating_, GraspId(g), back), GraspCondition::kMateClear);
    EXPECT_TRUE(broken || !overlaps) << GraspOf(problem_, peg_, g).label;
    in_the_way += overlaps ? 1 : 0;
  }
  EXPECT_GT(in_the_way, 0);
}

// ---- Features and the friction cone ----

TEST_F(PegAndBlock, OnlyTheBackLeavesTheHoleUpAndFree) {
  const Mating& mating = problem_.mating(mating_);
  for (int p = 0; p < PositionCount(problem_, block_) - 1; ++p) {
    const std::string& name =
        problem_.part(block_).model->stable_poses()[static_cast<std::size_t>(p)].name;
    EXPECT_EQ(AllowsMating(problem_, mating, StablePoseId(p)), name == "on-back") << name;
  }
  EXPECT_TRUE(HidesMatingFeatures(problem_, mating, Named(problem_, block_, "face-down")));
  EXPECT_FALSE(HidesMatingFeatures(problem_, mating, Named(problem_, block_, "on-side")));
  EXPECT_FALSE(HidesMatingFeatures(problem_, mating, domain::StablePoseId::None()));
}

TEST_F(PegAndBlock, GraspsOnTheShaftDoNotLeaveTheMatingFeaturesFree) {
  const Mating& mating = problem_.mating(mating_);
  const FeatureNumber shaft(7);
  int on_shaft = 0;
  for (int g = 0; g < GraspCount(problem_, peg_); ++g) {
    const std::vector<FeatureNumber>& hidden = GraspOf(problem_, peg_, g).hidden;
    if (std::ranges::find(hidden, shaft) == hidden.end()) continue;
    ++on_shaft;
    EXPECT_FALSE(LeavesMatingFeaturesFree(problem_, mating, GraspId(g)));
  }
  EXPECT_GT(on_shaft, 0);
}

// The cone is -v_z >= |v| cos(atan(mu)) for the mating vector v with mu = 0.25.
TEST_F(PegAndBlock, FrictionConeOpensByTheArcTangentOfFriction) {
  const Mating& mating = problem_.mating(mating_);
  const Part& block = problem_.part(block_);
  const Pose X_Back = PoseAt(block, Named(problem_, block_, "on-back"), {.x = 0.6});
  const double cone = std::atan(0.25);
  for (const double angle : {0.0, 0.5 * cone, cone - 1e-6, cone + 1e-6, 2 * cone, 3.0}) {
    for (const double sign : {-1.0, 1.0}) {
      // The table is far below.
      const Pose X = geometry::Translation(0, 0, 1) * geometry::RotationX(sign * angle) * X_Back;
      EXPECT_EQ(InFrictionCone(problem_, mating, X), angle <= cone) << sign * angle / kDegree;
      EXPECT_EQ(InFrictionCone(problem_, mating, geometry::RotationZ(1) * X), angle <= cone);
    }
  }
}

// The cone belongs to the least friction within the tolerance.
TEST_F(PegAndBlock, FrictionConeIsThatOfTheLeastFriction) {
  Problem problem = problem_;
  problem.tolerances.friction = 0.05;
  const Pose X_Back = geometry::Translation(0, 0, 1) *
                      PoseAt(problem.part(block_), Named(problem, block_, "on-back"), {.x = 0.6});
  const double cone = std::atan(0.2);
  for (const double angle : {cone - 1e-6, cone + 1e-6}) {
    EXPECT_EQ(InFrictionCone(problem, problem.mating(mating_), geometry::RotationX(angle) * X_Back),
              angle <= cone);
  }
}

// ---- The hand beside other parts ----

TEST_F(PegAndBlock, ObstacleIsTheFirstThatOverlaps) {
  const Part& block = problem_.part(block_);
  const Pose X_WorldBlock = PoseAt(block, Named(problem_, block_, "on-end"), {.x = 0.6});
  const Pose X_WorldTool =
      geometry::Translation(0.6, 0, 0.1) * geometry::RotationX(std::numbers::pi);
  const std::vector<PlacedPart> others = {{peg_, geometry::Translation(2, 0, 0)},
                                          {block_, X_WorldBlock}};
  EXPECT_EQ(Obstacle(problem_, X_WorldTool, 0.05, others), block_);
  EXPECT_EQ(Obstacle(problem_, X_WorldTool, 0.05, std::span(others).first(1)), PartId::None());
  EXPECT_EQ(Obstacle(problem_, geometry::Translation(0, 0, 0.2) * X_WorldTool, 0.05, others),
            PartId::None());
}

TEST_F(PegAndBlock, APartIsNoObstacleToItself) {
  const Part& block = problem_.part(block_);
  const Pose X_WorldBlock = PoseAt(block, Named(problem_, block_, "on-end"), {.x = 0.6});
  const std::vector<PlacedPart> others = {{block_, X_WorldBlock}, {peg_, X_WorldBlock}};
  EXPECT_EQ(Obstacle(problem_, {block_, X_WorldBlock}, others), peg_);
  EXPECT_EQ(Obstacle(problem_, {block_, X_WorldBlock}, std::span(others).first(1)), PartId::None());
}

TEST_F(PegAndBlock, CanApproachAlongTheTool) {
  const Pose X_WorldTool =
      geometry::Translation(0.6, 0, 0.05) * geometry::RotationX(std::numbers::pi);
  EXPECT_TRUE(CanApproach(*problem_.workcell, X_WorldTool, {0, 0, -0.08}));
  EXPECT_FALSE(CanApproach(*problem_.workcell, X_WorldTool, {-1, 0, 0}));
}

TEST_F(PegAndBlock, DescriptionsTellTheLimits) {
  EXPECT_EQ(Describe(problem_, GraspCondition::kToolLean),
            "the tool leans at most 60 deg from straight down");
  EXPECT_EQ(Describe(problem_, GraspCondition::kOpening), "the gripper opens at most 101.6 mm");
  EXPECT_THAT(Describe(problem_, GraspCondition::kReach), HasSubstr("400 mm above the table"));
}

// ---- How often parts must be put down ----

// Returns the fewest putdowns of a part before it rests in, or is taken from, a wanted position.
// The search is breadth-first over positions that share a grasp. Returns none if there is no way.
template <class Wanted>
std::optional<int> FewestPutdowns(const Problem& problem, PartId part, const Wanted& wanted) {
  const int start = PositionCount(problem, part) - 1;
  std::map<int, int> putdowns = {{start, 0}};
  std::deque<int> queue = {start};
  while (!queue.empty()) {
    const int position = queue.front();
    queue.pop_front();
    if (wanted(position)) return putdowns[position];
    for (int next = 0; next < start; ++next) {
      if (putdowns.contains(next)) continue;
      if (Both(GraspsIn(problem, part, position), GraspsIn(problem, part, next)).empty()) continue;
      putdowns[next] = putdowns[position] + 1;
      queue.push_back(next);
    }
  }
  return std::nullopt;
}

// Returns the fewest actions for one mating if no part is in the way. Each putdown needs a pickup,
// and at the end there is a pickup and the assemble.
std::optional<int> FewestActions(const Problem& problem, MatingId id) {
  const Mating& mating = problem.mating(id);
  const Part& fixed = problem.part(mating.fixed);
  const int start = PositionCount(problem, mating.fixed) - 1;
  const auto resting = [&](int p) { return p == start ? fixed.resting : StablePoseId(p); };
  std::set<int> mating_grasps;
  const auto fixed_putdowns = FewestPutdowns(problem, mating.fixed, [&](int p) {
    if (!AllowsMating(problem, mating, resting(p))) return false;
    mating_grasps = MatingGrasps(problem, id, resting(p));
    return true;
  });
  const auto held_putdowns = FewestPutdowns(problem, mating.held, [&](int p) {
    return !Both(GraspsIn(problem, mating.held, p), mating_grasps).empty();
  });
  if (!fixed_putdowns || !held_putdowns) return std::nullopt;
  return 2 * *fixed_putdowns + 2 * *held_putdowns + 2;
}

struct Expected {
  const char* scenario;
  std::optional<int> actions;  // for the first mating, without regard to other parts
};

class ScenarioActions : public testing::TestWithParam<Expected> {};
INSTANTIATE_TEST_SUITE_P(Scenarios, ScenarioActions,
                         testing::Values(Expected{"spar-fig13", 6}, Expected{"spar-fig14", 4},
                                         Expected{"spar-fig15", 2}, Expected{"spar-fig16", 4},
                                         Expected{"spar-example", 4}, Expected{"keyed", 4},
                                         Expected{"two-pegs", 4}, Expected{"clutter", 4},
                                         Expected{"impossible", std::nullopt}),
                         [](const auto& test) {
                           std::string name = test.param.scenario;
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

TEST_P(ScenarioActions, AreAsManyAsItsCommentSays) {
  EXPECT_EQ(FewestActions(LoadScenario(GetParam().scenario), MatingId(0)), GetParam().actions);
}

// Every part that a scenario moves can be taken at its start by one of the robots.
TEST(Scenarios, PartsCanBeTakenAtTheStart) {
  for (const std::string& name : AllScenarios()) {
    const Problem problem = LoadScenario(name);
    for (std::size_t i = 0; i < problem.parts.size(); ++i) {
      const PartId part(i);
      bool can_be_taken = false;
      for (std::size_t robot = 0; robot < problem.workcell->robots().size(); ++robot) {
        const Problem its = WorkedBy(problem, RobotId(robot));
        can_be_taken |= !GraspsIn(its, part, PositionCount(its, part) - 1).empty();
      }
      EXPECT_TRUE(can_be_taken) << name << " " << problem.part(part).name;
    }
  }
}

// The hand that inserts the second peg does not touch the first.
TEST(Scenarios, TwoPegsLeaveRoomForTheHand) {
  const Problem problem = LoadScenario("two-pegs");
  const PartId block = PartNamed(problem, "block");
  const StablePoseId back = Named(problem, block, "on-back");
  const Pose& X_WorldBlock = problem.part(block).model->stable_poses()[back.index()].X_TablePart;
  for (int m = 0; m < 2; ++m) {
    const Mating& mating = problem.mating(MatingId(m));
    const Mating& other = problem.mating(MatingId(1 - m));
    const std::vector<PlacedPart> in_place = {{other.held, X_WorldBlock * other.X_FixedHeld}};
    const std::set<int> grasps =
        Both(MatingGrasps(problem, MatingId(m), back),
             GraspsIn(problem, mating.held, PositionCount(problem, mating.held) - 1));
    ASSERT_FALSE(grasps.empty());
    const bool free = std::ranges::any_of(grasps, [&](int g) {
      const Pose X_WorldTool =
          X_WorldBlock * mating.X_FixedHeld * GraspOf(problem, mating.held, g).X_PartTool;
      return Obstacle(problem, X_WorldTool, problem.workcell->gripper().max_opening(), in_place)
          .IsNone();
    });
    EXPECT_TRUE(free) << m;
  }
}

}  // namespace
}  // namespace assay::domain::reachability_test
