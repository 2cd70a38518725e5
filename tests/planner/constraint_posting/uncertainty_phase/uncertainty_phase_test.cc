#include "planner/constraint_posting/uncertainty_phase/uncertainty_phase.h"
#include "planner/algebra/expression/evaluation.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <tuple>

#include "planner/algebra/bounds/bounds.h"
#include "planner/base/random.h"
#include "planner/constraint_posting/resolvers/squeezing_resolver.h"
#include "planner/numeric/interval_arithmetic.h"
#include "planner/plan/certificates/coverage.h"
#include "planner/plan/checker/checker.h"
#include "planner/plan/plan_files/plan_file.h"
#include "tests/oracle/certified_expressions.h"
#include "tests/planner/constraint_posting/scenarios.h"
#include "tests/planner/plan/actions.h"

namespace assay::constraint_posting::uncertainty_phase_test {
namespace {

using domain::PartId;
using plan::Plan;
using plan::PlannedStep;
using plan::StepId;
using ::testing::Each;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;
using uncertainty::Propagation;

constexpr int kMostOrders = 100;

UncertaintyOptions In(Propagation propagation) {
  UncertaintyOptions options;
  options.propagation = propagation;
  options.instances = 2;  // limit for scenarios that cannot be proved
  return options;
}

Plan CertifiedPlan(const domain::Problem& problem, const UncertaintyOptions& options = {}) {
  const plan::PlanResult result = MakeCertifiedPlan(problem, {}, options);
  EXPECT_EQ(result.outcome, Outcome::kFound);
  return result.plan;
}

// A resolver that proposes no remedy.
class Idle : public Resolver {
 public:
  std::string_view name() const override { return "idle"; }
  std::vector<Remedy> Propose(const UnmetGoals&) override { return {}; }
};

UncertaintyOptions WithoutRemedies() {
  UncertaintyOptions options;
  options.resolvers = {std::make_shared<Idle>()};
  options.instances = 1;
  return options;
}

bool IsProved(const PlannedStep& step) {
  return std::ranges::all_of(step.certificate.preconditions,
                             [](const auto& claim) { return claim.holds(); });
}

std::vector<StepId> Unproved(const Plan& plan) {
  std::vector<StepId> unproved;
  for (const StepId id : plan.ExecutionOrder()) {
    if (!IsProved(plan.step(id))) unproved.push_back(id);
  }
  return unproved;
}

// Returns the steps that the resolutions of all steps inserted.
std::set<StepId> InsertedSteps(const Plan& plan) {
  std::set<StepId> inserted;
  for (const PlannedStep& step : plan.steps) {
    for (const plan::Resolution& resolution : step.certificate.resolutions) {
      inserted.insert(resolution.steps.begin(), resolution.steps.end());
    }
  }
  return inserted;
}

// Returns how many of these actions cannot be proved when they are executed in this order.
int UnprovedAmong(const domain::Problem& problem, const std::vector<plan::Action>& actions,
                  Propagation propagation) {
  uncertainty::UncertainWorld world(problem, propagation);
  int unproved = 0;
  for (const plan::Action& action : actions) {
    unproved += uncertainty::CertifyStep(world, action, {}).unproved.empty() ? 0 : 1;
  }
  return unproved;
}

std::vector<plan::Action> ActionsWithout(const Plan& plan, StepId left_out) {
  std::vector<plan::Action> actions;
  for (const StepId id : plan.ExecutionOrder()) {
    if (id != left_out) actions.push_back(plan.step(id).action);
  }
  return actions;
}

const PlannedStep& StepWithMating(const Plan& plan) {
  return *std::ranges::find_if(
      plan.steps, [](const PlannedStep& step) { return step.action.Is(domain::kAssemble); });
}

// The tests below show the five answers of the second phase, each with a scenario.

TEST(UncertaintyPhase, NothingIsDoneAboutPartsThatAreKnownWellEnough) {
  const domain::Problem problem = LoadScenario("uncertain-known");
  const Plan plan = CertifiedPlan(problem);
  EXPECT_EQ(plan.errors, 0);
  EXPECT_EQ(ActionsOf(plan).size(), ActionsOf(FirstInstance(problem)).size());
  for (const PlannedStep& step : plan.steps) {
    EXPECT_THAT(step.certificate.preconditions, Not(IsEmpty()));
    EXPECT_THAT(step.certificate.resolutions, IsEmpty());
  }
  EXPECT_THAT(plan.verifications, IsEmpty());
  EXPECT_THAT(plan.recoveries, IsEmpty());
}

TEST(UncertaintyPhase, SensingIsEnoughWhereTheFitIsLoose) {
  const domain::Problem problem = LoadScenario("uncertain-sensing");
  EXPECT_GT(CertifiedPlan(problem, WithoutRemedies()).errors, 0);
  const Plan plan = CertifiedPlan(problem);
  EXPECT_EQ(plan.errors, 0);
  EXPECT_EQ(Count(domain::kSense, ActionsOf(plan)), 2);
  EXPECT_EQ(Count(domain::kSqueeze, ActionsOf(plan)), 0);
}

TEST(UncertaintyPhase, TwoPerpendicularSqueezesAreNeededWhereTheCameraIsTooCoarse) {
  const domain::Problem problem = LoadScenario("uncertain-squeezing");
  const Plan plan = CertifiedPlan(problem);
  EXPECT_EQ(plan.errors, 0);
  const std::vector<plan::Action> actions = ActionsOf(plan);
  EXPECT_EQ(Count(domain::kSense, actions), 0);
  ASSERT_EQ(Count(domain::kSqueeze, actions), 2);
  std::vector<geometry::Vector3> closing;
  for (const plan::Action& action : actions) {
    if (const auto* squeeze = As(domain::kSqueeze, action)) {
      EXPECT_EQ(squeeze->part, PartNamed(problem, "post"));
      closing.push_back((squeeze->place.X_WorldPart * squeeze->hold.X_PartTool).linear().col(1));
    }
  }
  EXPECT_NEAR(closing[0].dot(closing[1]), 0, 1e-6);
  // Both horizontal coordinates are known more precisely than the camera could measure.
  const auto& before = StepWithMating(plan).certificate.before;
  const auto post = std::ranges::find(before, PartNamed(problem, "post"), &plan::ErrorSet::part);
  const Interval camera = problem.workcell->uncertainty_operations().FindSensor("coarse-camera")->x;
  EXPECT_LT(post->x.high, camera.high);
  EXPECT_LT(post->y.high, camera.high);
}

// Spar allows no sensing while a part is held. Here the assembly fails when the sleeve is in the
// hand. The sleeve is therefore looked at before it is taken, although nothing about the pickup
// requires it.
TEST(UncertaintyPhase, ThePartInTheHandWasLookedAtBeforeItWasTaken) {
  const domain::Problem problem = LoadScenario("uncertain-held");
  EXPECT_EQ(Unproved(CertifiedPlan(problem, WithoutRemedies())).size(), 1u);
  const Plan plan = CertifiedPlan(problem);
  EXPECT_EQ(plan.errors, 0);
  const std::vector<plan::Action> actions = ActionsOf(plan);
  ASSERT_THAT(actions, SizeIs(3));
  ASSERT_TRUE(actions[0].Is(domain::kSense));
  EXPECT_EQ(actions[0].part, PartNamed(problem, "sleeve"));
  EXPECT_TRUE(actions[1].Is(domain::kPickup));
  EXPECT_TRUE(actions[2].Is(domain::kAssemble));
  EXPECT_THAT(StepWithMating(plan).certificate.resolutions, SizeIs(1));
  EXPECT_EQ(UnprovedAmong(problem, {actions[1]}, Propagation::kSound), 0);
}

TEST(UncertaintyPhase, WhereNothingIsEnoughFailureIsPreparedFor) {
  const domain::Problem problem = LoadScenario("uncertain-failing");
  const Plan plan = CertifiedPlan(problem);
  EXPECT_EQ(plan.errors, 2);
  std::set<std::string> signalled;
  for (const StepId id : Unproved(plan)) {
    const auto& resolutions = plan.step(id).certificate.resolutions;
    EXPECT_EQ(std::ranges::count(resolutions, "verification", &plan::Resolution::resolver), 1);
    std::vector<plan::Verification> checks = plan.verifications;
    std::erase_if(checks, [&](const auto& check) { return check.step != id; });
    EXPECT_THAT(checks, Not(IsEmpty()));
    for (const plan::Verification& check : checks) {
      for (const std::string& error : {check.below, check.above}) {
        signalled.insert(error);
        EXPECT_TRUE(std::ranges::any_of(plan.recoveries, [&](const plan::Recovery& recovery) {
          return recovery.step == id && recovery.error == error;
        })) << error;
      }
    }
  }
  EXPECT_TRUE(signalled.contains("error1"));  // nothing grasped
  EXPECT_TRUE(signalled.contains("error2"));  // another part than expected
}

// The tests below check laws of every augmented plan instance.

using Case = std::tuple<const char*, Propagation>;

class AugmentedPlans : public ::testing::TestWithParam<Case> {
 protected:
  Propagation propagation() const { return std::get<1>(GetParam()); }

  domain::Problem problem_ = LoadScenario(std::get<0>(GetParam()));
  const plan::PlanResult& result_ = Result();
  const Plan& plan_ = result_.plan;

 private:
  // Returns the plan of a case, which is made once for all tests.
  const plan::PlanResult& Result() const {
    static std::map<std::pair<std::string, Propagation>, plan::PlanResult> results;
    const auto [entry, is_new] = results.try_emplace({problem_.name, propagation()});
    if (is_new) entry->second = MakeCertifiedPlan(problem_, {}, In(propagation()));
    return entry->second;
  }
};

INSTANTIATE_TEST_SUITE_P(
    , AugmentedPlans,
    ::testing::Combine(::testing::Values("uncertain-known", "uncertain-sensing",
                                         "uncertain-squeezing", "uncertain-held",
                                         "uncertain-failing", "spar-fig15"),
                       ::testing::Values(Propagation::kPaper, Propagation::kSound)),
    [](const auto& param) {
      std::string name = std::get<0>(param.param);
      std::erase(name, '-');
      return name + (std::get<1>(param.param) == Propagation::kPaper ? "InPaperMode" : "");
    });

TEST_P(AugmentedPlans, AreAcceptedByTheChecker) {
  for (const plan::Flaw& flaw : plan::Check(problem_, plan_, kMostOrders).flaws) {
    ADD_FAILURE() << flaw.what;
  }
}

TEST_P(AugmentedPlans, CountTheirErrorsAsTheirCertificatesDo) {
  EXPECT_EQ(plan_.errors, std::ssize(Unproved(plan_)));
  EXPECT_EQ(plan_.errors, UnprovedAmong(problem_, ActionsOf(plan_), propagation()));
}

// If any one look or squeeze is left out, some step can no longer be proved.
TEST_P(AugmentedPlans, WithoutErrorsHoldNothingThatIsNotNeeded) {
  if (plan_.errors > 0) return;
  for (const StepId id : InsertedSteps(plan_)) {
    EXPECT_GT(UnprovedAmong(problem_, ActionsWithout(plan_, id), propagation()), 0)
        << plan_.step(id).name;
  }
}

TEST_P(AugmentedPlans, SayForEachStepThatWasInsertedWhatItIsFor) {
  const std::set<StepId> inserted = InsertedSteps(plan_);
  for (std::size_t i = 0; i < plan_.steps.size(); ++i) {
    const plan::Action& action = plan_.steps[i].action;
    const bool reduces = action.Is(domain::kSense) || action.Is(domain::kSqueeze);
    EXPECT_EQ(inserted.contains(StepId(i)), reduces) << plan_.steps[i].name;
  }
  for (const PlannedStep& step : plan_.steps) {
    for (const plan::Resolution& resolution : step.certificate.resolutions) {
      EXPECT_THAT(resolution.why, Not(IsEmpty()));
      for (const StepId id : resolution.steps) EXPECT_LT(plan_.step(id).executed, step.executed);
    }
  }
}

// The tolerance for outward rounding.
constexpr double kRounding = 1e-15;  // metres and radians

void ExpectSame(const Interval& a, const Interval& b) {
  EXPECT_NEAR(a.low, b.low, kRounding);
  EXPECT_NEAR(a.high, b.high, kRounding);
}

void ExpectContained(const Interval& inner, const Interval& outer, double tolerance) {
  EXPECT_GE(inner.low, outer.low - tolerance);
  EXPECT_LE(inner.high, outer.high + tolerance);
}

void ExpectSame(const plan::ErrorSet& a, const plan::ErrorSet& b) {
  EXPECT_EQ(a.in_hand, b.in_hand);
  ExpectSame(a.x, b.x);
  ExpectSame(a.y, b.y);
  ExpectSame(a.z, b.z);
  ExpectSame(a.theta, b.theta);
  ExpectSame(a.tip, b.tip);
  ExpectSame(a.twist, b.twist);
}

// The error of a held part is that in the hand, plus the error of the new command of the hand.
// Across the pads there is only the error of the command (Spar: "Y is limited to the gripper's own
// error"), and the effect of a turn of the hand on a grasp beside the intended point. If the pads
// jammed, which the rotation shows, this does not hold.
void ExpectHandedOnInHand(const plan::ErrorSet& before, const plan::ErrorSet& last,
                          const domain::PoseError& hand) {
  constexpr double kLoose = 1e-6;  // metres
  EXPECT_TRUE(before.in_hand && last.in_hand);
  ExpectContained(last.x, before.x, kLoose);
  ExpectContained(last.z, before.z, kLoose);
  ExpectSame(last.theta, before.theta);
  ExpectSame(last.tip, before.tip);
  ExpectSame(last.twist, before.twist);
  if (before.theta.high > hand.theta.high + kRounding) return;
  const double across = hand.y.high + before.x.high * hand.theta.high + kLoose;
  EXPECT_LE(before.y.high, across);
  EXPECT_LE(last.y.high, across);
}

plan::ErrorSet ErrorAtFirst(const domain::Problem& problem, PartId part) {
  const domain::PoseError& error = problem.part(part).error;
  return {.part = part,
          .in_hand = false,
          .x = error.x,
          .y = error.y,
          .z = error.z,
          .theta = error.theta};
}

// The errors of a part after a step are its errors before the next step with this part.
TEST_P(AugmentedPlans, HandOnWhatIsKnownFromStepToStep) {
  std::map<PartId, plan::ErrorSet> known;
  for (std::size_t p = 0; p < problem_.parts.size(); ++p) {
    known[PartId(p)] = ErrorAtFirst(problem_, PartId(p));
  }
  for (const StepId id : plan_.ExecutionOrder()) {
    SCOPED_TRACE(plan_.step(id).name);
    const plan::Certificate& certificate = plan_.step(id).certificate;
    EXPECT_EQ(certificate.before.size(), certificate.after.size());
    for (const plan::ErrorSet& before : certificate.before) {
      if (before.in_hand && propagation() == Propagation::kSound) {
        ExpectHandedOnInHand(before, known[before.part], problem_.gripper_error);
      } else {
        ExpectSame(before, known[before.part]);
      }
    }
    for (const plan::ErrorSet& after : certificate.after) known[after.part] = after;
  }
}

// A certificate is complete: its expressions and intervals are enough to prove each claim again.
// The worst corner shows how near the expression comes to its limit.
TEST_P(AugmentedPlans, CarryCertificatesThatCanBeProvedAnew) {
  for (const PlannedStep& step : plan_.steps) {
    algebra::ExpressionPool pool;
    const std::vector<algebra::Expression> expressions =
        oracle::CertifiedExpressions(step.certificate, pool);
    for (std::size_t k = 0; k < expressions.size(); ++k) {
      const plan::CertifiedPrecondition& claim = step.certificate.preconditions[k];
      const algebra::Expression& e = expressions[k];
      const bool less = claim.relation == plan::Relation::kLess;
      const algebra::BoundRequest request = {.limit = claim.limit};
      const algebra::ConstraintSet box = algebra::DeclaredBox(pool);
      const double bound = less ? algebra::BoundAbove(e, box, request).value
                                : algebra::BoundBelow(e, box, request).value;
      EXPECT_EQ(less ? bound < claim.limit : bound > claim.limit, claim.holds())
          << step.name << " " << claim.condition.name() << " " << claim.expression;
      if (claim.worst.empty()) continue;
      std::vector<Interval> corner = box.box;
      for (const auto& [name, value] : claim.worst) {
        const algebra::VariableId id = *pool.Find(name);
        EXPECT_TRUE(Contains(pool.bounds(id), value));
        corner[id.index()] = {value, value};
      }
      const Interval value = algebra::Evaluate(e, corner);
      const double beyond = less ? value.low - claim.bound : claim.bound - value.high;
      EXPECT_LE(beyond, 0) << claim.expression;
      EXPECT_LE(-beyond, claim.gap + 1e-9) << claim.expression;
    }
  }
}

std::string Bytes(const plan::PlanResult& result, const domain::Problem& problem) {
  return plan::ToJson(result, problem, "scenario.yaml").dump(2);
}

TEST_P(AugmentedPlans, AreTheSameBytesEveryTime) {
  const plan::PlanResult again = MakeCertifiedPlan(problem_, {}, In(propagation()));
  EXPECT_EQ(Bytes(again, problem_), Bytes(result_, problem_));
}

TEST_P(AugmentedPlans, SurviveBeingWrittenAndRead) {
  const std::string text = Bytes(result_, problem_);
  const plan::PlanResult read = plan::ReadPlan(Document::Parse(text, "plan.json"), problem_);
  EXPECT_EQ(read.plan.errors, plan_.errors);
  EXPECT_EQ(Bytes(read, problem_), text);
  for (std::size_t i = 0; i < plan_.steps.size(); ++i) {
    EXPECT_EQ(read.plan.steps[i].certificate, plan_.steps[i].certificate);
  }
}

// The paper's mode has fewer preconditions: a pickup has the four inequalities of the paper.
TEST(UncertaintyPhase, ThePaperModeHasThePapersPreconditionsOfAPickup) {
  const Plan plan = CertifiedPlan(LoadScenario("uncertain-known"), In(Propagation::kPaper));
  for (const PlannedStep& step : plan.steps) {
    if (!step.action.Is(domain::kPickup)) continue;
    std::vector<std::string> conditions;
    for (const auto& claim : step.certificate.preconditions)
      conditions.emplace_back(claim.condition.name());
    EXPECT_THAT(conditions, SizeIs(4));
    EXPECT_THAT(conditions, Each("between fingers"));
  }
}

void ScaleErrors(domain::Problem& problem, double factor) {
  const auto scale = [&](domain::PoseError& error) {
    for (Interval* range : {&error.x, &error.y, &error.z, &error.theta}) {
      *range = {factor * range->low, factor * range->high};
    }
  };
  for (domain::Part& part : problem.parts) scale(part.error);
  scale(problem.gripper_error);
}

class ExactlyKnown : public ::testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(, ExactlyKnown,
                         ::testing::Values("spar-fig13", "spar-fig14", "spar-fig16", "spar-example",
                                           "two-pegs", "clutter", "keyed", "uncertain-failing"),
                         [](const auto& param) {
                           std::string name = param.param;
                           std::erase(name, '-');
                           return name;
                         });

// Without errors everything that the geometry of the first phase allows is proved, and nothing is
// inserted.
TEST_P(ExactlyKnown, PartsNeedNothing) {
  domain::Problem problem = LoadScenario(GetParam());
  ScaleErrors(problem, 0);
  const Plan plan = CertifiedPlan(problem);
  EXPECT_EQ(plan.errors, 0);
  EXPECT_THAT(Unproved(plan), IsEmpty());
  EXPECT_EQ(ActionsOf(plan).size(), ActionsOf(FirstInstance(problem)).size());
}

// For one instance without remedies, what is proved stays proved when errors are smaller.
TEST(UncertaintyPhase, SmallerErrorsAreNoHarder) {
  int last = 0;
  for (const double factor : {0.0, 0.01, 0.1, 0.3, 1.0, 2.0}) {
    domain::Problem problem = LoadScenario("uncertain-sensing");
    const Plan instance = FirstInstance(problem);
    ScaleErrors(problem, factor);
    const int errors = Augment(problem, instance, WithoutRemedies()).plan.errors;
    EXPECT_GE(errors, last) << factor;
    last = errors;
  }
  EXPECT_GT(last, 0);
}

double LogUniform(RandomStream& random, double low, double high) {
  return low * std::pow(high / low, random.Uniform());
}

domain::PoseError RandomError(RandomStream& random) {
  const auto plus_minus = [](double half_width) { return Interval{-half_width, half_width}; };
  return {.x = plus_minus(LogUniform(random, 5e-5, 6e-3)),
          .y = plus_minus(LogUniform(random, 5e-5, 6e-3)),
          .z = plus_minus(LogUniform(random, 1e-5, 5e-4)),
          .theta = plus_minus(LogUniform(random, 5e-4, 0.1))};
}

// For random errors the count of unproved steps is right and the plan works. If everything is
// proved, no inserted step is superfluous.
TEST(UncertaintyPhase, HoldsItsLawsForRandomErrors) {
  int proved_by_remedies = 0;
  for (int seed = 0; seed < 8; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream random(seed, "errors");
    constexpr std::array kScenarios = {"uncertain-sensing", "uncertain-held", "uncertain-squeezing",
                                       "uncertain-known"};
    domain::Problem problem = LoadScenario(kScenarios[seed % kScenarios.size()]);
    for (domain::Part& part : problem.parts) part.error = RandomError(random);
    if (random.Index(3) == 0) problem.sensors.clear();
    UncertaintyOptions options;
    options.instances = 1;
    const Plan plan = CertifiedPlan(problem, options);
    EXPECT_EQ(plan.errors, std::ssize(Unproved(plan)));
    EXPECT_THAT(plan::Check(problem, plan, 1).flaws, IsEmpty());
    if (plan.errors > 0) continue;
    const std::set<StepId> inserted = InsertedSteps(plan);
    proved_by_remedies += inserted.empty() ? 0 : 1;
    for (const StepId id : inserted) {
      EXPECT_GT(UnprovedAmong(problem, ActionsWithout(plan, id), Propagation::kSound), 0);
    }
  }
  EXPECT_GT(proved_by_remedies, 0);
}

// Remedies are tried for errors whose interval does not contain 0, too.
TEST(UncertaintyPhase, RemediesAreTriedForErrorsThatAreNotAboutZero) {
  domain::Problem problem = LoadScenario("uncertain-sensing");
  for (domain::Part& part : problem.parts) part.error.x = {1e-4, part.error.x.high};
  const Plan plan = CertifiedPlan(problem);
  EXPECT_EQ(plan.errors, 0);
  EXPECT_THAT(InsertedSteps(plan), Not(IsEmpty()));
  for (const PlannedStep& step : plan.steps) {
    for (const plan::Resolution& resolution : step.certificate.resolutions) {
      EXPECT_NE(resolution.resolver, "verification");
    }
  }
}

// Tests of instances, plans and budgets.

// The paper counts unmet goals. Among instances with the same count, the shorter plan is better,
// and then the one with the smaller total violation.
class AllInstances : public ::testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(, AllInstances, ::testing::Values("uncertain-failing", "spar-fig15"),
                         [](const auto& param) {
                           std::string name = param.param;
                           std::erase(name, '-');
                           return name;
                         });

TEST_P(AllInstances, HaveNoneBetterThanTheAnswer) {
  const domain::Problem problem = LoadScenario(GetParam());
  UncertaintyOptions options;
  options.instances = 4;
  options.instances_for_violation = 4;
  options.combinations = 10;
  using Rank = std::tuple<int, std::size_t, double>;
  std::vector<std::pair<Rank, Plan>> augmented;
  for (const Plan& instance : Instances(problem, 4)) {
    const AugmentedPlanInstance answer = Augment(problem, instance, options);
    augmented.push_back(
        {{answer.plan.errors, instance.steps.size(), answer.violation}, answer.plan});
  }
  const Plan& best = std::ranges::min_element(augmented, {}, &std::pair<Rank, Plan>::first)->second;
  const Plan plan = CertifiedPlan(problem, options);
  EXPECT_LE(plan.errors, augmented.front().second.errors);
  EXPECT_EQ(Bytes({Outcome::kFound, plan, {}, {}}, problem),
            Bytes({Outcome::kFound, best, {}, {}}, problem));
}

// The violation is the sum of what the certificates lack, if both are bounded by the same method.
TEST(UncertaintyPhase, TheViolationIsTheSumOfWhatIsMissing) {
  const domain::Problem problem = LoadScenario("uncertain-failing");
  UncertaintyOptions options;
  options.bound.highest = algebra::BoundingMethod::kTermwise;
  const AugmentedPlanInstance augmented = Augment(problem, FirstInstance(problem), options);
  double missing = 0;
  for (const PlannedStep& step : augmented.plan.steps) {
    for (const auto& claim : step.certificate.preconditions) missing += std::max(0., -claim.margin);
  }
  EXPECT_GT(missing, 0);
  EXPECT_NEAR(augmented.violation, missing, 1e-12 * missing + 1e-9);
}

// Most errors here are heights, which no remedy can reduce, because the camera does not measure
// them. Augmenting all instances would then be useless.
TEST(UncertaintyPhase, AFewInstancesAreAugmentedForTheirViolationAlone) {
  domain::Problem problem = LoadScenario("spar-fig13");
  problem.sensors = {"coarse-camera"};
  std::vector<std::int64_t> remedies;
  std::vector<int> errors;
  for (const int most : {0, 1, 9}) {
    UncertaintyOptions options;
    options.instances_for_violation = most;
    const plan::PlanResult result = MakeCertifiedPlan(problem, {}, options);
    remedies.push_back(result.counters.at("remedies"));
    errors.push_back(result.plan.errors);
  }
  EXPECT_LT(remedies[0], remedies[1]);
  EXPECT_LT(remedies[1], remedies[2]);
  EXPECT_THAT(errors, Each(errors.front()));
}

TEST(UncertaintyPhase, NoMoreInstancesAreLookedAtThanTheBudgetSays) {
  const domain::Problem problem = LoadScenario("uncertain-failing");
  for (const int budget : {1, 2, 5}) {
    UncertaintyOptions options = WithoutRemedies();
    options.instances = budget;
    const plan::PlanResult result = MakeCertifiedPlan(problem, {}, options);
    EXPECT_EQ(result.outcome, Outcome::kFound);
    EXPECT_EQ(result.counters.at("instances"), budget);
  }
}

TEST(UncertaintyPhase, NoMoreRemediesAreTriedThanTheBudgetSays) {
  domain::Problem problem = LoadScenario("uncertain-sensing");
  for (domain::Part& part : problem.parts) part.error.theta = {-0.005, 0.005};
  const Plan instance = FirstInstance(problem);
  UncertaintyOptions options;
  options.combinations = 0;
  const AugmentedPlanInstance untried = Augment(problem, instance, options);
  EXPECT_EQ(untried.combinations, 0);
  EXPECT_EQ(untried.plan.errors, 1);
  EXPECT_THAT(InsertedSteps(untried.plan), IsEmpty());
  options.combinations = 1;
  EXPECT_LE(Augment(problem, instance, options).combinations, std::ssize(instance.steps));
  // The assembly needs two looks, which a search for single remedies does not find.
  options = {};
  options.most_remedies = 1;
  options.resolvers = {};
  EXPECT_GT(Augment(problem, instance, options).plan.errors, 0);
  options.most_remedies = 2;
  EXPECT_EQ(Augment(problem, instance, options).plan.errors, 0);
}

TEST(UncertaintyPhase, WhereThereIsNoPlanThereIsNoneWithCertificates) {
  const plan::PlanResult result = MakeCertifiedPlan(LoadScenario("impossible"), {}, {});
  EXPECT_EQ(result.outcome, Outcome::kNone);
  EXPECT_THAT(result.conflict, Not(IsEmpty()));
  EXPECT_THAT(result.plan.steps, IsEmpty());
}

TEST(UncertaintyPhase, ABudgetOfTheFirstPhaseThatIsSpentIsTold) {
  PlannerOptions planner;
  planner.partial_plans = 1;
  const plan::PlanResult result = MakeCertifiedPlan(LoadScenario("uncertain-known"), planner, {});
  EXPECT_EQ(result.outcome, Outcome::kBudget);
}

// A resolver that proposes only single squeezes.
class OneSqueeze : public Resolver {
 public:
  std::string_view name() const override { return "one squeeze"; }
  std::vector<Remedy> Propose(const UnmetGoals& unmet) override {
    std::vector<Remedy> remedies = SqueezingResolver().Propose(unmet);
    std::erase_if(remedies, [](const Remedy& remedy) { return remedy.insertions.size() != 1; });
    return remedies;
  }
};

// Beyond the paper, another plan is tried if no instance of the shortest plan suffices. Here
// picking the post up and putting it down again aligns it in one direction, and a squeeze aligns it
// in the other.
TEST(UncertaintyPhase, TheFirstPhaseIsAskedForAnotherPlanWhereNoInstanceIsEnough) {
  domain::Problem problem = LoadScenario("uncertain-squeezing");
  problem.sensors.clear();
  UncertaintyOptions options;
  options.instances = 20;
  options.resolvers = {std::make_shared<OneSqueeze>()};
  EXPECT_GT(Augment(problem, FirstInstance(problem), options).plan.errors, 0);
  const plan::PlanResult result = MakeCertifiedPlan(problem, {}, options);
  EXPECT_EQ(result.plan.errors, 0);
  EXPECT_GT(result.counters.at("complete_plans"), 1);
  const std::vector<plan::Action> actions = ActionsOf(result.plan);
  EXPECT_EQ(Count(domain::kSqueeze, actions), 1);
  EXPECT_EQ(Count(domain::kPickup, actions), 2);
  EXPECT_THAT(plan::Check(problem, result.plan, kMostOrders).flaws, IsEmpty());
}

// A plan states how many steps are not proved. Its certificates must give the same number for every
// bounding method.
TEST(UncertaintyPhase, WeakerBoundsGiveTheSameCountAsTheirCertificates) {
  for (const auto method :
       {algebra::BoundingMethod::kTermwise, algebra::BoundingMethod::kMonotone}) {
    UncertaintyOptions options;
    options.bound.highest = method;
    options.instances = 1;
    const Plan plan = CertifiedPlan(LoadScenario("uncertain-squeezing"), options);
    EXPECT_EQ(plan.errors, std::ssize(Unproved(plan))) << algebra::Name(method);
  }
}

plan::PlanResult ReadBack(const plan::PlanResult& result, const domain::Problem& problem) {
  const std::string text = plan::ToJson(result, problem, "scenario.yaml").dump();
  return plan::ReadPlan(Document::Parse(text, "plan.json"), problem);
}

// The certificates can be computed from the scenario and the actions, which a plan file contains.
TEST(UncertaintyPhase, CertificatesAreTheSameComputedAnew) {
  for (const char* name :
       {"uncertain-known", "uncertain-squeezing", "uncertain-failing", "spar-fig15"}) {
    for (const Propagation propagation : {Propagation::kSound, Propagation::kPaper}) {
      const domain::Problem problem = LoadScenario(name);
      const plan::PlanResult made = MakeCertifiedPlan(problem, {}, In(propagation));
      ASSERT_EQ(made.outcome, Outcome::kFound) << name;
      const Plan plan = ReadBack(made, problem).plan;
      const auto anew = uncertainty::CertificatesAnew(problem, plan, propagation, {});
      for (std::size_t i = 0; i < plan.steps.size(); ++i) {
        plan::Certificate expected = plan.steps[i].certificate;
        expected.resolutions.clear();
        EXPECT_TRUE(anew[i] == expected) << name << ", " << plan.steps[i].name;
      }
    }
  }
}

TEST(UncertaintyPhase, CertificatesStateWhatTheyCover) {
  for (const char* name : {"uncertain-known", "uncertain-squeezing", "spar-fig13"}) {
    for (const Propagation propagation : {Propagation::kSound, Propagation::kPaper}) {
      const Plan plan = CertifiedPlan(LoadScenario(name), In(propagation));
      EXPECT_EQ(plan::IsAsPublished(plan), propagation == Propagation::kPaper) << name;
      for (const PlannedStep& step : plan.steps) {
        EXPECT_THAT(plan::FlawsOfCoverage(step), IsEmpty()) << name << ", " << step.name;
      }
    }
  }
}

}  // namespace
}  // namespace assay::constraint_posting::uncertainty_phase_test
