#include "planner/constraint_posting/resolvers/resolver.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "planner/constraint_posting/resolvers/plan_states.h"
#include "planner/constraint_posting/resolvers/sensing_resolver.h"
#include "planner/constraint_posting/resolvers/squeezing_resolver.h"
#include "planner/constraint_posting/uncertainty_phase/uncertainty_phase.h"
#include "planner/plan/certificates/condition_table.h"
#include "planner/plan/checker/checker.h"
#include "tests/planner/constraint_posting/scenarios.h"
#include "tests/planner/plan/actions.h"

namespace assay::constraint_posting::resolver_test {
namespace {

using domain::PartId;
using plan::Plan;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

// The first plan instance of a scenario. At() makes unmet goals for one of its steps, as if they
// concerned all parts.
struct Asked {
  explicit Asked(const std::string& scenario)
      : problem(LoadScenario(scenario)), actions(ActionsOf(FirstInstance(problem))) {}

  UnmetGoals At(int step) const {
    std::vector<PartId> parts;
    for (std::size_t p = 0; p < problem.parts.size(); ++p) parts.emplace_back(p);
    return {problem, actions, step, {}, parts};
  }
  int last() const { return static_cast<int>(actions.size()) - 1; }

  domain::Problem problem;
  std::vector<plan::Action> actions;
};

PartId PartOf(const plan::Action& action) {
  const auto* sense = As(domain::kSense, action);
  return sense != nullptr ? sense->part : action.part;
}

// Returns the plan that executes these actions one after another.
Plan InThisOrder(const domain::Problem& problem, const std::vector<plan::Action>& actions) {
  Plan plan = {.problem = problem.name};
  for (std::size_t i = 0; i < actions.size(); ++i) {
    const int number = static_cast<int>(i) + 1;
    plan.steps.push_back({.name = "action_" + std::to_string(number),
                          .action = actions[i],
                          .inserted = number,
                          .executed = number});
    if (i > 0) plan.ordering.emplace_back(plan::StepId(i - 1), plan::StepId(i));
  }
  return plan;
}

std::vector<plan::Action> With(const Remedy& remedy, const std::vector<plan::Action>& actions) {
  std::vector<plan::Action> all;
  for (int i = 0; i < std::ssize(actions); ++i) {
    for (const Insertion& insertion : remedy.insertions) {
      if (insertion.before == i) all.push_back(insertion.action);
    }
    all.push_back(actions[i]);
  }
  return all;
}

// The actions that a resolver inserts keep the operational and geometric preconditions of the whole
// plan. The checker, which shares no code with the resolver, finds no flaw.
TEST(Resolvers, ProposeWhatTheCheckerAccepts) {
  SensingResolver sensing;
  SqueezingResolver squeezing;
  int proposals = 0;
  for (const char* scenario : {"spar-fig14", "spar-fig16"}) {
    const Asked asked(scenario);
    for (int step = 0; step <= asked.last(); ++step) {
      for (Resolver* resolver : std::initializer_list<Resolver*>{&sensing, &squeezing}) {
        for (const Remedy& remedy : resolver->Propose(asked.At(step))) {
          ++proposals;
          const Plan plan = InThisOrder(asked.problem, With(remedy, asked.actions));
          for (const plan::Flaw& flaw : plan::Check(asked.problem, plan, 1).flaws) {
            ADD_FAILURE() << scenario << " step " << step << " " << resolver->name() << ": "
                          << flaw.what;
          }
        }
      }
    }
  }
  EXPECT_GT(proposals, 20);
}

TEST(Resolvers, InsertBeforeTheStepWhatIsAboutTheirPart) {
  const Asked asked("spar-fig13");
  SensingResolver sensing;
  SqueezingResolver squeezing;
  for (int step = 0; step <= asked.last(); ++step) {
    for (Resolver* resolver : std::initializer_list<Resolver*>{&sensing, &squeezing}) {
      for (const Remedy& remedy : resolver->Propose(asked.At(step))) {
        EXPECT_THAT(remedy.insertions, Not(IsEmpty()));
        EXPECT_THAT(remedy.absorbs, IsEmpty());
        for (const Insertion& insertion : remedy.insertions) {
          EXPECT_LE(insertion.before, step);
          EXPECT_EQ(PartOf(insertion.action), remedy.part);
        }
      }
    }
  }
}

// A resolver proposes remedies only for parts whose errors occur in the goals.
TEST(Resolvers, LeaveOtherPartsAlone) {
  const Asked asked("spar-fig14");
  const PartId peg = PartNamed(asked.problem, "peg");
  const UnmetGoals about_peg = {asked.problem, asked.actions, asked.last(), {}, {peg}};
  const UnmetGoals about_nothing = {asked.problem, asked.actions, asked.last(), {}, {}};
  SensingResolver sensing;
  SqueezingResolver squeezing;
  for (Resolver* resolver : std::initializer_list<Resolver*>{&sensing, &squeezing}) {
    const std::vector<Remedy> remedies = resolver->Propose(about_peg);
    EXPECT_THAT(remedies, Not(IsEmpty()));
    for (const Remedy& remedy : remedies) EXPECT_EQ(remedy.part, peg);
    EXPECT_THAT(resolver->Propose(about_nothing), IsEmpty());
  }
}

TEST(SensingResolver, LooksAtAPartInTheHandBeforeItIsTaken) {
  const Asked asked("spar-fig15");  // its actions are pickup of the peg and assemble
  const PartId peg = PartNamed(asked.problem, "peg");
  for (const Remedy& remedy : SensingResolver().Propose(asked.At(1))) {
    ASSERT_THAT(remedy.insertions, SizeIs(1));
    EXPECT_EQ(remedy.insertions[0].before, remedy.part == peg ? 0 : 1);
  }
}

TEST(SensingResolver, UsesAllowedSensorsOnly) {
  Asked asked("spar-fig15");
  for (const Remedy& remedy : SensingResolver().Propose(asked.At(1))) {
    EXPECT_EQ(remedy.insertions[0].action.sensor, "overhead-camera");
  }
  asked.problem.sensors.clear();
  EXPECT_THAT(SensingResolver().Propose(asked.At(1)), IsEmpty());
}

// With two sensors, the resolver proposes each alone and then both.
TEST(SensingResolver, CombinesSensors) {
  Asked asked("spar-fig15");
  asked.problem.sensors = {"overhead-camera", "close-camera"};
  std::vector<std::size_t> sizes;
  for (const Remedy& remedy : SensingResolver().Propose(asked.At(0))) {
    if (remedy.part == PartId(0)) sizes.push_back(remedy.insertions.size());
  }
  EXPECT_THAT(sizes, ElementsAre(1u, 1u, 2u));
}

geometry::Vector3 ClosingDirection(const plan::Action& action) {
  const auto& squeeze = action;
  return (squeeze.place.X_WorldPart * squeeze.hold.X_PartTool).linear().col(1);
}

TEST(SqueezingResolver, ClosesInDirectionsThatDiffer) {
  Asked asked("uncertain-squeezing");
  asked.problem.sensors.clear();
  const PartId post = PartNamed(asked.problem, "post");
  int singles = 0;
  int pairs = 0;
  for (const Remedy& remedy : SqueezingResolver().Propose(asked.At(0))) {
    if (remedy.part != post) continue;
    ASSERT_THAT(remedy.insertions, ::testing::SizeIs(::testing::AnyOf(1u, 2u)));
    if (remedy.insertions.size() == 1) {
      ++singles;
      continue;
    }
    ++pairs;
    const double cosine = ClosingDirection(remedy.insertions[0].action)
                              .dot(ClosingDirection(remedy.insertions[1].action));
    EXPECT_LT(std::abs(cosine), 0.99);
  }
  EXPECT_EQ(singles, 2);  // a standing square has two directions
  EXPECT_EQ(pairs, 2);    // the two directions in either order
}

// The resolver proposes one direction, then two directions, then a look before either. Squeezing
// with a look is the most expensive remedy.
TEST(SqueezingResolver, AlsoProposesALookBeforeWhereSensorsMayBeUsed) {
  const Asked asked("uncertain-squeezing");
  bool with_sensing = false;
  for (const Remedy& remedy : SqueezingResolver().Propose(asked.At(0))) {
    const bool looks = remedy.insertions.front().action.Is(domain::kSense);
    EXPECT_TRUE(looks || !with_sensing);
    with_sensing = looks;
    EXPECT_TRUE(remedy.insertions.back().action.Is(domain::kSqueeze));
  }
  EXPECT_TRUE(with_sensing);
}

TEST(SqueezingResolver, LeavesMatedPartsAlone) {
  Asked asked("uncertain-known");
  asked.problem.assembled.emplace_back(0);
  asked.actions.clear();
  EXPECT_THAT(SqueezingResolver().Propose(asked.At(0)), IsEmpty());
}

// Resolvers that exist only in this test. The uncertainty phase knows only their interface.

// A resolver whose execution absorbs the errors of some conditions, like fine motion.
class Absorbing : public Resolver {
 public:
  explicit Absorbing(std::vector<plan::Condition> conditions)
      : conditions_(std::move(conditions)) {}
  std::string_view name() const override { return "fine motion"; }
  std::vector<plan::Condition> absorbs() const override { return conditions_; }
  std::vector<Remedy> Propose(const UnmetGoals& unmet) override {
    asked_.push_back(unmet.step);
    return {{.part = unmet.parts.front(), .insertions = {}, .absorbs = conditions_}};
  }
  const std::vector<int>& asked() const { return asked_; }

 private:
  std::vector<plan::Condition> conditions_;
  std::vector<int> asked_;
};

// A resolver that makes the same proposals as sensing under another name.
class Scanner : public Resolver {
 public:
  std::string_view name() const override { return "scanner"; }
  // Makes the phase ask this resolver together with the resolvers that absorb errors.
  std::vector<plan::Condition> absorbs() const override { return {plan::condition::kEntry}; }
  std::vector<Remedy> Propose(const UnmetGoals& unmet) override {
    return SensingResolver().Propose(unmet);
  }
};

class Idle : public Resolver {
 public:
  std::string_view name() const override { return "idle"; }
  std::vector<Remedy> Propose(const UnmetGoals&) override { return {}; }
};

UncertaintyOptions Using(std::vector<std::shared_ptr<Resolver>> resolvers) {
  UncertaintyOptions options;
  options.resolvers = std::move(resolvers);
  return options;
}

Plan Augmented(const domain::Problem& problem, const UncertaintyOptions& options) {
  return Augment(problem, FirstInstance(problem), options).plan;
}

const plan::PlannedStep& AssembleStep(const Plan& plan) {
  return *std::ranges::find_if(
      plan.steps, [](const plan::PlannedStep& step) { return step.action.Is(domain::kAssemble); });
}

std::vector<std::string> NamesOf(const std::vector<plan::Resolution>& resolutions) {
  std::vector<std::string> names;
  for (const plan::Resolution& resolution : resolutions) names.push_back(resolution.resolver);
  return names;
}

TEST(ResolverInterface, WhatIsAbsorbedNeedsNoProof) {
  const domain::Problem problem = LoadScenario("uncertain-failing");
  const Plan failing = Augmented(problem, Using({std::make_shared<Idle>()}));
  ASSERT_EQ(failing.errors, 2);
  const Plan plan = Augmented(
      problem, Using({std::make_shared<Absorbing>(std::vector<plan::Condition>{
                   plan::condition::kEntry, plan::condition::kSlideIn, plan::condition::kSeat,
                   plan::condition::kTilt, plan::condition::kHolding, plan::condition::kStanding,
                   plan::condition::kPressed, plan::condition::kFingertip,
                   plan::condition::kFixedStands, plan::condition::kFixedStays,
                   plan::condition::kHandClear, plan::condition::kPassingClear})}));
  EXPECT_EQ(plan.errors, 1);  // the error of the pickup
  EXPECT_EQ(plan.steps.size(), failing.steps.size());
  EXPECT_LT(plan.verifications.size(), failing.verifications.size());
  const auto names = NamesOf(AssembleStep(plan).certificate.resolutions);
  EXPECT_THAT(names, ElementsAre("fine motion"));
  EXPECT_THAT(AssembleStep(plan).certificate.resolutions[0].why, Not(IsEmpty()));
}

TEST(ResolverInterface, AbsorbingAPartOfTheFailedConditionsIsNotEnough) {
  const domain::Problem problem = LoadScenario("uncertain-failing");
  const Plan plan =
      Augmented(problem, Using({std::make_shared<Absorbing>(std::vector<plan::Condition>{
                             plan::condition::kEntry, plan::condition::kSeat})}));
  EXPECT_EQ(plan.errors, 2);
}

TEST(ResolverInterface, AllConditionsOfAllStepsAbsorbedLeaveNoErrors) {
  const domain::Problem problem = LoadScenario("uncertain-failing");
  const plan::PlanResult result = MakeCertifiedPlan(
      problem, {},
      Using({std::make_shared<Absorbing>(std::vector<plan::Condition>{
          plan::condition::kBetweenFingers, plan::condition::kFingerClear,
          plan::condition::kFingertip, plan::condition::kPadContact, plan::condition::kEntry,
          plan::condition::kSlideIn, plan::condition::kSeat, plan::condition::kTilt,
          plan::condition::kHolding, plan::condition::kUpright, plan::condition::kPushedClear,
          plan::condition::kStanding, plan::condition::kPressed, plan::condition::kFixedStands,
          plan::condition::kFixedStays, plan::condition::kHandClear,
          plan::condition::kPassingClear})}));
  EXPECT_EQ(result.plan.errors, 0);
  EXPECT_THAT(result.plan.verifications, IsEmpty());
}

TEST(ResolverInterface, AResolverIsAskedOnlyAboutStepsThatFail) {
  const domain::Problem known = LoadScenario("uncertain-known");
  const auto unneeded = std::make_shared<Absorbing>(std::vector<plan::Condition>{});
  Augmented(known, Using({unneeded}));
  EXPECT_THAT(unneeded->asked(), IsEmpty());
  const domain::Problem held = LoadScenario("uncertain-held");
  const auto needed = std::make_shared<Absorbing>(std::vector<plan::Condition>{});
  Augmented(held, Using({needed}));
  EXPECT_THAT(needed->asked(), AllOf(Contains(1), ::testing::Each(1)));  // the step of the assemble
}

TEST(ResolverInterface, WhatAResolverInsertsCarriesItsName) {
  const Plan plan = Augmented(LoadScenario("uncertain-held"), Using({std::make_shared<Scanner>()}));
  EXPECT_EQ(plan.errors, 0);
  const auto& resolutions = AssembleStep(plan).certificate.resolutions;
  ASSERT_THAT(NamesOf(resolutions), ElementsAre("scanner"));
  ASSERT_THAT(resolutions[0].steps, SizeIs(1));
  EXPECT_TRUE(plan.step(resolutions[0].steps[0]).action.Is(domain::kSense));
}

TEST(ResolverInterface, EarlierResolversArePreferred) {
  const domain::Problem problem = LoadScenario("uncertain-held");
  const auto fine_motion = std::make_shared<Absorbing>(std::vector<plan::Condition>{
      plan::condition::kEntry, plan::condition::kSlideIn, plan::condition::kSeat,
      plan::condition::kTilt, plan::condition::kFingertip, plan::condition::kStanding,
      plan::condition::kPressed, plan::condition::kFixedStands, plan::condition::kFixedStays});
  const auto scanner = std::make_shared<Scanner>();
  const auto first_of = [&](const std::vector<std::shared_ptr<Resolver>>& resolvers) {
    return NamesOf(AssembleStep(Augmented(problem, Using(resolvers))).certificate.resolutions);
  };
  EXPECT_THAT(first_of({scanner, fine_motion}), ElementsAre("scanner"));
  EXPECT_THAT(first_of({fine_motion, scanner}), ElementsAre("fine motion"));
  EXPECT_THAT(first_of({std::make_shared<Idle>(), scanner}), ElementsAre("scanner"));
}

TEST(ResolverInterface, WhereNoneProposesAnythingFailureIsPreparedFor) {
  const Plan plan = Augmented(LoadScenario("uncertain-held"), Using({std::make_shared<Idle>()}));
  EXPECT_EQ(plan.errors, 1);
  EXPECT_THAT(NamesOf(AssembleStep(plan).certificate.resolutions), ElementsAre("verification"));
  EXPECT_THAT(plan.verifications, Not(IsEmpty()));
  EXPECT_THAT(plan.recoveries, Not(IsEmpty()));
}

// A squeeze is not inserted if the part may lie under a finger, although the squeeze would reduce
// the errors.
TEST(ResolverInterface, ARemedyWhoseOwnGoalsFailIsNotUsed) {
  const domain::Problem problem = LoadScenario("uncertain-failing");
  const Asked asked("uncertain-failing");
  std::vector<Remedy> squeezes = SqueezingResolver().Propose(asked.At(0));
  std::erase_if(squeezes, [&](const Remedy& r) { return r.part != PartNamed(problem, "peg"); });
  ASSERT_THAT(squeezes, Not(IsEmpty()));
  for (const Remedy& remedy : squeezes) {
    uncertainty::UncertainWorld world(problem, uncertainty::Propagation::kSound);
    EXPECT_THAT(uncertainty::CertifyStep(world, remedy.insertions[0].action, {}).unproved,
                Not(IsEmpty()));
  }
  EXPECT_EQ(Count(domain::kSqueeze, ActionsOf(Augmented(problem, {}))), 0);
}

}  // namespace
}  // namespace assay::constraint_posting::resolver_test
