#include "planner/constraint_posting/uncertainty_phase/verification.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "planner/plan/certificates/condition_table.h"
#include "tests/planner/constraint_posting/scenarios.h"
#include "tests/planner/plan/actions.h"

namespace assay::constraint_posting::verification_test {
namespace {

using domain::MeasuredQuantity;
using domain::RecoveryStrategy;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr double kRounding = 1e-12;  // metres

class Verification : public ::testing::Test {
 protected:
  // Returns the plan with the verification after the action. `doubt` is the greatest distance,
  // metres, between the expected and the actual place of a contact.
  plan::Plan After(const plan::Action& action, double doubt = 0) const {
    const double travel = problem_.workcell->rules().guarded_travel;
    plan::Certificate certificate;
    certificate.preconditions = {{.condition = plan::condition::kSeat,
                                  .meaning = {},
                                  .expression = {},
                                  .limit = travel,
                                  .bound = doubt,
                                  .margin = travel - doubt,
                                  .method = {}}};
    plan::Plan plan;
    AddVerification(problem_, kStep, action, certificate, plan);
    return plan;
  }

  // Returns the first action of a kind in the plan that turns the block and assembles.
  const plan::Action& First(const domain::ActionKind& kind) const {
    return *std::ranges::find(actions_, &kind, &plan::Action::kind);
  }

  static std::vector<std::string> ErrorsOf(const plan::Plan& plan) {
    std::vector<std::string> errors;
    for (const plan::Recovery& recovery : plan.recoveries) errors.push_back(recovery.error);
    return errors;
  }

  static constexpr plan::StepId kStep{7};
  domain::Problem problem_ = LoadScenario("spar-fig14");
  std::vector<plan::Action> actions_ = ActionsOf(FirstInstance(problem_));
};

// In figures 11 and 12 of Spar, an empty hand starts a local search, and if a wrong object is in
// the hand, the operator is called.
TEST_F(Verification, OfAPickupReadsTheOpeningOfTheGripper) {
  const plan::Plan plan = After(First(domain::kPickup));
  ASSERT_THAT(plan.verifications, SizeIs(1));
  const plan::Verification& check = plan.verifications.front();
  EXPECT_EQ(check.step, kStep);
  EXPECT_EQ(check.name, "gripper-opening");
  EXPECT_EQ(check.quantity, MeasuredQuantity::kGripperOpening);
  EXPECT_EQ(check.expected, First(domain::kPickup).hold.width);
  EXPECT_EQ(check.below, "error1");
  EXPECT_EQ(check.above, "error2");

  ASSERT_THAT(ErrorsOf(plan), ElementsAre("error1", "error2"));
  EXPECT_EQ(plan.recoveries[0].step, kStep);
  EXPECT_EQ(plan.recoveries[0].strategy, RecoveryStrategy::kGropingSearch);
  EXPECT_NEAR(plan.recoveries[0].radius, 0.010, kRounding);
  EXPECT_NEAR(plan.recoveries[0].pitch, 0.003, kRounding);
  EXPECT_EQ(plan.recoveries[1].strategy, RecoveryStrategy::kCallOperator);
}

// The expected opening must differ clearly from the opening of an empty gripper, and from the
// opening with another part.
TEST_F(Verification, TheTwoErrorsOfAPickupAreFarFromTheExpectedOpening) {
  const plan::Verification check = After(First(domain::kPickup)).verifications.front();
  EXPECT_GT(check.tolerance, 0);
  EXPECT_GT(check.expected - check.tolerance, 0);
  EXPECT_LT(check.expected + check.tolerance, problem_.workcell->gripper().max_opening());
}

TEST_F(Verification, OfAPutdownReadsWhereTheToolMetTheTable) {
  const auto& putdown = First(domain::kPutdown);
  const plan::Plan plan = After(putdown);
  ASSERT_THAT(plan.verifications, SizeIs(1));
  EXPECT_EQ(plan.verifications[0].quantity, MeasuredQuantity::kToolHeight);
  EXPECT_NEAR(plan.verifications[0].expected,
              (putdown.place.X_WorldPart * putdown.hold.X_PartTool).translation().z(), kRounding);
  // Both a low and a high position are the same error here, for which one recovery is enough.
  EXPECT_THAT(ErrorsOf(plan), ElementsAre("error3"));
}

TEST_F(Verification, OfAnAssemblyReadsWhereItEnded) {
  const auto& assemble = First(domain::kAssemble);
  const plan::Plan plan = After(assemble);
  ASSERT_THAT(plan.verifications, SizeIs(1));
  EXPECT_EQ(plan.verifications[0].quantity, MeasuredQuantity::kToolHeight);
  const geometry::Pose X_WorldTool = assemble.place.X_WorldPart *
                                     problem_.mating(assemble.mating).X_FixedHeld *
                                     assemble.hold.X_PartTool;
  EXPECT_NEAR(plan.verifications[0].expected, X_WorldTool.translation().z(), kRounding);
  EXPECT_THAT(ErrorsOf(plan), ElementsAre("error3", "error4"));
}

// If the height of the block is uncertain, the height of the seated peg is equally uncertain. That
// deviation is no error.
TEST_F(Verification, AHeightMayBeAsFarOffAsItsCertificateSays) {
  const auto& assemble = First(domain::kAssemble);
  const double sure = After(assemble).verifications[0].tolerance;
  EXPECT_NEAR(After(assemble, 0.0028).verifications[0].tolerance, sure + 0.0028, kRounding);
  const auto& pickup = First(domain::kPickup);
  EXPECT_EQ(After(pickup, 0.0028).verifications[0].tolerance,
            After(pickup).verifications[0].tolerance)
      << "an opening is no height";
}

// A peg falls into its hole if both horizontal coordinates are within the clearance. Some place of
// the search must be that near, for every rotation of the hole.
TEST_F(Verification, ASearchIsFineEnoughForTheClearance) {
  const auto& assemble = First(domain::kAssemble);
  const plan::Plan plan = After(assemble);
  const plan::Recovery& search = plan.recoveries[1];
  ASSERT_EQ(search.strategy, RecoveryStrategy::kGropingSearch);
  const double clearance = problem_.part(problem_.mating(assemble.mating).fixed).model->clearance();
  ASSERT_GT(clearance, 0);
  EXPECT_LT(search.pitch / 2 * std::numbers::sqrt2, clearance);
  EXPECT_GT(search.pitch, clearance) << "finer than that is waste";
}

TEST_F(Verification, NothingChecksWhatIsInsertedOnlyWhereItIsProved) {
  const auto& pickup = First(domain::kPickup);
  for (const plan::Action& action :
       std::vector<plan::Action>{plan::Sense(pickup.part, "overhead-camera", pickup.place),
                                 plan::Squeeze(pickup.part, pickup.hold, pickup.place)}) {
    const plan::Plan plan = After(action);
    EXPECT_THAT(plan.verifications, IsEmpty());
    EXPECT_THAT(plan.recoveries, IsEmpty());
  }
}

TEST_F(Verification, EveryTemplateOfTheWorkcellIsUsed) {
  const auto& templates = problem_.workcell->uncertainty_operations().verifications;
  std::size_t used = 0;
  for (const plan::Action& action : std::vector<plan::Action>{
           First(domain::kPickup), First(domain::kPutdown), First(domain::kAssemble)}) {
    for (const plan::Verification& check : After(action).verifications) {
      const auto original =
          std::ranges::find(templates, check.name, &domain::VerificationTemplate::name);
      ASSERT_NE(original, templates.end());
      EXPECT_EQ(check.tolerance, original->tolerance);
      EXPECT_EQ(check.below, original->below);
      EXPECT_EQ(check.above, original->above);
      ++used;
    }
  }
  EXPECT_EQ(used, templates.size());
}

TEST_F(Verification, TwoStepsHaveRecoveriesOfTheirOwn) {
  plan::Plan plan;
  AddVerification(problem_, plan::StepId(0), First(domain::kPickup), {}, plan);
  AddVerification(problem_, plan::StepId(1), First(domain::kPickup), {}, plan);
  EXPECT_THAT(ErrorsOf(plan), ElementsAre("error1", "error2", "error1", "error2"));
  EXPECT_EQ(plan.recoveries[2].step, plan::StepId(1));
}

}  // namespace
}  // namespace assay::constraint_posting::verification_test
