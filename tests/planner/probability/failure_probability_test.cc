#include "planner/probability/failure_probability.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <map>
#include <random>

#include "planner/algebra/expression/evaluation.h"
#include "planner/assembly/certified_plan.h"
#include "planner/base/random.h"
#include "planner/uncertainty/preconditions/certify.h"
#include "tests/planner/constraint_posting/scenarios.h"

namespace assay::probability::failure_probability_test {
namespace {

constexpr std::uint64_t kSeed = 32;
constexpr double kFar = 7;  // standard deviations beyond which errors are not drawn

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
    const double deviation = random.Uniform(0.2, 3) * quantity.declared();
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

// Draws all errors of a plan and looks which preconditions fail. This is slow and simple.
class Samples {
 public:
  Samples(const Planned& planned, const DistributedErrors& errors)
      : errors_(errors),
        problem_(budget::WithBounds(planned.problem, Bounds(planned.problem))),
        world_(problem_, uncertainty::Propagation::kSound) {
    for (const plan::StepId id : planned.plan.ExecutionOrder()) {
      const plan::PlannedStep& step = planned.plan.step(id);
      for (auto& precondition : uncertainty::PreconditionsOf(world_, step.action))
        preconditions_.push_back({{id, precondition.meaning}, precondition});
    }
  }

  void Draw(std::mt19937_64& random) {
    const auto& box = world_.constraints().box;
    std::vector<double> values(box.size());
    for (std::size_t v = 0; v < box.size(); ++v) values[v] = Drawn(v, box[v], random);
    std::map<Subject, bool> fails;
    for (const auto& [subject, precondition] : preconditions_) {
      const double value =
          algebra::Evaluate(precondition.expression, std::span<const double>(values));
      const bool holds = precondition.relation == plan::Relation::kLess
                             ? value < precondition.limit
                             : value > precondition.limit;
      fails[subject] = fails[subject] || !holds;
    }
    bool any = false;
    for (const auto& [subject, failed] : fails) {
      failures_[subject] += failed ? 1 : 0;
      any = any || failed;
    }
    any_ += any ? 1 : 0;
    ++samples_;
  }

  using Subject = std::pair<plan::StepId, std::string>;
  double ShareOf(const Subject& subject) const {
    const auto found = failures_.find(subject);
    return found == failures_.end() ? 0 : static_cast<double>(found->second) / samples_;
  }
  double ShareOfAny() const { return static_cast<double>(any_) / samples_; }
  const std::map<Subject, int>& failures() const { return failures_; }

 private:
  std::vector<Interval> Bounds(const domain::Problem& problem) const {
    std::vector<Interval> bounds;
    for (const budget::ErrorQuantity& quantity : budget::ErrorQuantitiesOf(problem)) {
      const auto found = errors_.distributions.find(quantity.name);
      if (found == errors_.distributions.end()) {
        bounds.push_back(quantity.bounds);
      } else if (found->second.IsCutOff()) {
        bounds.push_back(found->second.range);
      } else {
        bounds.push_back({-kFar * found->second.deviation, kFar * found->second.deviation});
      }
    }
    return bounds;
  }

  double Drawn(std::size_t v, const Interval& range, std::mt19937_64& random) const {
    const auto declared = world_.DeclaredAs(algebra::VariableId(static_cast<int>(v)));
    const auto found =
        declared ? errors_.distributions.find(declared->name) : errors_.distributions.end();
    if (found == errors_.distributions.end() ||
        found->second.shape == ErrorDistribution::Shape::kUniform) {
      return std::uniform_real_distribution<>(range.low, range.high)(random);
    }
    std::normal_distribution<> normal(0, found->second.deviation);
    while (true) {
      const double value = normal(random);
      if (value >= range.low && value <= range.high) return value;
    }
  }

  const DistributedErrors& errors_;
  domain::Problem problem_;
  uncertainty::UncertainWorld world_;
  std::vector<std::pair<Subject, uncertainty::Precondition>> preconditions_;
  std::map<Subject, int> failures_;
  int any_ = 0;
  int samples_ = 0;
};

// The share of samples that fail lies within the bounds, up to five standard deviations of the
// share. ASSAY_PROBABILITY_CASES and ASSAY_PROBABILITY_SAMPLES ask for more.
TEST(FailureProbability, ContainsTheShareOfSamples) {
  const int cases = Asked("ASSAY_PROBABILITY_CASES", 3);
  const int count = Asked("ASSAY_PROBABILITY_SAMPLES", 4'000);
  const Planned& planned = UncertainKnown();
  RandomStream random(kSeed, "distributions");
  std::mt19937_64 generator(kSeed);
  const auto expect_within = [&](const Interval& bounds, double share) {
    const double tolerance = 5 * std::sqrt(std::max(share * (1 - share), 1.0 / count) / count);
    EXPECT_LE(bounds.low, share + tolerance);
    EXPECT_GE(bounds.high, share - tolerance);
  };
  int may_fail = 0;
  for (int i = 0; i < cases; ++i) {
    const DistributedErrors errors = RandomErrors(planned.problem, random);
    const FailureProbabilities found =
        FailureProbabilitiesOf(planned.problem, planned.plan, errors);
    Samples samples(planned, errors);
    for (int sample = 0; sample < count; ++sample) samples.Draw(generator);
    SCOPED_TRACE("seed " + std::to_string(kSeed) + ", case " + std::to_string(i));
    expect_within(found.plan, samples.ShareOfAny());
    std::map<Samples::Subject, Interval> known;
    for (const PreconditionFailure& failure : found.preconditions)
      known[{failure.step, failure.meaning}] = failure.probability;
    for (const auto& [subject, failures] : samples.failures()) {
      SCOPED_TRACE(subject.second);
      expect_within(known.contains(subject) ? known[subject] : Interval{0, 0},
                    samples.ShareOf(subject));
      if (failures > 0) ++may_fail;
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

// Errors that are correlated so that they cancel each other fail less often.
TEST(FailureProbability, CorrelationsCount) {
  const Planned& planned = UncertainKnown();
  DistributedErrors errors;
  std::vector<std::string> of_parts;
  for (const budget::ErrorQuantity& quantity : budget::ErrorQuantitiesOf(planned.problem)) {
    if (quantity.name.find(".x") == std::string::npos || quantity.name.starts_with("hand"))
      continue;
    errors.distributions[quantity.name] = Normal(4 * quantity.declared());
    of_parts.push_back(quantity.name);
  }
  ASSERT_EQ(of_parts.size(), 2U);
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
