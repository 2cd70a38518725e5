#include "planner/constraint_posting/posting_planner.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "planner/base/random.h"
#include "planner/plan/checker/checker.h"
#include "planner/plan/plan_files/plan_file.h"
#include "tests/planner/constraint_posting/scenarios.h"
#include "tests/planner/plan/actions.h"

#include <nlohmann/json.hpp>

namespace assay::constraint_posting::posting_planner_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

constexpr int kMostOrders = 1000;

std::string Describe(const domain::Problem& problem, const plan::Action& action) {
  const auto name = [&](domain::PartId part) { return problem.part(part).name; };
  if (const auto* pickup = As(domain::kPickup, action)) {
    return "pickup " + name(pickup->part);
  }
  if (const auto* putdown = As(domain::kPutdown, action)) {
    const auto& model = *problem.part(putdown->part).model;
    const auto& poses = model.stable_poses();
    const auto pose = std::ranges::find(poses, putdown->place.position, &domain::StablePose::label);
    return "putdown " + name(putdown->part) + " " + pose->name;
  }
  const auto& mating = problem.mating(action.mating);
  return "assemble " + name(mating.held) + " " + name(mating.fixed);
}

std::vector<std::string> InOrderOfExecution(const domain::Problem& problem,
                                            const plan::Plan& plan) {
  std::vector<std::string> steps;
  for (plan::StepId id : plan.ExecutionOrder()) {
    steps.push_back(Describe(problem, plan.step(id).action));
  }
  return steps;
}

std::vector<std::string> Flaws(const domain::Problem& problem, const plan::Plan& plan) {
  std::vector<std::string> flaws;
  for (const plan::Flaw& flaw : plan::Check(problem, plan, kMostOrders).flaws) {
    flaws.push_back(flaw.what);
  }
  return flaws;
}

// Returns the actions of the plan of a scenario, after the independent checker has accepted it.
std::vector<std::string> PlanOf(const domain::Problem& problem) {
  const plan::PlanResult result = MakePlan(problem, {});
  EXPECT_EQ(result.outcome, Outcome::kFound);
  EXPECT_THAT(Flaws(problem, result.plan), IsEmpty());
  return InOrderOfExecution(problem, result.plan);
}

// The tests below plan figures 13 to 17 of Spar. The block is put on an end or on a side in
// between.
TEST(PostingPlanner, Figure13TurnsTheBlockTwice) {
  const domain::Problem problem = LoadScenario("spar-fig13");
  const auto plan = PlanOf(problem);
  ASSERT_EQ(plan.size(), 6u);
  EXPECT_EQ(plan[0], "pickup block");
  EXPECT_THAT(plan[1], HasSubstr("putdown block"));
  EXPECT_NE(plan[1], "putdown block on-back");
  EXPECT_EQ(plan[2], "pickup block");
  EXPECT_EQ(plan[3], "putdown block on-back");
  EXPECT_EQ(plan[4], "pickup peg");
  EXPECT_EQ(plan[5], "assemble peg block");
}

TEST(PostingPlanner, Figure14TurnsTheBlockOnce) {
  EXPECT_THAT(
      PlanOf(LoadScenario("spar-fig14")),
      ElementsAre("pickup block", "putdown block on-back", "pickup peg", "assemble peg block"));
}

TEST(PostingPlanner, Figure15NeedsThePegAlone) {
  EXPECT_THAT(PlanOf(LoadScenario("spar-fig15")), ElementsAre("pickup peg", "assemble peg block"));
}

TEST(PostingPlanner, Figure16RegraspsThePeg) {
  const auto plan = PlanOf(LoadScenario("spar-fig16"));
  ASSERT_EQ(plan.size(), 4u);
  EXPECT_EQ(plan[0], "pickup peg");
  EXPECT_THAT(plan[1], HasSubstr("putdown peg"));
  EXPECT_EQ(plan[2], "pickup peg");
  EXPECT_EQ(plan[3], "assemble peg block");
}

// The hand could not draw the lower brick back, and the upper one would fall.
TEST(PostingPlanner, WhatStandsOnAPartIsTakenAwayFirst) {
  const domain::Problem problem = ScenarioFrom(R"(
format: assay-scenario/1
units: {length: mm, angle: degree}
workcell: puma762-table
parts:
  lower: {model: brick, pose: {stable: upright, at: [600, 200]}}
  upper: {model: brick,
          pose: {columns: [[1, 0, 0], [0, 1, 0], [0, 0, 1], [600, 200, 152.4]]}}
goal:
  - located: {part: lower, stable: [on-side]}
)");
  const auto plan = PlanOf(problem);
  ASSERT_EQ(plan.size(), 4u);
  EXPECT_EQ(plan[0], "pickup upper");
  EXPECT_THAT(plan[1], HasSubstr("putdown upper"));
  EXPECT_EQ(plan[2], "pickup lower");
  EXPECT_EQ(plan[3], "putdown lower on-side");
}

// In figure 8, assemble, pickup peg, putdown block and pickup block are added in this order, and
// are executed 4, 3, 2, 1. In figure 9 the ordering is 2 before 1, 3 before 1, 4 before 3, and 3
// before 2.
TEST(PostingPlanner, TheWorkedExampleAddsItsStepsInThePapersOrder) {
  const domain::Problem problem = LoadScenario("spar-example");
  const plan::PlanResult result = MakePlan(problem, {});
  std::vector<std::string> inserted;
  std::vector<int> executed;
  for (const plan::PlannedStep& step : result.plan.steps) {
    inserted.push_back(Describe(problem, step.action));
    executed.push_back(step.executed);
  }
  EXPECT_THAT(inserted, ElementsAre("assemble peg block", "pickup peg", "putdown block on-back",
                                    "pickup block"));
  EXPECT_THAT(executed, ElementsAre(4, 3, 2, 1));
  const auto arc = [](int a, int b) { return std::pair{plan::StepId(a - 1), plan::StepId(b - 1)}; };
  EXPECT_THAT(result.plan.ordering,
              ::testing::IsSupersetOf({arc(2, 1), arc(3, 1), arc(4, 3), arc(3, 2)}));
}

TEST(PostingPlanner, TwoPegsGoIntoOneBlock) {
  const domain::Problem problem = LoadScenario("two-pegs");
  const auto plan = PlanOf(problem);
  EXPECT_EQ(plan.size(), 6u);
  EXPECT_EQ(std::ranges::count_if(plan, [](auto& step) { return step.starts_with("assemble"); }),
            2);
}

TEST(PostingPlanner, WhatIsInTheWayIsMovedFirst) {
  const auto plan = PlanOf(LoadScenario("clutter"));
  ASSERT_EQ(plan.size(), 6u);
  EXPECT_EQ(plan[0], "pickup brick");
  EXPECT_THAT(plan[1], HasSubstr("putdown brick"));
}

TEST(PostingPlanner, AnotherFamilyOfPartsNeedsNoOtherCode) {
  const auto plan = PlanOf(LoadScenario("keyed"));
  EXPECT_EQ(plan.back(), "assemble peg block");
}

TEST(PostingPlanner, GoalsThatHoldAreNotPlannedFor) {
  const domain::Problem problem = ScenarioFrom(R"(format: assay-scenario/1
units: {length: inch, angle: degree}
workcell: puma762-table
parts:
  block: {model: block, pose: {stable: on-back, at: [22, 0], yaw: 0}}
goal:
  - located: {part: block, stable: [on-back]}
)");
  const plan::PlanResult result = MakePlan(problem, {});
  EXPECT_EQ(result.outcome, Outcome::kFound);
  EXPECT_TRUE(result.plan.steps.empty());
}

TEST(PostingPlanner, APartCanBeWantedInAPoseBesidesAMating) {
  const domain::Problem problem = ScenarioFrom(R"(format: assay-scenario/1
units: {length: inch, angle: degree}
workcell: puma762-table
parts:
  block: {model: block, pose: {stable: on-back, at: [22, 6], yaw: 0}}
  peg: {model: peg, pose: {stable: on-side, at: [20, -8], yaw: 0}}
  brick: {model: brick, pose: {stable: BRP1, at: [26, -2], yaw: 0}}
goal:
  - assembled: {held: peg, fixed: block, features: [[7, 8], [7, 8]],
                pose: {columns: [[-1, 0, 0], [0, 1, 0], [0, 0, -1], [3, 0, 3.25]]},
                mating_vector: [-4, 0, 0]}
  - located: {part: brick, stable: [BRP3]}
)");
  const auto plan = PlanOf(problem);
  EXPECT_THAT(plan.size(), ::testing::Ge(4u));
  EXPECT_EQ(std::ranges::count(plan, "assemble peg block"), 1);
}

// Each brick needs two manipulations. The order of the bricks is free, and the hand holds one at a
// time.
TEST(PostingPlanner, GoalsOfManyPartsAreMetTogether) {
  std::string parts;
  std::string goals;
  for (int i = 0; i < 4; ++i) {
    parts += fmt::format("  brick{}: {{model: brick, pose: {{stable: upright, at: [{}, {}]}}}}\n",
                         i, 20 + 6 * (i % 2), -6 + 12 * (i / 2));
    goals += fmt::format("  - located: {{part: brick{}, stable: [on-front]}}\n", i);
  }
  const domain::Problem problem = ScenarioFrom(
      "format: assay-scenario/1\nunits: {length: inch, angle: degree}\n"
      "workcell: puma762-table\nparts:\n" +
      parts + "goal:\n" + goals);
  const auto plan = PlanOf(problem);
  EXPECT_THAT(plan.size(), ::testing::Ge(8u));
  EXPECT_EQ(std::ranges::count_if(plan,
                                  [](const std::string& step) {
                                    return step.starts_with("putdown") &&
                                           step.ends_with("on-front");
                                  }),
            4);
}

// After a mating the fixed part stays where it is, because the planner does not carry mated parts.
// Other planners might carry them, so there is no proof of impossibility.
TEST(PostingPlanner, MatedPartsAreNotCarriedTogether) {
  const plan::PlanResult result =
      MakePlan(ScenarioFrom(PegAndBlock("{stable: face-down, at: [22, 6], yaw: 30}",
                                        "{stable: on-side, at: [20, -8], yaw: -120}",
                                        "  - located: {part: block, stable: [face-down]}\n")),
               {});
  EXPECT_EQ(result.outcome, Outcome::kBudget);
  EXPECT_THAT(result.limits, ElementsAre(HasSubstr("nor carries mated parts together")));
}

TEST(PostingPlanner, MatedPartsStayMated) {
  const std::string mating =
      "  - assembled: {held: peg, fixed: block, features: [[7, 8], [7, 8]],\n"
      "      pose: {columns: [[-1, 0, 0], [0, 1, 0], [0, 0, -1], [3, 0, 3.25]]},\n"
      "      mating_vector: [-4, 0, 0]}\n";
  const std::string text =
      "format: assay-scenario/1\nunits: {length: inch, angle: degree}\n"
      "workcell: puma762-table\nparts:\n"
      "  block: {model: block, pose: {stable: on-back, at: [22, 6]}}\n  peg: {model: peg}\n"
      "initially:\n" +
      mating + "goal:\n";
  const plan::PlanResult kept = MakePlan(ScenarioFrom(text + mating), {});
  EXPECT_EQ(kept.outcome, Outcome::kFound);
  EXPECT_TRUE(kept.plan.steps.empty());
  const plan::PlanResult moved =
      MakePlan(ScenarioFrom(text + "  - located: {part: block, stable: [on-end]}\n"), {});
  EXPECT_EQ(moved.outcome, Outcome::kBudget);
  EXPECT_THAT(moved.limits, ElementsAre(HasSubstr("peg is mated into block at the start")));
}

TEST(PostingPlanner, TheImpossibleScenarioSaysWhy) {
  const plan::PlanResult result = MakePlan(LoadScenario("impossible"), {});
  EXPECT_EQ(result.outcome, Outcome::kNone);
  EXPECT_THAT(TextsOf(result.conflict),
              UnorderedElementsAre(HasSubstr("leans at most 10 deg"), HasSubstr("friction cone"),
                                   HasSubstr("block starts face-down")));
}

// The conflict is minimal: if any one of its constraints is left out, there is a plan.
TEST(PostingPlanner, LeavingOutAnyConstraintOfTheConflictGivesAPlan) {
  const auto result = [](const std::string& start, const std::string& end, int lean) {
    return MakePlan(ScenarioFrom(fmt::format(
                        "format: assay-scenario/1\nunits: {{length: inch, angle: degree}}\n"
                        "workcell: puma762-table\nrules: {{tool_lean: {}}}\nparts:\n"
                        "  brick: {{model: brick, pose: {{stable: {}, at: [24, 0]}}}}\n"
                        "goal:\n  - located: {{part: brick, stable: [{}]}}\n",
                        lean, start, end)),
                    {});
  };
  const plan::PlanResult impossible = result("upright", "on-front", 20);
  EXPECT_EQ(impossible.outcome, Outcome::kNone);
  EXPECT_THAT(TextsOf(impossible.conflict),
              UnorderedElementsAre("the tool leans at most 20 deg from straight down",
                                   "brick starts upright", "brick is to end on-front"));
  EXPECT_EQ(result("upright", "on-front", 60).outcome, Outcome::kFound);
  EXPECT_EQ(result("on-front", "on-front", 20).outcome, Outcome::kFound);
  EXPECT_EQ(result("upright", "upright", 20).outcome, Outcome::kFound);
}

TEST(PostingPlanner, ASpentBudgetIsNotAProof) {
  const plan::PlanResult result = MakePlan(LoadScenario("spar-fig13"), {.partial_plans = 20});
  EXPECT_EQ(result.outcome, Outcome::kBudget);
  EXPECT_TRUE(result.plan.steps.empty());
}

TEST(PostingPlanner, TheSameProblemGivesTheSameBytes) {
  const domain::Problem problem = LoadScenario("spar-fig13");
  const auto bytes = [&] { return plan::ToJson(MakePlan(problem, {}), problem, "s").dump(); };
  EXPECT_EQ(bytes(), bytes());
}

// Instances are made one by one. Each has other labels, and each works.
TEST(PostingPlanner, InstancesAreDistinctAndWork) {
  const domain::Problem problem = LoadScenario("spar-fig15");
  std::set<std::string> seen;
  int wrong = 0;
  PlannerOptions options;
  options.accept = [&](const plan::Plan& plan) {
    std::string labels;
    for (const auto& step : plan.steps) {
      labels += step.action.hold.grasp + " ";
    }
    EXPECT_TRUE(seen.insert(labels).second) << labels;
    wrong += !Flaws(problem, plan).empty();
    return seen.size() == 10;
  };
  EXPECT_EQ(MakePlan(problem, options).outcome, Outcome::kFound);
  EXPECT_EQ(seen.size(), 10u);
  EXPECT_EQ(wrong, 0);
}

// The planner finds plans for moved and turned parts, and the independent checker accepts every
// plan. If there is no plan, because parts are out of reach, the planner proves it.
TEST(PostingPlanner, MovedAndTurnedPartsGetPlansThatFit) {
  const std::vector<std::string> block_poses = {"face-down", "on-back", "on-end", "on-side"};
  const std::vector<std::string> peg_poses = {"on-side", "shaft-up"};
  int planned = 0;
  int proved = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream random(seed, "variants");
    const auto at = [&](double low, double high) {
      return fmt::format("at: [{:.2f}, {:.2f}], yaw: {:.1f}", random.Uniform(18, 30),
                         random.Uniform(low, high), random.Uniform(-180, 180));
    };
    const std::string block =
        fmt::format("{{stable: {}, {}}}", block_poses[random.Index(4)], at(3, 14));
    const std::string peg =
        fmt::format("{{stable: {}, {}}}", peg_poses[random.Index(2)], at(-14, -5));
    const domain::Problem problem = ScenarioFrom(PegAndBlock(block, peg));
    const plan::PlanResult result = MakePlan(problem, {});
    SCOPED_TRACE(block + " " + peg);
    if (result.outcome == Outcome::kFound) {
      ++planned;
      EXPECT_THAT(Flaws(problem, result.plan), IsEmpty());
    } else {
      EXPECT_EQ(result.outcome, Outcome::kNone);
      ++proved;
    }
  }
  EXPECT_GE(planned, 30);
  EXPECT_EQ(planned + proved, 40);
}

}  // namespace
}  // namespace assay::constraint_posting::posting_planner_test
