#include "planner/domain/matings/mating_classes.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "planner/domain/reachability/reachability.h"
#include "planner/geometry/pose.h"
#include "tests/planner/domain/scenario.h"

namespace assay::domain::mating_classes_test {
namespace {

// Returns how many grasps suit the mating of a dowel that is seated `higher` metres above its seat,
// and how many of these touch the shaft.
std::pair<std::ptrdiff_t, std::ptrdiff_t> Suitable(double higher) {
  const Problem problem = LoadScenario("dowel");
  Mating mating = problem.matings.front();
  mating.X_FixedHeld = geometry::Translation(0, 0, higher) * mating.X_FixedHeld;
  const std::vector<int> labels = GraspList(problem, mating);
  const auto touches = [&](int label) {
    const auto& hidden = (*problem.part(mating.held).grasps)[label].hidden;
    return std::ranges::count(hidden, mating.features.front().first) > 0;
  };
  return {std::ssize(labels), std::ranges::count_if(labels, touches)};
}

// Pads may touch the shaft only where the hole leaves it free at the end.
TEST(GraspList, HasGraspsOnWhatStaysOutsideOfTheHole) {
  const auto [seated, on_seated_shaft] = Suitable(0);
  EXPECT_GT(seated, 0);
  EXPECT_EQ(on_seated_shaft, 0);
  const auto [raised, on_raised_shaft] = Suitable(0.02);
  EXPECT_GT(on_raised_shaft, 0);
  EXPECT_EQ(raised - on_raised_shaft, seated);
}

// An upright bar goes through a frame 10 mm high. Pads may touch the sides of the bar above the
// frame, also while the bar stands on the tip of the same shaft.
TEST(GraspList, HasGraspsOnTheSidesOfAStandingShaft) {
  const Problem problem = LoadScenario("key-bar");
  const Mating& mating = problem.matings.front();
  const double pad = problem.workcell->gripper().pad_half_extents().y();
  int standing = 0;
  for (const int label : GraspList(problem, mating)) {
    const Grasp& grasp = (*problem.part(mating.held).grasps)[label];
    EXPECT_GT(grasp.X_PartTool.translation().z(), 0.01 + pad - 1e-6) << grasp.label;
    standing +=
        IsReachableAt(problem, mating.held, GraspId(label), problem.part(mating.held).X_WorldPart);
  }
  EXPECT_GT(standing, 0);
}

// A part that is rougher than the workcell's rules say counts.
TEST(GreatestMatingFriction, IsThatOfTheRoughestPart) {
  Problem problem = LoadScenario("mate-round");
  const Mating& mating = problem.matings.front();
  EXPECT_LT(problem.part(mating.held).model->friction(), problem.workcell->rules().friction);
  EXPECT_EQ(GreatestMatingFriction(problem, mating), problem.workcell->rules().friction);
  problem.parts[mating.held.index()].model = LoadScenario("dowel").parts[0].model;
  EXPECT_EQ(GreatestMatingFriction(problem, mating), 0.25);
  problem.tolerances.friction = 0.05;
  EXPECT_EQ(GreatestMatingFriction(problem, mating), 0.25 + 0.05);
}

}  // namespace
}  // namespace assay::domain::mating_classes_test
