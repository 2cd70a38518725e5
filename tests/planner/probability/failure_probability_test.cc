#include "planner/probability/failure_probability.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <optional>
#include <random>

#include "planner/algebra/expression/evaluation.h"
#include "planner/assembly/certified_plan.h"
#include "planner/base/random.h"
#include "planner/uncertainty/preconditions/certify.h"
#include "tests/planner/constraint_posting/scenarios.h"
#include "tests/planner/probability/drawn.h"

namespace assay::probability::failure_probability_test {
namespace {

constexpr std::uint64_t kSeed = 32;

int Asked(const char* variable, int usual) {
  const char* const asked = std::getenv(variable);
  return asked == nullptr ? usual : std::stoi(asked);
}

struct Planned {
  domain::Problem problem;
  plan::Plan plan;
};

const Planned& UncertainKnown() {
  static const Planned planned = [] {
    Planned made = {constraint_posting::LoadScenario("uncertain-known"), {}};
    made.plan = assembly::MakeCertifiedPlan(made.problem, {}, {}).plan;
    return made;
  }();
  return planned;
}

// Gives random distributions to the errors of poses, some of them several times as great as the
// plan can bear.
DistributedErrors RandomErrors(const domain::Problem& problem, RandomStream& random) {
  DistributedErrors errors;
  for (const budget::ErrorQuantity& quantity : budget::ErrorQuantitiesOf(problem)) {
    if (quantity.name.find('.') == std::string::npos || random.Index(4) == 0) continue;
    const double deviation = random.Uniform(2, 15) * quantity.declared();
    switch (random.Index(3)) {
      case 0:
        errors.distributions[quantity.name] = Uniform(quantity.bounds);
        break;
      case 1:
        errors.distributions[quantity.name] = Normal(deviation);
        break;
      default:
        errors.distributions[quantity.name] =
            NormalWithin(deviation, {-2 * deviation, 2 * deviation});
    }
  }
  return errors;
}

using Subject = std::pair<plan::StepId, std::string>;

// One execution in which all errors are known. The planner's theory, for a box that just contains
// these errors, says which preconditions are true. This is slow and simple.
class Sample {
 public:
  Sample(const Planned& planned, const DistributedErrors& errors, std::mt19937_64& random)
      : random_(random) {
    const std::vector<budget::ErrorQuantity> quantities =
        budget::ErrorQuantitiesOf(planned.problem);
    std::vector<Interval> bounds;
    for (const budget::ErrorQuantity& quantity : quantities) {
      const auto found = errors.distributions.find(quantity.name);
      bounds.push_back(found == errors.distributions.end()
                           ? quantity.bounds
                           : BoundsOfDraws(quantity.name, found->second));
    }
    problem_ = budget::WithBounds(planned.problem, bounds);
    LookAtPreconditions(planned.plan);
  }

  const std::map<Subject, bool>& fails() const { return fails_; }

 private:
  static constexpr int kDraws = 4;  // the hand's errors are drawn for each of its actions

  Interval BoundsOfDraws(const std::string& name, const ErrorDistribution& distribution) {
    std::vector<double>& draws = draws_[name];
    for (int i = 0; i < kDraws; ++i) draws.push_back(Drawn(distribution, random_));
    return {std::ranges::min(draws), std::ranges::max(draws)};
  }

  void LookAtPreconditions(const plan::Plan& plan) {
    uncertainty::UncertainWorld world(*problem_, uncertainty::Propagation::kSound);
    std::vector<std::pair<Subject, uncertainty::Precondition>> preconditions;
    for (const plan::StepId id : plan.ExecutionOrder()) {
      for (auto& precondition : uncertainty::PreconditionsOf(world, plan.step(id).action))
        preconditions.push_back({{id, precondition.meaning}, precondition});
    }
    const std::vector<double> values = ValuesIn(world);
    for (const auto& [subject, precondition] : preconditions) {
      const double value =
          algebra::Evaluate(precondition.expression, std::span<const double>(values));
      const bool holds = precondition.relation == plan::Relation::kLess
                             ? value < precondition.limit
                             : value > precondition.limit;
      fails_[subject] = fails_[subject] || !holds;
    }
  }

  // What the theory leaves open has any value in its range.
  std::vector<double> ValuesIn(const uncertainty::UncertainWorld& world) {
    std::vector<double> values;
    for (const Interval& range : world.constraints().box) {
      const auto declared = world.DeclaredAs(algebra::VariableId(static_cast<int>(values.size())));
      const auto drawn = declared ? draws_.find(declared->name) : draws_.end();
      values.push_back(drawn != draws_.end()
                           ? drawn->second.at(static_cast<std::size_t>(declared->draw - 1))
                           : std::uniform_real_distribution<>(range.low, range.high)(random_));
    }
    return values;
  }

  std::mt19937_64& random_;
  std::optional<domain::Problem> problem_;
  std::map<std::string, std::vector<double>> draws_;
  std::map<Subject, bool> fails_;
};

// The share of samples that fail lies within the bounds, up to five standard deviations of the
// share. ASSAY_PROBABILITY_CASES and ASSAY_PROBABILITY_SAMPLES ask for more.
TEST(FailureProbability, ContainsTheShareOfSamples) {
  const int cases = Asked("ASSAY_PROBABILITY_CASES", 1);
  const int count = Asked("ASSAY_PROBABILITY_SAMPLES", 200);
  const Planned& planned = UncertainKnown();
  RandomStream random(kSeed, "distributions");
  std::mt19937_64 generator(kSeed);
  const auto expect_within = [&](const Interval& bounds, int failed) {
    const double share = static_cast<double>(failed) / count;
    const double tolerance = 5 * std::sqrt(std::max(share * (1 - share), 1.0 / count) / count);
    EXPECT_LE(bounds.low, share + tolerance);
    EXPECT_GE(bounds.high, share - tolerance);
  };
  int may_fail = 0;
  for (int i = 0; i < cases; ++i) {
    const DistributedErrors errors = RandomErrors(planned.problem, random);
    const FailureProbabilities found =
        FailureProbabilitiesOf(planned.problem, planned.plan, errors);
    std::map<Subject, int> failures;
    int any = 0;
    for (int sample = 0; sample < count; ++sample) {
      bool fails = false;
      const Sample drawn(planned, errors, generator);
      for (const auto& [subject, failed] : drawn.fails()) {
        failures[subject] += failed ? 1 : 0;
        fails = fails || failed;
      }
      any += fails ? 1 : 0;
    }
    SCOPED_TRACE("seed " + std::to_string(kSeed) + ", case " + std::to_string(i));
    expect_within(found.plan, any);
    std::map<Subject, Interval> known;
    for (const PreconditionFailure& failure : found.preconditions)
      known[{failure.step, failure.meaning}] = failure.probability;
    for (const auto& [subject, failed] : failures) {
      SCOPED_TRACE(subject.second);
      expect_within(known.contains(subject) ? known[subject] : Interval{0, 0}, failed);
      if (failed > 0) ++may_fail;
    }
  }
  EXPECT_GT(may_fail, cases) << "the errors are too small for a test";
}

// With the declared bounds, everything is proved, and nothing fails.
TEST(FailureProbability, IsZeroForUniformErrorsThatAreProved) {
  const Planned& planned = UncertainKnown();
  DistributedErrors errors;
  for (const budget::ErrorQuantity& quantity : budget::ErrorQuantitiesOf(planned.problem)) {
    if (quantity.name.find('.') != std::string::npos)
      errors.distributions[quantity.name] = Uniform(quantity.bounds);
  }
  const FailureProbabilities found = FailureProbabilitiesOf(planned.problem, planned.plan, errors);
  EXPECT_EQ(found.plan.high, 0);
  EXPECT_TRUE(found.preconditions.empty());
}

// A plan that is proved for four standard deviations fails no more often than errors exceed them.
TEST(FailureProbability, OfSmallNormalErrorsIsBoundedByTheirTails) {
  const Planned& planned = UncertainKnown();
  DistributedErrors errors;
  for (const budget::ErrorQuantity& quantity : budget::ErrorQuantitiesOf(planned.problem)) {
    if (quantity.name.find('.') != std::string::npos)
      errors.distributions[quantity.name] = Normal(quantity.declared() / 4);
  }
  const FailureProbabilities found = FailureProbabilitiesOf(planned.problem, planned.plan, errors);
  const auto draws = static_cast<double>(errors.distributions.size() + 4);  // two draws of the hand
  EXPECT_LE(found.plan.high, draws * std::erfc(4 / std::sqrt(2.0)));
  EXPECT_GE(found.plan.high, found.plan.low);
}

// A plan with looks is executed as its certificates say, however small the errors are.
TEST(FailureProbability, CountsOnLooksAsPlanned) {
  Planned planned = {constraint_posting::LoadScenario("uncertain-sensing"), {}};
  planned.plan = assembly::MakeCertifiedPlan(planned.problem, {}, {}).plan;
  ASSERT_EQ(planned.plan.errors, 0);
  DistributedErrors errors;
  for (const domain::Part& part : planned.problem.parts)
    errors.distributions[part.name + ".x"] = Normal(part.error.x.high / 5);
  EXPECT_LT(FailureProbabilitiesOf(planned.problem, planned.plan, errors).plan.high, 1e-4);
  for (const domain::Part& part : planned.problem.parts)
    errors.distributions[part.name + ".x"] = Normal(1e-6 * part.error.x.high);
  EXPECT_LT(FailureProbabilitiesOf(planned.problem, planned.plan, errors).plan.high, 1e-9);
}

// Errors that are correlated so that they cancel each other fail less often.
TEST(FailureProbability, CorrelationsCount) {
  const Planned& planned = UncertainKnown();
  DistributedErrors errors;
  const domain::Mating& mating = planned.problem.mating(domain::MatingId(0));
  std::vector<std::string> of_parts;
  for (const domain::PartId id : {mating.held, mating.fixed}) {
    const domain::Part& part = planned.problem.part(id);
    of_parts.push_back(part.name + ".x");
    errors.distributions[of_parts.back()] = Normal(2 * part.error.x.high);
  }
  const auto most = [&](double coefficient) {
    errors.correlations = {{of_parts[0], of_parts[1], coefficient}};
    return FailureProbabilitiesOf(planned.problem, planned.plan, errors).plan.high;
  };
  const double opposite = most(-0.9);
  const double together = most(0.9);
  EXPECT_NE(opposite, together);
}

}  // namespace
}  // namespace assay::probability::failure_probability_test
