#include "planner/finemotion/strategy_search/likely_errors.h"

#include <gtest/gtest.h>

#include <numbers>

#include "planner/finemotion/strategy_checks/exact_replay.h"
#include "tests/planner/domain/scenario.h"

namespace assay::finemotion::likely_errors_test {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

// A mating of a square peg with little play, and its strategy.
struct PlannedMating {
  MatingGeometry geometry;
  FineMotionErrors errors;
  StrategyOptions options;
  FineMotionPlan plan;
  plan::Strategy strategy;

  ExactReplay replay() const {
    return {.passage = geometry.passage,
            .X_StationaryStart = plan.X_StationaryStart,
            .motions = plan.motions,
            .radius = options.radius,
            .velocity_error = errors.velocity};
  }
};

PlannedMating SquarePeg() {
  const domain::Problem problem =
      domain::ReadProblem(Document::Load(domain::ScenarioPath("mate-square")),
                          domain::ModelsFolder(), {.clearance = 0.2e-3});
  PlannedMating mating{.geometry = GeometryOf(problem, problem.matings.front()),
                       .errors = {},
                       .options = {},
                       .plan = {},
                       .strategy = {}};
  mating.errors.pose << Vector3::Constant(2e-3), Vector3::Constant(kDegree);
  mating.plan = SearchStrategy(mating.geometry.passage, mating.errors, mating.options);
  mating.strategy = StrategyOf(mating.geometry, mating.plan, mating.options);
  TellLikelyErrors(mating.geometry, mating.plan, mating.errors, mating.options, mating.strategy);
  return mating;
}

const plan::TipError* LikelyErrorOf(const plan::Strategy& strategy, const Deviation& deviation) {
  for (const auto& unwanted : strategy.motions[deviation.motion].unwanted) {
    const auto& contact = strategy.contacts[static_cast<std::size_t>(unwanted.contact)];
    if (contact.name != Name(deviation.unwanted.contact)) continue;
    if (unwanted.is_loss == deviation.unwanted.is_loss && unwanted.likely) return &*unwanted.likely;
  }
  return nullptr;
}

// The errors lead to an error state. If the likely error of that state is subtracted, most motions
// go as planned. Without this subtraction only a few motions go as planned, because the directions
// of motion have new errors.
TEST(LikelyErrors, LeadMostErrorsOutOfTheirErrorStates) {
  const PlannedMating mating = SquarePeg();
  RandomStream random(31, "errors that were not drawn before");
  int told = 0;
  int as_planned = 0;
  for (int i = 0; i < 400; ++i) {
    PoseChange error;
    for (int k = 0; k < kPoseDimensions; ++k)
      error[k] = 2 * mating.errors.pose[k] * random.Uniform(-1, 1);
    const auto deviation = DeviationOf(mating.replay(), error, random);
    if (!deviation) continue;
    const plan::TipError* likely = LikelyErrorOf(mating.strategy, *deviation);
    if (likely == nullptr) continue;
    ++told;
    PoseChange left = error;
    left.head<3>() -= likely->d;
    left.tail<3>() -= likely->w;
    as_planned += DeviationOf(mating.replay(), left, random) ? 0 : 1;
  }
  EXPECT_GT(told, 100);
  EXPECT_GT(as_planned, told / 2);
}

}  // namespace
}  // namespace assay::finemotion::likely_errors_test
