#include "planner/assembly/plan_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

#include "planner/assembly/certified_plan.h"
#include "planner/assembly/travel/travel_plan.h"
#include "planner/plan/certificates/condition_table.h"
#include "tests/planner/constraint_posting/scenarios.h"
#include "tests/scratch_file.h"

namespace assay::assembly::plan_check_test {
namespace {

using plan::Strategy;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::Each;
using ::testing::Field;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

TEST(PlanCheck, ReplaysStrategies) {
  const domain::Problem problem = constraint_posting::LoadScenario("uncertain-fine-motion");
  const plan::Plan plan = MakeCertifiedPlan(problem, {}, {}).plan;
  EXPECT_THAT(assembly::Check(problem, plan, 10).flaws, IsEmpty());

  const auto step = static_cast<std::size_t>(
      std::ranges::find_if(plan.steps, [](const auto& s) { return s.strategy.has_value(); }) -
      plan.steps.begin());
  ASSERT_LT(step, plan.steps.size());
  const auto expect = [&](const std::function<void(Strategy&)>& change, const char* words) {
    plan::Plan tampered = plan;
    change(*tampered.steps[step].strategy);
    const std::vector<plan::Flaw> flaws = assembly::Check(problem, tampered, 10).flaws;
    EXPECT_THAT(flaws, Not(IsEmpty())) << words;
    EXPECT_THAT(flaws, Each(AllOf(Field(&plan::Flaw::step, plan::StepId(step)),
                                  Field(&plan::Flaw::what, HasSubstr("the strategy: ")),
                                  Field(&plan::Flaw::what, HasSubstr(words)))));
  };
  expect([](Strategy& s) { s.X_FixedStart.translation().y() += 2e-3; }, "motion ");
  expect([](Strategy& s) { s.certificate.d *= 3; }, "motion ");
  expect([](Strategy& s) { s.certificate.absorbed = 4; }, "motion ");
  expect([](Strategy& s) { s.certificate.absorbs.push_back(plan::condition::kHandClear); },
         "'hand clear'");
}

TEST(PlanCheck, StrategiesAreCertainForTheArmsVelocity) {
  domain::Problem problem = constraint_posting::LoadScenario("uncertain-fine-motion");
  const plan::Plan plan = MakeCertifiedPlan(problem, {}, {}).plan;
  EXPECT_THAT(FlawsOfStrategies(problem, plan), IsEmpty());
  problem.mating_errors.velocity *= 1.5;
  EXPECT_THAT(FlawsOfStrategies(problem, plan),
              Contains(Field(&plan::Flaw::what, HasSubstr("err by 0.002, and they may by 0.003"))));
}

TEST(PlanCheck, StrategiesCountOnTheGreatestFriction) {
  domain::Problem problem = constraint_posting::LoadScenario("uncertain-fine-motion");
  const plan::Plan plan = MakeCertifiedPlan(problem, {}, {}).plan;
  problem.tolerances.friction = 0.1;
  EXPECT_THAT(FlawsOfStrategies(problem, plan),
              Contains(Field(&plan::Flaw::what, HasSubstr("at most 0.25, and there may be 0.35"))));
}

// The strategy was found for holes that may be narrower than nominal.
TEST(PlanCheck, TakesTheNarrowestHoles) {
  domain::Problem problem = constraint_posting::LoadScenario("uncertain-fine-motion");
  problem.tolerances.clearance = 0.02e-3;
  const plan::Plan plan = MakeCertifiedPlan(problem, {}, {}).plan;
  ASSERT_TRUE(
      std::ranges::any_of(plan.steps, [](const auto& s) { return s.strategy.has_value(); }));
  EXPECT_THAT(assembly::Check(problem, plan, 10).flaws, IsEmpty());
  problem.tolerances.clearance = 0.2e-3;
  EXPECT_THAT(FlawsOfStrategies(problem, plan), Not(IsEmpty()));
}

constexpr char kPartHead[] =
    "format: assay-part/1\nunits: {length: mm, angle: degree}\nfriction: 0.03\n";

void WritePart(const std::filesystem::path& models, const std::string& name,
               const std::string& rest) {
  std::filesystem::create_directories(models / "parts" / name);
  std::ofstream(models / "parts" / name / "part.yaml") << kPartHead << "name: " << name << "\n"
                                                       << rest;
}

// Returns a problem in which a block with a low shaft goes into a base of steel.
domain::Problem BlockIntoBase() {
  const std::filesystem::path models = ScratchFile("near-base");
  WritePart(models, "base",
            "initial: B\ndensity: 7800\nsolids:\n  body: {box: [[-24, -30, 0], [24, 30, 20]]}\n"
            "pockets:\n"
            "  hole: {cut_from: body, box: [[-10, -10, 10], [10, 10, 20]], widen: [x, y]}\n"
            "features:\n  1: {hole: hole, axis: +z, what: hole}\nstable_poses: {up: -z}\n");
  WritePart(models, "block",
            "initial: P\ndensity: 700\nsolids:\n  head: {box: [[-15, -20, 0], [15, 20, 25]]}\n"
            "  shaft: {box: [[-10, -10, -10], [10, 10, 0]]}\n"
            "features:\n  1: {shaft: shaft, axis: -z, what: shaft}\nstable_poses: {head: +z, xm: "
            "-x, ym: -y, yp: +y}\n");
  domain::ModelPath path(models);
  path.Append(std::string(ASSAY_SOURCE_DIR) + "/models");
  return domain::ReadProblem(
      Document::Parse(
          "format: assay-scenario/1\nunits: {length: mm, angle: degree}\n"
          "workcell: puma560-table\nclearance: 1\nsensing: [coarse-camera]\nrules: {pad_friction: "
          "0.12}\nparts:\n"
          "  base: {model: base, pose: {stable: up, at: [508.3, 53.8], yaw: 248.6},\n"
          "         error: {x: 0.07575, y: 0.07575, theta: 0.2525}}\n"
          "  block: {model: block, pose: {stable: xm, at: [596.2, -128.7], yaw: 190.8},\n"
          "          error: {x: 0.2525, y: 0.07575, theta: 0.07575}}\n"
          "gripper: {error: {x: 0.0037875, y: 0.0037875, z: 0.02, theta: 0.07575}}\n"
          "goal:\n  - assembled:\n      held: block\n      fixed: base\n"
          "      features: [[1], [1]]\n"
          "      pose: {columns: [[1, 0, 0], [0, 1, 0], [0, 0, 1], [0, 0, 20]]}\n"
          "      mating_vector: [0, 0, -20]\n",
          "scenario.yaml"),
      path);
}

// Where the held part is poised near the other one, it takes another path than the usual one.
// Everywhere else this path keeps more than the least clearance, and it is proved all the same.
TEST(PlanCheck, ConfirmsWaysThatEndNearAPart) {
  domain::Problem problem = BlockIntoBase();
  for (const double from : {0.0140, 0.0155, 0.0200}) {
    problem.matings.front().mating_vector = {0, 0, -from};
    const plan::PlanResult result = MakeCertifiedPlan(problem, {}, {});
    ASSERT_EQ(result.outcome, Outcome::kFound) << from;
    EXPECT_THAT(assembly::Check(problem, result.plan, 10).flaws, IsEmpty()) << from;
  }
}

// The first phase says why it moves a part away before anything is certified. Such a plan gets its
// travels, and no preconditions.
TEST(PlanCheck, APlanThatIsNotCertifiedYetGetsTravelsAlone) {
  const domain::Problem problem = constraint_posting::LoadScenario("spar-fig13");
  plan::Plan plan = MakeCertifiedPlan(problem, {}, {}).plan;
  for (plan::PlannedStep& step : plan.steps) {
    step.certificate = {};
    step.certificate.resolutions.push_back({.resolver = "moving", .why = "a part is in the way"});
  }
  TravelEffort effort;
  EXPECT_FALSE(AddTravels(problem, effort, plan));
  for (const plan::PlannedStep& step : plan.steps) {
    EXPECT_THAT(step.certificate.preconditions, IsEmpty());
  }
}

}  // namespace
}  // namespace assay::assembly::plan_check_test
