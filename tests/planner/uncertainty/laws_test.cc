#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/algebra/expression/evaluation.h"
#include "planner/plan/certificates/condition_table.h"
#include "planner/uncertainty/preconditions/certify.h"
#include "tests/oracle/certified_expressions.h"
#include "tests/planner/plan/actions.h"
#include "tests/planner/uncertainty/part_on_table.h"

// Laws of propagation and certificates that hold for every plan.
namespace assay::uncertainty::laws_test {
namespace {

using ::testing::IsEmpty;

constexpr double kRounding = 1e-12;
constexpr double kBoundGap = 1e-6;  // gap of the bounds of sets

domain::Problem Scaled(domain::Problem problem, double factor) {
  const auto scale = [&](Interval& i) { i = {factor * i.low, factor * i.high}; };
  const auto scale_all = [&](domain::PoseError& error) {
    for (Interval* i : {&error.x, &error.y, &error.z, &error.theta}) scale(*i);
  };
  for (domain::Part& part : problem.parts) scale_all(part.error);
  scale_all(problem.gripper_error);
  return problem;
}

std::array<Interval, 6> Ranges(const plan::ErrorSet& set) {
  return {set.x, set.y, set.z, set.theta, set.tip, set.twist};
}

bool Inside(const plan::ErrorSet& inner, const plan::ErrorSet& outer, double tolerance) {
  const auto a = Ranges(inner), b = Ranges(outer);
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i].low < b[i].low - tolerance || a[i].high > b[i].high + tolerance) return false;
  }
  return true;
}

class EachMode : public ::testing::TestWithParam<Propagation> {};

// Returns the actions of the first plan after a look at every part, so that the tests cover
// sensing.
std::vector<plan::Action> Actions(const domain::Problem& problem) {
  std::vector<plan::Action> actions;
  for (std::size_t p = 0; p < problem.parts.size(); ++p) {
    const PartId part(static_cast<int>(p));
    actions.push_back(
        plan::Sense(part, "overhead-camera", {"initial", problem.part(part).X_WorldPart}));
  }
  for (const plan::Action& action : FirstPlan(problem)) actions.push_back(action);
  return actions;
}

TEST_P(EachMode, WithoutErrorsSetsAreZeroAndEverythingIsProved) {
  for (const char* name : {"spar-fig13", "spar-fig16", "keyed", "two-pegs"}) {
    const domain::Problem problem = Scaled(LoadScenario(name), 0);
    for (const CertifiedAction& step : Certify(problem, FirstPlan(problem), GetParam())) {
      for (const auto& claim : step.certificate.preconditions) {
        EXPECT_GT(claim.margin, 0)
            << name << ": " << claim.condition.name() << ", " << claim.meaning;
      }
      for (const plan::ErrorSet& set : step.certificate.after) {
        for (const Interval& range : Ranges(set)) {
          EXPECT_NEAR(range.low, 0, 1e-12) << name;
          EXPECT_NEAR(range.high, 0, 1e-12) << name;
        }
      }
    }
  }
}

// Returns the preconditions of the kinds whose number does not depend on the errors. There are more
// preconditions kHandClear and kNeighbourClear if larger errors bring more corners near
// something.
std::vector<plan::CertifiedPrecondition> OfFixedNumber(
    const std::vector<plan::CertifiedPrecondition>& claims) {
  std::vector<plan::CertifiedPrecondition> fixed;
  std::ranges::copy_if(claims, std::back_inserter(fixed), [](const auto& claim) {
    return claim.condition != plan::condition::kHandClear &&
           claim.condition != plan::condition::kNeighbourClear;
  });
  return fixed;
}

bool AllHold(plan::Condition condition, const plan::Certificate& certificate) {
  return std::ranges::all_of(certificate.preconditions, [&](const auto& claim) {
    return claim.condition != condition || claim.holds();
  });
}

TEST_P(EachMode, GreaterErrorsGiveGreaterSetsAndProveNoMore) {
  const domain::Problem small = LoadScenario("spar-fig15");
  const auto actions = Actions(small);
  const domain::Problem large = Scaled(small, 1.5);
  const auto of_small = Certify(small, actions, GetParam());
  const auto of_large = Certify(large, actions, GetParam());
  for (std::size_t s = 0; s < actions.size(); ++s) {
    const auto& a = of_small[s].certificate;
    const auto& b = of_large[s].certificate;
    const auto same_of_a = OfFixedNumber(a.preconditions);
    const auto same_of_b = OfFixedNumber(b.preconditions);
    ASSERT_EQ(same_of_a.size(), same_of_b.size());
    for (std::size_t i = 0; i < same_of_a.size(); ++i) {
      if (same_of_b[i].holds()) {
        EXPECT_TRUE(same_of_a[i].holds()) << "step " << s + 1 << ": " << same_of_a[i].meaning;
      }
    }
    for (const auto& claim : a.preconditions) {
      if (!claim.holds()) {
        EXPECT_FALSE(AllHold(claim.condition, b)) << "step " << s + 1 << ": " << claim.meaning;
      }
    }
    for (std::size_t i = 0; i < a.after.size(); ++i) {
      EXPECT_TRUE(Inside(a.after[i], b.after[i], kBoundGap)) << "step " << s + 1;
    }
  }
}

TEST_P(EachMode, DecidingAgreesWithCertifying) {
  for (const char* name : {"spar-example", "spar-fig16"}) {
    const domain::Problem problem = LoadScenario(name);
    UncertainWorld certified(problem, GetParam()), decided(problem, GetParam()),
        first(problem, GetParam());
    for (const plan::Action& action : Actions(problem)) {
      const auto of_certificate = CertifyStep(certified, action, {});
      const auto all = DecideStep(decided, action, {}, Wanted::kAllUnproved);
      ASSERT_EQ(all.size(), of_certificate.unproved.size()) << name;
      for (std::size_t i = 0; i < all.size(); ++i) {
        EXPECT_EQ(all[i].claim.meaning, of_certificate.unproved[i].claim.meaning);
        EXPECT_EQ(all[i].claim.limit, of_certificate.unproved[i].claim.limit);
        EXPECT_EQ(decided.PartsIn({all[i].expression}),
                  certified.PartsIn({of_certificate.unproved[i].expression}));
      }
      UncertainWorld copy = first;
      EXPECT_EQ(DecideStep(copy, action, {}, Wanted::kFirstUnproved).empty(), all.empty());
      Propagate(first, action);
    }
    for (std::size_t p = 0; p < problem.parts.size(); ++p) {
      const PartId part(static_cast<int>(p));
      const plan::ErrorSet expected = ErrorSetOf(certified, part);
      for (const plan::ErrorSet& set : {ErrorSetOf(decided, part), ErrorSetOf(first, part)}) {
        EXPECT_TRUE(Inside(set, expected, kRounding) && Inside(expected, set, kRounding)) << name;
      }
    }
  }
}

TEST_P(EachMode, CopiesGoOnIndependently) {
  const domain::Problem problem = LoadScenario("spar-fig14");
  const auto actions = FirstPlan(problem);
  UncertainWorld world(problem, GetParam());
  CertifyStep(world, actions[0], {});
  UncertainWorld copy = world;
  CertifyStep(copy, actions[1], {});
  const plan::Certificate again = CertifyStep(world, actions[1], {}).certificate;
  UncertainWorld alone(problem, GetParam());
  CertifyStep(alone, actions[0], {});
  const plan::Certificate expected = CertifyStep(alone, actions[1], {}).certificate;
  EXPECT_EQ(again.before, expected.before);
  EXPECT_EQ(again.after, expected.after);
  ASSERT_EQ(again.preconditions.size(), expected.preconditions.size());
  for (std::size_t i = 0; i < again.preconditions.size(); ++i) {
    EXPECT_EQ(again.preconditions[i].bound, expected.preconditions[i].bound);
  }
}

// The texts use the variables of the certificate, and they have the bounds that the certificate
// states.
TEST_P(EachMode, TextsReadBackAndReproduceTheirBounds) {
  const domain::Problem problem = LoadScenario("spar-fig15");
  RandomStream random(3, "texts of certificates");
  for (const CertifiedAction& step : Certify(problem, Actions(problem), GetParam())) {
    algebra::ExpressionPool pool;
    const std::vector<Expression> expressions =
        oracle::CertifiedExpressions(step.certificate, pool);
    std::vector<Interval> box;
    for (const auto& variable : step.certificate.variables) box.push_back(variable.range);
    for (std::size_t k = 0; k < expressions.size(); ++k) {
      const plan::CertifiedPrecondition& claim = step.certificate.preconditions[k];
      const Expression& e = expressions[k];
      const bool less = claim.relation == plan::Relation::kLess;
      const algebra::BoundRequest request = {.limit = claim.limit};
      const auto again = less ? algebra::BoundAbove(e, algebra::DeclaredBox(pool), request)
                              : algebra::BoundBelow(e, algebra::DeclaredBox(pool), request);
      EXPECT_EQ(less ? again.value < claim.limit : again.value > claim.limit, claim.holds());
      EXPECT_NEAR(again.value, claim.bound, std::max(claim.gap, again.gap) + 1e-9);
      for (int sample = 0; sample < 20; ++sample) {
        std::vector<double> point;
        for (const Interval& i : box) {
          point.push_back(random.Index(2) == 0 ? i.low
                                               : i.low + random.Uniform() * (i.high - i.low));
        }
        const double value = algebra::Evaluate(e, std::span<const double>(point));
        if (less) {
          EXPECT_LE(value, claim.bound + 1e-12);
        } else {
          EXPECT_GE(value, claim.bound - 1e-12);
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Propagations, EachMode,
                         ::testing::Values(Propagation::kPaper, Propagation::kSound));

// ---- Sensing and squeezing ----

plan::Action SqueezeAlong(const Vector3& closing, const domain::Problem& problem) {
  return plan::Squeeze(kBlock, HoldFromAbove(problem, closing), PlaceOf(problem));
}

TEST(Sensing, InPaperModeNeverEnlargesASet) {
  for (const double scale : {0.01, 0.1, 1.0}) {
    const domain::Problem problem = Scaled(LoadScenario("spar-example"), scale);
    UncertainWorld world(problem, Propagation::kPaper);
    const plan::Action sense =
        plan::Sense(kBlock, "overhead-camera", {"on-end", problem.parts[0].X_WorldPart});
    for (int time = 0; time < 2; ++time) {
      const plan::ErrorSet before = ErrorSetOf(world, kBlock);
      const auto after = CertifyStep(world, sense, {}).certificate.after.at(0);
      EXPECT_TRUE(Inside(after, before, 0));
    }
  }
}

TEST(Squeezing, OnceLeavesTheOtherCoordinateAndTwiceLeavesTheHandsError) {
  constexpr double kLength = 0.001;
  for (const auto mode : {Propagation::kPaper, Propagation::kSound}) {
    for (const double hand : {0.0, 1e-5, 1e-4}) {
      const domain::Problem problem =
          UprightBlock({.length = kLength, .angle = 0.02, .hand = hand});
      UncertainWorld world(problem, mode);
      // The error is the displacement of the grasped point by the hand, plus the displacement of
      // the origin by the hand's turn. The second squeeze undoes the turn of the first, with a slip
      // of the same size along the first pads.
      const double reach = 6 * kInch;
      const double own = 2 * hand + 3 * reach * 10 * hand + 1e-9;
      CertifyStep(world, SqueezeAlong(Vector3::UnitX(), problem), {});
      const plan::ErrorSet once = ErrorSetOf(world, kBlock);
      EXPECT_LE(Magnitude(once.x), own);
      EXPECT_GE(Magnitude(once.y), kLength);
      EXPECT_LE(Magnitude(once.theta), 10 * hand + 1e-12);
      CertifyStep(world, SqueezeAlong(Vector3::UnitY(), problem), {});
      const plan::ErrorSet twice = ErrorSetOf(world, kBlock);
      EXPECT_LE(Magnitude(twice.x), 2 * own);
      EXPECT_LE(Magnitude(twice.y), own);
      EXPECT_LE(Magnitude(twice.theta), 10 * hand + 1e-12);
      EXPECT_NEAR(Magnitude(twice.z), kLength, 1e-9);  // the height is still that of the table
    }
  }
}

}  // namespace
}  // namespace assay::uncertainty::laws_test
