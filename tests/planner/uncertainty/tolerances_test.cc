#include <gtest/gtest.h>

#include <algorithm>

#include "planner/domain/matings/shaft_fit.h"
#include "planner/domain/parts/part_file.h"
#include "planner/plan/certificates/condition_table.h"
#include "planner/uncertainty/error_sets/squeezing.h"
#include "planner/uncertainty/preconditions/precondition.h"
#include "tests/planner/uncertainty/part_on_table.h"

// The effect of tolerances of clearance and friction on certificates.
namespace assay::uncertainty::tolerances_test {
namespace {

constexpr double kRounding = 1e-15;
constexpr double kTolerance = 0.0001;  // tolerance of the clearance, metres

// Returns the preconditions of the mating, with the first grasp of the held part.
std::vector<Precondition> OfMating(const domain::Problem& problem,
                                   Propagation propagation = Propagation::kSound) {
  UncertainWorld world(problem, propagation);
  const domain::MatingId mating(0);
  const PartId held = problem.mating(mating).held;
  const domain::Grasp& grasp = problem.part(held).grasps->front();
  const plan::Hold hold = {grasp.label, grasp.X_PartTool, grasp.width};
  const ManipulatorError draw = world.DrawManipulator();
  const HeldError error = ClosePads(world, held, hold, draw);
  world.SetHeld(held, error);
  return MatingPreconditions(world, mating, hold,
                             PossibleGrasp(error, world.DrawManipulator(), propagation));
}

domain::Problem Keyed() { return LoadScenario("keyed"); }

void ExpectSame(const std::vector<Precondition>& a, const std::vector<Precondition>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].condition, b[i].condition);
    EXPECT_EQ(a[i].meaning, b[i].meaning);
    EXPECT_EQ(a[i].limit, b[i].limit);
  }
}

// Returns the preconditions whose meaning ends with this text.
std::vector<Precondition> Ending(const std::string& end, std::vector<Precondition> all) {
  std::erase_if(all, [&](const Precondition& p) { return !p.meaning.ends_with(end); });
  return all;
}

// The clearance moves every wall of these holes outward. Only the limits of preconditions depend on
// it.
TEST(ToleranceOfClearance, TakesItselfFromEntryAndSlideIn) {
  for (const char* name : {"spar-example", "keyed", "two-pegs"}) {
    domain::Problem problem = LoadScenario(name);
    const auto exact = Ending("stays inside the walls", OfMating(problem));
    problem.tolerances.clearance = kTolerance;
    const auto tolerant = Ending("stays inside the walls", OfMating(problem));
    ASSERT_EQ(tolerant.size(), exact.size()) << name;
    EXPECT_GE(exact.size(), 32u) << "four corners, four walls, at the start and at the end";
    for (std::size_t i = 0; i < exact.size(); ++i) {
      ASSERT_EQ(exact[i].relation, plan::Relation::kGreater);
      EXPECT_NEAR(tolerant[i].limit - exact[i].limit, kTolerance, kRounding)
          << exact[i].condition.name();
    }
  }
}

// The tolerances of both walls count, even if the wrist yields.
TEST(ToleranceOfClearance, CountsTwiceForTheWidth) {
  domain::Problem problem = Keyed();
  domain::WorkcellRules rules = problem.workcell->rules();
  rules.lateral_compliance = 0.002;
  problem.workcell = problem.workcell->WithRules(rules);
  const auto exact = Ending("fits between the walls", OfMating(problem));
  problem.tolerances.clearance = kTolerance;
  const auto tolerant = Ending("fits between the walls", OfMating(problem));
  ASSERT_EQ(tolerant.size(), exact.size());
  EXPECT_GT(exact.size(), 0u);
  for (std::size_t i = 0; i < exact.size(); ++i) {
    EXPECT_NEAR(tolerant[i].limit - exact[i].limit, 2 * kTolerance, kRounding);
  }
}

// An octagon leans between four pairs of walls. Two of the pairs are at 45 degrees to its axes.
TEST(Tilt, IsAskedForAcrossEveryPairOfWalls) {
  const domain::Problem problem = LoadScenario("mate-octagonal");
  std::size_t slots = 0;
  for (const domain::ShaftFit& fit : domain::FitsOf(problem, problem.matings.front())) {
    slots += domain::SlotsOf(domain::SideWalls(fit, 0)).size();
  }
  EXPECT_EQ(slots, 4u);
  const std::vector<Precondition> all = OfMating(problem);
  EXPECT_GT(
      std::ranges::count(all, plan::Condition(plan::condition::kTilt), &Precondition::condition), 4)
      << "the two pairs along its axes, to either side; equal ones are kept once";
}

// Returns the least limit of tilt. It is the limit of the shaft that wedges first, which is short
// and wide.
double LeastTilt(const domain::Problem& problem) {
  double least = 10;
  for (const Precondition& p : OfMating(problem)) {
    if (p.condition == plan::condition::kTilt) least = std::min(least, std::abs(p.limit));
  }
  return least;
}

// A tolerance has the same effect as a hole that is really narrower by it.
TEST(ToleranceOfClearance, IsTheNarrowestHole) {
  domain::Problem tolerant = Keyed();
  domain::Problem narrow = tolerant;
  tolerant.tolerances.clearance = kTolerance;
  narrow.clearance -= kTolerance;
  for (domain::Part& part : narrow.parts)
    part.model = domain::PartFile::WithClearance(*part.model, narrow.clearance);
  const auto a = Ending("stays inside the walls", OfMating(tolerant));
  const auto b = Ending("stays inside the walls", OfMating(narrow));
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i].limit, b[i].limit, 1e-12);
  EXPECT_NEAR(LeastTilt(tolerant), LeastTilt(narrow), 1e-12);
}

TEST(ToleranceOfFriction, WedgesAtSmallerTilts) {
  domain::Problem problem = Keyed();
  domain::WorkcellRules rules = problem.workcell->rules();
  rules.friction = 3;  // so that wedging comes before touching twice
  problem.workcell = problem.workcell->WithRules(rules);
  const double exact = LeastTilt(problem);
  problem.tolerances.friction = 1;
  EXPECT_NEAR(LeastTilt(problem), exact * 3 / 4, 1e-12);  // clearance / (friction * width)
  problem.tolerances.clearance = problem.clearance / 2;
  EXPECT_NEAR(LeastTilt(problem), exact * 3 / 8, 1e-12);
}

TEST(Tolerances, DoNothingInPaperMode) {
  domain::Problem problem = Keyed();
  const auto published = OfMating(problem, Propagation::kPaper);
  problem.tolerances = {.clearance = kTolerance, .friction = 0.1, .pad_friction = 0.1};
  ExpectSame(OfMating(problem, Propagation::kPaper), published);
}

// ---- Pads ----

HeldError CloseOn(UncertainWorld& world) {
  const plan::Hold hold = HoldFromAbove(world.problem(), Vector3::UnitX());
  return ClosePads(world, kBlock, hold, world.DrawManipulator());
}

// The pads jam if the sum of friction and tolerance is large enough, however the sum is divided.
TEST(ToleranceOfPadFriction, IsFrictionThatMayJam) {
  for (const double friction : {0.05, 0.2, 0.4, 0.8}) {
    for (const double share : {0.0, 0.3, 0.9}) {
      domain::Problem problem = UprightBlock({});
      domain::WorkcellRules rules = problem.workcell->rules();
      rules.pad_friction = friction * (1 - share);
      problem.workcell = problem.workcell->WithRules(rules);
      problem.tolerances.pad_friction = friction * share;
      UncertainWorld world(problem, Propagation::kSound);
      EXPECT_EQ(CloseOn(world).skew.IsConstant(0), friction < 0.1) << friction << " " << share;
    }
  }
}

// The effect of the first pad on a part depends on the place of the centre of mass, which depends
// on the clearance.
TEST(ToleranceOfClearance, MovesTheCentreOfMass) {
  const auto slip = [](double tolerance) {
    domain::Problem problem = UprightBlock({});
    problem.tolerances.clearance = tolerance;
    UncertainWorld world(problem, Propagation::kSound);
    const plan::Hold off_center = [&] {
      plan::Hold hold = HoldFromAbove(problem, Vector3::UnitX());
      hold.X_PartTool.translation().y() += kInch;
      return hold;
    }();
    const HeldError held = ClosePads(world, kBlock, off_center, world.DrawManipulator());
    return Magnitude(world.TightRangeOf(held.x));
  };
  const double exact = slip(0);
  EXPECT_GT(slip(0.0002), exact);
  EXPECT_GT(slip(0.0004), slip(0.0002));
  EXPECT_LT(slip(0.0004), 1.01 * exact);
}

// ---- Whole plans ----

// Returns whether all cases of the preconditions with this meaning hold.
bool Proves(const plan::Certificate& certificate, const std::string& meaning) {
  return std::ranges::all_of(certificate.preconditions, [&](const auto& precondition) {
    return precondition.meaning != meaning || precondition.holds();
  });
}

TEST(Tolerances, ProveNoMoreTheGreaterTheyAre) {
  domain::Problem problem = LoadScenario("uncertain-known");
  const auto actions = FirstPlan(problem);
  auto before = Certify(problem, actions);
  for (const double share : {0.2, 0.5, 0.9}) {
    problem.tolerances = {.clearance = share * problem.clearance,
                          .friction = share * 0.25,
                          .pad_friction = share * 0.15};
    const auto after = Certify(problem, actions);
    for (std::size_t s = 0; s < actions.size(); ++s) {
      for (const auto& claim : after[s].certificate.preconditions) {
        EXPECT_TRUE(Proves(before[s].certificate, claim.meaning) ||
                    !Proves(after[s].certificate, claim.meaning))
            << share << ": " << claim.meaning;
      }
    }
    before = after;
  }
}

}  // namespace
}  // namespace assay::uncertainty::tolerances_test
