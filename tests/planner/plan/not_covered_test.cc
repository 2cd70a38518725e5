#include "planner/plan/not_covered.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace assay::plan::not_covered_test {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

Plan PickupThatLeaves(const ErrorSet& held) {
  Plan plan;
  plan.steps.push_back({.action = Pickup{}, .executed = 1});
  plan.steps.front().certificate.after = {held};
  return plan;
}

// Pads that jam on a turned part touch it at two points, about whose line it may turn: no
// certificate covers that, and no plan is silent of it.
TEST(NotCovered, APartInJammedPadsMayTurn) {
  const auto jammed = Contains(HasSubstr("jam"));
  const ErrorSet flat = {
      .part = domain::PartId(0), .in_hand = true, .x = {-1e-3, 1e-3}, .twist = {-0.1, 0.1}};
  EXPECT_THAT(NotCovered(PickupThatLeaves(flat)), Not(jammed));
  ErrorSet turned = flat;
  turned.theta = {-1e-3, 1e-3};
  EXPECT_THAT(NotCovered(PickupThatLeaves(turned)), jammed);
  ErrorSet tipped = flat;
  tipped.tip = {0, 1e-3};
  EXPECT_THAT(NotCovered(PickupThatLeaves(tipped)), jammed);
}

}  // namespace
}  // namespace assay::plan::not_covered_test
