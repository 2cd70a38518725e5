#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "sim/check/certificate_claims/certificate_check.h"
#include "sim/execution/walk/executor.h"
#include "sim/scene/scene.h"
#include "tests/sim/check/certified.h"

namespace assay::check::slipping_pads_test {
namespace {

// Pads whose friction is less than the resistance that stops a guarded move (plan::kResistance)
// slide down on the part after the part is seated. The place where the part stopped then tells that
// the part met its seat.
TEST(SlippingPads, MeetTheSeatWhereThePartStops) {
  domain::Problem problem = ScenarioNamed("uncertain-known");
  domain::WorkcellRules rules = problem.workcell->rules();
  rules.pad_friction = 0.04;
  rules.grip_force = 150;  // 12 N of friction, less than the 15 N that stop a move
  problem.workcell = problem.workcell->WithRules(rules);
  const Certified certified = CertifiedPlan(std::move(problem));
  ASSERT_EQ(certified.plan.errors, 0);
  const scene::Scene scene(certified.problem, {});
  mujoco::Data data = scene.Start();
  const execution::Trace trace =
      execution::Execute(certified.problem, certified.plan, scene, data, {.sample_rate = 0});
  const std::vector<Claim> claims = CheckCertificates(certified.problem, certified.plan, trace, {});
  const auto seat = std::ranges::find(claims, "seat", &Claim::name);
  ASSERT_NE(seat, claims.end());
  EXPECT_NE(seat->verdict, ClaimVerdict::kViolated) << seat->observed;
  EXPECT_NEAR(seat->observed, rules.guarded_travel, 1e-4) << "nothing errs: all of it is left";
}

}  // namespace
}  // namespace assay::check::slipping_pads_test
