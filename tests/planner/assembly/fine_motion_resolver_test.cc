#include "planner/assembly/fine_motion_resolver.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "planner/assembly/certified_plan.h"
#include "planner/assembly/resolvers.h"
#include "planner/base/random.h"
#include "planner/plan/certificates/condition_table.h"
#include "tests/oracle/executed_errors.h"
#include "tests/planner/constraint_posting/scenarios.h"

namespace assay::assembly::fine_motion_resolver_test {
namespace {

using constraint_posting::Count;
using constraint_posting::LoadScenario;
using constraint_posting::Remedy;
using constraint_posting::UnmetGoals;
using geometry::Pose;
using geometry::Vector3;
using ::testing::Contains;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using uncertainty::Propagation;

constexpr std::uint64_t kSeed = 5;
constexpr int kSamples = 10'000;
constexpr double kRounding = 1e-9;

// The first instance of a scenario, and unmet goals of its last step, an assemble.
struct Asked {
  explicit Asked(domain::Problem of) : problem(std::move(of)) {
    actions = constraint_posting::ActionsOf(constraint_posting::FirstInstance(problem));
  }

  UnmetGoals About(const std::vector<plan::Condition>& conditions) const {
    UnmetGoals unmet = {problem, actions, static_cast<int>(actions.size()) - 1, {}};
    for (const plan::Condition condition : conditions) {
      unmet.goals.push_back({.claim = {.condition = condition}, .expression = {}});
    }
    return unmet;
  }
  const plan::Action& assemble() const { return actions.back(); }

  domain::Problem problem;
  std::vector<plan::Action> actions;
};

// Returns the difference of two poses of the tip as a displacement and a rotation vector.
std::pair<Vector3, Vector3> ErrorOf(const Pose& truth, const Pose& believed) {
  const Eigen::AngleAxisd turn(geometry::Matrix3(truth.linear() * believed.linear().inverse()));
  return {truth.translation() - believed.translation(), turn.angle() * turn.axis()};
}

uncertainty::TipWay SomeWay(const domain::Problem& problem, const domain::Mating& mating) {
  const finemotion::MatingGeometry geometry = finemotion::GeometryOf(problem, mating);
  uncertainty::TipWay way = {geometry.X_HeldTip, geometry.passage.X_StationaryEntry,
                             geometry.X_FixedSeat.linear()};
  way.X_FixedStart.rotate(Eigen::AngleAxisd(0.15, Vector3(1, 2, -1).normalized()));
  return way;
}

// Plans are executed with drawn errors by an oracle that shares no code with the bounds.
class TipErrors : public ::testing::TestWithParam<const char*> {};

TEST_P(TipErrors, AreInTheBox) {
  const Asked asked(LoadScenario(GetParam()));
  const domain::Problem& problem = asked.problem;
  const plan::Action& assemble = asked.assemble();
  const uncertainty::TipWay way = SomeWay(problem, problem.mating(assemble.mating));
  const uncertainty::TipBox box =
      TipBoxAt(asked.About({plan::condition::kEntry}), Propagation::kSound, way);

  std::vector<oracle::CertifiedAction> before;
  for (std::size_t i = 0; i + 1 < asked.actions.size(); ++i) {
    before.push_back({asked.actions[i], {}});
  }
  const Pose X_FixedTool = way.X_FixedStart * way.X_HeldTip.inverse() * assemble.hold.X_PartTool;
  RandomStream random(kSeed, "tip errors");
  Vector3 most_d = Vector3::Zero();
  Vector3 most_w = Vector3::Zero();
  for (int i = 0; i < kSamples; ++i) {
    oracle::ExecutedWorld world(problem, random);
    world.Execute(before);
    const Pose X_FixedHeld = world.HeldSeenBy(problem.mating(assemble.mating).fixed, X_FixedTool);
    const auto [d, w] = ErrorOf(X_FixedHeld * way.X_HeldTip, way.X_FixedStart);
    most_d = most_d.cwiseMax(d.cwiseAbs());
    most_w = most_w.cwiseMax(w.cwiseAbs());
  }
  for (const int axis : {0, 1, 2}) {
    EXPECT_LE(most_d[axis], box.d[axis] + kRounding) << axis;
    EXPECT_LE(most_w[axis], box.w[axis] + kRounding) << axis;
    EXPECT_GE(most_d[axis], box.d[axis] / 4) << axis;  // the bound is not much too large
  }
}

INSTANTIATE_TEST_SUITE_P(Scenarios, TipErrors,
                         ::testing::Values("uncertain-known", "uncertain-squeezing"));

TEST(SinesWithin, ComponentsBoundTheRotationVector) {
  RandomStream random(kSeed, "sines");
  for (int i = 0; i < 1000; ++i) {
    const Vector3 w(random.Uniform(0, 0.5), random.Uniform(0, 0.5), random.Uniform(0, 0.5));
    const Vector3 sines = uncertainty::SinesWithin(w);
    Vector3 turn;
    for (const int axis : {0, 1, 2}) turn[axis] = random.Uniform(-0.6, 0.6);
    const double angle = turn.norm();
    const Vector3 sine = std::sin(angle) / angle * turn;
    if ((sine.cwiseAbs().array() <= sines.array()).all()) {
      EXPECT_TRUE((turn.cwiseAbs().array() <= w.array() + kRounding).all()) << turn.transpose();
    }
  }
}

const plan::PlanResult& FeltPlan() {
  static const domain::Problem problem = LoadScenario("uncertain-fine-motion");
  static const plan::PlanResult result = MakeCertifiedPlan(problem, {}, {});
  return result;
}

const plan::PlannedStep& AssembleOf(const plan::Plan& plan) {
  return *std::ranges::find_if(
      plan.steps, [](const plan::PlannedStep& step) { return step.action.Is(domain::kAssemble); });
}

TEST(FineMotionResolver, ProvesWhatLooksAndSqueezesDoNot) {
  const plan::Plan& plan = FeltPlan().plan;
  EXPECT_EQ(plan.errors, 0);
  EXPECT_THAT(plan.verifications, IsEmpty());
  const plan::PlannedStep& step = AssembleOf(plan);
  ASSERT_TRUE(step.strategy);
  EXPECT_THAT(plan::FlawsOfForm(*step.strategy), IsEmpty());
  EXPECT_EQ(step.certificate.resolutions.back().resolver, "fine-motion");
  int tip_claims = 0;
  for (const plan::CertifiedPrecondition& claim : step.certificate.preconditions) {
    EXPECT_TRUE(claim.holds() || plan::Absorbs(step.strategy, claim.condition))
        << claim.condition.name();
    tip_claims += claim.condition->needed_by == plan::NeededBy::kStrategy ? 1 : 0;
  }
  EXPECT_EQ(tip_claims, 24);
  domain::Problem as_in_spar = LoadScenario("uncertain-fine-motion");
  as_in_spar.resolvers = {domain::ResolverKind::kSensing, domain::ResolverKind::kSqueezing};
  EXPECT_EQ(MakeCertifiedPlan(as_in_spar, {}, {}).plan.errors, 1);
}

// The walls determine the place of the part more precisely than the hand does.
TEST(FineMotionResolver, LeavesTheHeldPartWhereTheFixedOneIs) {
  const plan::Certificate& certificate = AssembleOf(FeltPlan().plan).certificate;
  const plan::ErrorSet& peg = certificate.after[0];
  const plan::ErrorSet& block = certificate.after[1];
  EXPECT_FALSE(peg.in_hand);
  EXPECT_GE(peg.x.high, block.x.high + 0.00025);  // the play is included
  EXPECT_LE(peg.x.high, block.x.high + 0.003);
}

TEST(FineMotionResolver, AnswersOnlyForShaftsInHoles) {
  const Asked asked(LoadScenario("uncertain-known"));
  FineMotionResolver resolver(Propagation::kSound);
  EXPECT_THAT(resolver.Propose(asked.About({plan::condition::kEntry, plan::condition::kHandClear})),
              IsEmpty());
  UnmetGoals pickup = asked.About({plan::condition::kEntry});
  pickup.step = 0;
  EXPECT_THAT(resolver.Propose(pickup), IsEmpty());
  EXPECT_EQ(resolver.searches(), 0);
}

TEST(FineMotionResolver, SearchesOnceForTheSameErrors) {
  domain::Problem problem = LoadScenario("uncertain-known");
  problem.resolvers = {domain::ResolverKind::kFineMotion};
  const Asked asked(std::move(problem));
  FineMotionResolver resolver(Propagation::kSound);
  const std::vector<Remedy> first = resolver.Propose(asked.About({plan::condition::kEntry}));
  ASSERT_THAT(first, SizeIs(1));
  EXPECT_THAT(first[0].absorbs, Contains(plan::Condition(plan::condition::kSlideIn)));
  EXPECT_THAT(first[0].insertions, IsEmpty());
  const int searches = resolver.searches();
  const std::vector<Remedy> second = resolver.Propose(asked.About({plan::condition::kTilt}));
  EXPECT_EQ(resolver.searches(), searches);
  ASSERT_THAT(second, SizeIs(1));
  EXPECT_TRUE(second[0].strategy->X_FixedStart.isApprox(first[0].strategy->X_FixedStart, 0));
}

TEST(Resolvers, ComeInThePapersOrder) {
  using domain::ResolverKind;
  std::vector<std::string> names;
  for (const auto& resolver :
       Resolvers({ResolverKind::kFineMotion, ResolverKind::kSqueezing, ResolverKind::kSensing},
                 Propagation::kSound)) {
    names.emplace_back(resolver->name());
  }
  EXPECT_EQ(names, domain::ResolverNames());
}

}  // namespace
}  // namespace assay::assembly::fine_motion_resolver_test
