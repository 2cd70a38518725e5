#include "planner/budget/error_quantity.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/planner/constraint_posting/scenarios.h"

namespace assay::budget::error_quantity_test {
namespace {

using ::testing::Contains;
using ::testing::Not;

std::vector<std::string> NamesOf(const domain::Problem& problem) {
  std::vector<std::string> names;
  for (const ErrorQuantity& quantity : ErrorQuantitiesOf(problem)) names.push_back(quantity.name);
  return names;
}

TEST(ErrorQuantity, AreThoseOfPartsHandSensorsAndVelocity) {
  const std::vector<std::string> names = NamesOf(constraint_posting::LoadScenario("spar-fig13"));
  for (const char* name : {"peg.x", "block.theta", "hand.z", "overhead-camera.x", "velocity"})
    EXPECT_THAT(names, Contains(name));
  EXPECT_THAT(names, Not(Contains("pad_friction"))) << "the scenario has no tolerances";
  for (const std::string& name : names) EXPECT_EQ(std::ranges::count(names, name), 1) << name;
}

TEST(ErrorQuantity, EachHasItsMultiple) {
  domain::Problem problem = constraint_posting::LoadScenario("spar-fig13");
  problem.tolerances = {
      .clearance = 0.1 * problem.clearance, .friction = 0.01, .pad_friction = 0.02};
  const std::vector<ErrorQuantity> declared = ErrorQuantitiesOf(problem);
  for (std::size_t i = 0; i < declared.size(); ++i) {
    std::vector<double> multiples(declared.size(), 1);
    multiples[i] = 1.5;
    const auto changed = ErrorQuantitiesOf(WithErrorsTimes(problem, multiples));
    ASSERT_EQ(changed.size(), declared.size());
    for (std::size_t j = 0; j < declared.size(); ++j) {
      EXPECT_EQ(changed[j].name, declared[j].name);
      EXPECT_DOUBLE_EQ(changed[j].declared(), (i == j ? 1.5 : 1) * declared[j].declared())
          << declared[i].name;
    }
  }
}

TEST(ErrorQuantity, TolerancesStayBelowTheirValues) {
  domain::Problem problem = constraint_posting::LoadScenario("spar-fig13");
  problem.tolerances = {.clearance = 0.5 * problem.clearance};
  const domain::Problem scaled = WithErrorsTimes(problem, 10);
  EXPECT_LT(scaled.tolerances.clearance, problem.clearance);
  EXPECT_GT(scaled.tolerances.clearance, 0.99 * problem.clearance);
}

}  // namespace
}  // namespace assay::budget::error_quantity_test
