#include "tests/oracle/executed_errors.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "planner/uncertainty/preconditions/certify.h"
#include "tests/planner/plan/actions.h"
#include "tests/planner/uncertainty/action_lists.h"

// In sound mode no certificate is false. Plans are executed hundreds of times with drawn errors, or
// as often as ASSAY_EXECUTIONS says.
namespace assay::uncertainty::executed_errors_test {
namespace {

using ::testing::IsEmpty;

constexpr std::uint64_t kSeed = 20;
constexpr int kMostUntilContradicted = 2000;

int ExecutionCount() {
  const char* count = std::getenv("ASSAY_EXECUTIONS");
  return count == nullptr ? 500 : std::atoi(count);
}

enum class Inserted { kNothing, kSensing, kSqueezing };

struct Trial {
  std::string scenario;
  Inserted inserted = Inserted::kNothing;
  // The error of the hand in metres. Its error in radians is ten times this number. 0 stands for
  // the scenario's error.
  double gripper = 0;
  double parts = 1;  // factor on the scenario's errors of parts
};

void PrintTo(const Trial& trial, std::ostream* out) {
  *out << trial.scenario << ", inserted " << static_cast<int>(trial.inserted) << ", gripper "
       << trial.gripper << " m, parts' errors * " << trial.parts << ", seed " << kSeed;
}

domain::PoseError Scaled(const domain::PoseError& error, double factor) {
  const auto scaled = [&](const Interval& i) { return Interval{factor * i.low, factor * i.high}; };
  return {scaled(error.x), scaled(error.y), scaled(error.z), scaled(error.theta)};
}

domain::Problem ProblemOf(const Trial& trial) {
  domain::Problem problem = LoadScenario(trial.scenario);
  for (domain::Part& part : problem.parts) part.error = Scaled(part.error, trial.parts);
  if (trial.gripper > 0) problem.gripper_error = Symmetric(trial.gripper, trial.gripper * 10);
  return problem;
}

// Inserts a look before every pickup and, for its fixed part, before every assemble. With
// kSqueezing it inserts a squeeze with the grasp of the pickup before every pickup.
std::vector<plan::Action> With(Inserted inserted, const domain::Problem& problem,
                               const std::vector<plan::Action>& actions) {
  std::vector<plan::Action> all;
  for (const plan::Action& action : actions) {
    if (const auto* pickup = As(domain::kPickup, action)) {
      if (inserted == Inserted::kSensing) {
        all.push_back(plan::Sense(pickup->part, "overhead-camera", pickup->place));
      } else if (inserted == Inserted::kSqueezing) {
        all.push_back(plan::Squeeze(pickup->part, pickup->hold, pickup->place));
      }
    } else if (const auto* assemble = As(domain::kAssemble, action)) {
      const domain::PartId fixed = problem.mating(assemble->mating).fixed;
      if (inserted == Inserted::kSensing) {
        all.push_back(plan::Sense(fixed, "overhead-camera", assemble->place));
      }
    }
    all.push_back(action);
  }
  return all;
}

bool IsProved(const std::vector<CertifiedAction>& actions) {
  return std::ranges::all_of(actions, [](const CertifiedAction& action) {
    return std::ranges::all_of(action.certificate.preconditions,
                               &plan::CertifiedPrecondition::holds);
  });
}

class ExecutedPlans : public ::testing::TestWithParam<Trial> {};

TEST_P(ExecutedPlans, ContradictNoCertificate) {
  const domain::Problem problem = ProblemOf(GetParam());
  const auto certified = Certify(problem, With(GetParam().inserted, problem, FirstPlan(problem)));
  RandomStream random(kSeed, "executed plans");
  const int executions = ExecutionCount();
  int completed = 0;
  for (int i = 0; i < executions; ++i) {
    const oracle::Execution execution = oracle::ExecuteOnce(problem, certified, random);
    ASSERT_THAT(execution.contradictions, IsEmpty()) << "execution " << i;
    completed += execution.completed;
  }
  // Nothing goes wrong in a plan whose preconditions are all proved.
  EXPECT_GE(completed, IsProved(certified) ? executions : executions / 100 + 1);
}

INSTANTIATE_TEST_SUITE_P(
    Scenarios, ExecutedPlans,
    ::testing::Values(Trial{"spar-example"}, Trial{"spar-example", Inserted::kSensing},
                      Trial{"spar-example", Inserted::kSqueezing, 0.0003},
                      Trial{"spar-fig13", Inserted::kSensing, 0.0003, 0.2},
                      Trial{"spar-fig14", Inserted::kSqueezing, 0.0003, 0.5},
                      Trial{"spar-fig15", Inserted::kNothing, 0, 0.1},
                      Trial{"spar-fig16", Inserted::kSensing, 0.0001, 0.3},
                      Trial{"keyed", Inserted::kSensing, 0.00001, 0.05},
                      Trial{"keyed", Inserted::kSensing, 0.00001, 0.02},  // all is proved
                      Trial{"two-pegs", Inserted::kSensing, 0.00002, 0.05}));

// The oracle can find false certificates: if errors exceed the assumed bounds, executions
// contradict the certificates.
TEST(ExecutedErrors, BeyondTheirBoundsContradict) {
  const Trial trial{"keyed", Inserted::kSensing, 0.00001, 0.02};
  const domain::Problem assumed = ProblemOf(trial);
  const auto certified = Certify(assumed, With(trial.inserted, assumed, FirstPlan(assumed)));
  const auto contradicted = [&](const domain::Problem& problem) {
    RandomStream random(kSeed, "beyond");
    for (int i = 0; i < kMostUntilContradicted; ++i) {
      if (!oracle::ExecuteOnce(problem, certified, random).contradictions.empty()) return true;
    }
    return false;
  };
  EXPECT_FALSE(contradicted(assumed));
  domain::Problem part = assumed;
  part.parts[0].error = Scaled(part.parts[0].error, 1.2);
  EXPECT_TRUE(contradicted(part));
  domain::Problem hand = assumed;
  hand.gripper_error = Scaled(hand.gripper_error, 1.2);
  EXPECT_TRUE(contradicted(hand));
}

}  // namespace
}  // namespace assay::uncertainty::executed_errors_test
