#include "planner/constraint_posting/uncertainty_phase/augmentation/best_known.h"

#include <gtest/gtest.h>

#include <vector>

#include "planner/base/random.h"
#include "planner/constraint_posting/uncertainty_phase/uncertainty_phase.h"
#include "planner/plan/certificates/condition_table.h"
#include "tests/planner/constraint_posting/scenarios.h"

namespace assay::constraint_posting::best_known_test {
namespace {

using plan::Plan;
using uncertainty::Propagation;
using uncertainty::SnapshotId;

struct Least {
  int errors = 0;
  double violation = 0;
};

Least LeastOf(const domain::Problem& problem, const Plan& instance,
              const std::vector<plan::Condition>& absorbable = {}) {
  BestKnown best(problem, Propagation::kSound, {});
  Least least;
  SnapshotId snapshot = best.Beginning();
  for (const plan::Action& action : ActionsOf(instance)) {
    snapshot = best.After(snapshot, action, nullptr);
    const Shortfall shortfall = best.LeastShortfall(snapshot, absorbable);
    least.errors += shortfall.goals > 0 ? 1 : 0;
    least.violation += shortfall.violation;
  }
  return least;
}

class Bounded : public ::testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(, Bounded,
                         ::testing::Values("uncertain-failing", "uncertain-sensing",
                                           "uncertain-squeezing", "uncertain-held", "spar-fig13",
                                           "spar-fig15", "spar-fig16"),
                         [](const auto& param) {
                           std::string name = param.param;
                           std::erase(name, '-');
                           return name;
                         });

// The bound holds for all errors of the parts and for all remedies.
TEST_P(Bounded, NoAugmentedInstanceIsBetter) {
  for (const double scale : {0.02, 0.3, 1.0, 3.0}) {
    SCOPED_TRACE(scale);
    domain::Problem problem = LoadScenario(GetParam());
    for (domain::Part& part : problem.parts) {
      for (Interval* error : {&part.error.x, &part.error.y, &part.error.z, &part.error.theta}) {
        *error = {scale * error->low, scale * error->high};
      }
    }
    ASSERT_TRUE(BestKnown::Bounds(problem, Propagation::kSound));
    for (const Plan& instance : Instances(problem, 2)) {
      const Least least = LeastOf(problem, instance);
      const AugmentedPlanInstance augmented = Augment(problem, instance, {});
      EXPECT_LE(least.errors, augmented.plan.errors);
      EXPECT_LE(least.violation, augmented.violation);
    }
  }
}

// Returns figure 15 with a camera that does not measure heights. With the errors of the paper, only
// the heights then remain unproved.
domain::Problem Figure15WithoutHeights() {
  domain::Problem problem = LoadScenario("spar-fig15");
  problem.sensors = {"coarse-camera"};
  return problem;
}

TEST(BestKnown, HeightsStayAsTheyAreWhereNoSensorMeasuresThem) {
  domain::Problem problem = Figure15WithoutHeights();
  const Plan instance = Instances(problem, 1).front();
  EXPECT_EQ(LeastOf(problem, instance).errors, 1);
  for (domain::Part& part : problem.parts) part.error.z = {};
  EXPECT_EQ(LeastOf(problem, instance).errors, 0);
}

TEST(BestKnown, HeightsThatASensorMeasuresAreNotMissing) {
  const domain::Problem problem = LoadScenario("spar-fig15");
  EXPECT_EQ(LeastOf(problem, Instances(problem, 1).front()).errors, 0);
}

TEST(BestKnown, WhatMayBeAbsorbedIsNotMissing) {
  const domain::Problem problem = Figure15WithoutHeights();
  const Plan instance = Instances(problem, 1).front();
  EXPECT_EQ(LeastOf(problem, instance).errors, 1);
  EXPECT_EQ(LeastOf(problem, instance,
                    {plan::condition::kEntry, plan::condition::kSlideIn, plan::condition::kTilt,
                     plan::condition::kSeat})
                .errors,
            0);
}

TEST(BestKnown, BoundsNothingWhereErrorsAreNotAboutZeroOrMayCancel) {
  domain::Problem problem = LoadScenario("uncertain-sensing");
  EXPECT_FALSE(BestKnown::Bounds(problem, Propagation::kPaper));
  problem.parts[0].error.x = {1e-4, 1e-3};
  EXPECT_FALSE(BestKnown::Bounds(problem, Propagation::kSound));
}

}  // namespace
}  // namespace assay::constraint_posting::best_known_test
