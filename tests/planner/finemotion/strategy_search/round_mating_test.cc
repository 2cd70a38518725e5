#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "planner/domain/problem/problem_file.h"
#include "planner/finemotion/strategy_checks/exact_replay.h"
#include "planner/finemotion/strategy_checks/strategy_check.h"
#include "planner/finemotion/strategy_search/mating.h"
#include "tests/planner/domain/scenario.h"

namespace assay::finemotion::round_mating_test {
namespace {

// The scenario's mating, with the strategy for the scenario's errors.
class RoundMating : public testing::Test {
 protected:
  static const domain::Problem& problem() {
    static const domain::Problem problem = domain::LoadScenario("mate-round");
    return problem;
  }
  static const MatingGeometry& geometry() {
    static const MatingGeometry geometry = GeometryOf(problem(), problem().matings.front());
    return geometry;
  }
  static FineMotionErrors Errors() {
    FineMotionErrors errors;
    errors.pose << Vector3::Constant(problem().mating_errors.displacement),
        Vector3::Constant(problem().mating_errors.rotation);
    return errors;
  }
  static const FineMotionPlan& plan() {
    static const FineMotionPlan plan = SearchStrategy(geometry().passage, Errors());
    return plan;
  }
};

// The contacts of the polygons with 96 sides are not counted: their number would be thousands.
TEST_F(RoundMating, HasFewContacts) {
  const Passage& passage = geometry().passage;
  EXPECT_EQ(passage.moving.shafts.size(), 1U);
  EXPECT_EQ(passage.stationary.holes.size(), 1U);
  EXPECT_EQ(geometry().critical_points.size(), 2U);
  const ContactFinder finder(passage.moving, passage.stationary);
  EXPECT_LT(finder.Near(passage.X_StationaryEntry, {.reach = 0.003, .turn = 0.03}).size(), 60U);
}

TEST_F(RoundMating, HasAStrategy) {
  EXPECT_TRUE(plan().found());
  EXPECT_GE(plan().absorbed, 1);
  EXPECT_GT(plan().exact_replays, 100);
  for (const CertainMotion& motion : plan().motions) EXPECT_TRUE(motion.check.certain);
}

TEST_F(RoundMating, TheCheckFindsNoFlaw) {
  plan::Strategy strategy = StrategyOf(geometry(), plan());
  strategy.certificate.d = Errors().pose.head<3>();
  strategy.certificate.w = Errors().pose.tail<3>();
  strategy.certificate.velocity = Errors().velocity;
  strategy.certificate.absorbed = plan().absorbed;
  strategy.certificate.friction = plan().friction_limit;
  EXPECT_THAT(FlawsOfStrategy(geometry(), strategy), testing::IsEmpty());
}

// However the shaft is turned about its own axis, the strategy makes the same contacts.
TEST_F(RoundMating, TheTurnOfTheShaftDoesNotMatter) {
  const Pose& start = plan().X_StationaryStart;
  const Vector3 axis = start.linear() * geometry().passage.moving.shafts.front().axis;
  const ExactReplay replay{.passage = geometry().passage,
                           .X_StationaryStart = start,
                           .motions = plan().motions,
                           .velocity_error = 0};
  for (const double turn : {-3.0, -1.0, 0.0, 0.5, 2.0}) {
    PoseChange error = PoseChange::Zero();
    error.tail<3>() = turn * axis;
    RandomStream random(1, "turned shafts");
    EXPECT_FALSE(DeviationOf(replay, error, random)) << turn;
  }
}

// The usual searches find nothing for a bar of 12 by 9 mm, and the diverse ones do.
TEST(SmallMating, HasAStrategyThatDiverseSearchesFind) {
  const domain::Problem problem = domain::LoadScenario("key-bar");
  const MatingGeometry geometry = GeometryOf(problem, problem.matings.front());
  EXPECT_NEAR(TipSize(geometry.passage), std::hypot(6, 4.5) * 1e-3, 3e-4);
  FineMotionErrors errors;
  errors.pose << Vector3::Constant(problem.mating_errors.displacement),
      Vector3::Constant(problem.mating_errors.rotation);
  StrategyOptions options = {.friction = 0.25, .thorough_nodes = 0};
  EXPECT_TRUE(SearchStrategy(geometry.passage, errors, options).found());
  options.diverse_rounds = 0;
  EXPECT_FALSE(SearchStrategy(geometry.passage, errors, options).found());
}

}  // namespace
}  // namespace assay::finemotion::round_mating_test
