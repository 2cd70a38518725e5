#include "planner/plan/not_covered.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace assay::plan::not_covered_test {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

Plan PutdownWith(const std::string& error) {
  Plan plan;
  PlannedStep& step = plan.steps.emplace_back();
  step.action = Putdown{};
  step.executed = 1;
  step.certificate.variables.emplace_back().name = error;
  return plan;
}

// Pads that jam on a turned part touch it at two points, about whose line it may turn: no
// certificate covers that, and no plan is silent of it.
TEST(NotCovered, APartInJammedPadsMayTurn) {
  const auto jammed = Contains(HasSubstr("jam"));
  EXPECT_THAT(NotCovered(PutdownWith("slip_peg")), Not(jammed));
  EXPECT_THAT(NotCovered(PutdownWith(std::string(kJam) + "_peg")), jammed);
}

}  // namespace
}  // namespace assay::plan::not_covered_test
