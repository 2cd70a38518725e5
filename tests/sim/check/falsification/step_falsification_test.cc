#include "sim/check/falsification/step_falsification.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>

#include "planner/geometry/pose.h"
#include "sim/check/noise_floor/measure_noise_floor.h"
#include "sim/noise/error_box.h"
#include "sim/noise/possible_start.h"
#include "sim/noise/sampling.h"
#include "tests/sim/check/certified.h"

namespace assay::check::step_falsification_test {
namespace {

// A plan with a look and the pickup after it.
class PickupAfterALook : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    certified_ = new Certified(CertifiedPlan("uncertain-sensing"));
    certified_->plan = UpToThePickup(certified_->plan);
    experiment_ = new Experiment{certified_->problem,
                                 certified_->plan,
                                 {},
                                 MeasureNoiseFloor(certified_->problem, certified_->plan, {})};
    worlds_ = new std::vector<TriedWorld>(
        WorldsOf(*experiment_, noise::ErrorBox(certified_->problem, certified_->plan)));
  }
  static void TearDownTestSuite() {
    delete worlds_;
    delete experiment_;
    delete certified_;
  }

  PickupAfterALook()
      : pickup_(FirstStep(domain::kPickup, certified_->plan)),
        falsification_(*experiment_, pickup_, world().noise) {}

  static const TriedWorld& world() { return worlds_->front(); }
  PoisedTrial Poised() const {
    // The trial begins at the start of the plan and makes the look on its way.
    return *falsification_.Poise(world(), world().noise, nullptr).poised;
  }
  // Returns the corner with all errors at their upper ends.
  std::vector<double> Corner() const {
    std::vector<double> values;
    for (const std::size_t i : falsification_.free_channels()) {
      values.push_back(world().noise.box()[i].range.high);
    }
    return values;
  }
  domain::PartId part() const { return certified_->plan.step(pickup_).action.part; }
  // Returns the trial with the part displaced from where it came to rest, as if the engine had
  // erred.
  PoisedTrial Spoiled(PoisedTrial poised, const geometry::Vector3& by) const {
    execution::ExecutorOptions options;
    options.noise = poised.noise;
    mujoco::Data data(world().scene.model());
    execution::Execution execution(certified_->problem, world().scene, data, options);
    execution.Restore(poised.checkpoint);
    const geometry::Pose truth = world().scene.TruePose(data, part());
    world().scene.SetPart(data, part(), geometry::Translation(by) * truth);
    poised.checkpoint = execution.Save();
    return poised;
  }

  static inline Certified* certified_ = nullptr;
  static inline Experiment* experiment_ = nullptr;
  static inline std::vector<TriedWorld>* worlds_ = nullptr;
  const plan::StepId pickup_;
  const StepFalsification falsification_;
};

const Claim* Find(const std::vector<Claim>& claims, const Claim& claim) {
  const auto found =
      std::ranges::find_if(claims, [&](const Claim& other) { return IsSame(other, claim); });
  return found == claims.end() ? nullptr : &*found;
}

// An attempt that is broken off when a claim is decided observes exactly the same values for that
// claim as an attempt to the end.
TEST_F(PickupAfterALook, ABrokenOffAttemptSaysTheSameOfWhatIsDecided) {
  const PoisedTrial poised = Poised();
  const StepAttempt whole = falsification_.Attempt(poised, Corner(), Until::kEnd);
  ASSERT_TRUE(whole.IsWhole());
  ASSERT_TRUE(whole.end);
  for (const Until until : {Until::kPoised, Until::kReached, Until::kActed}) {
    const StepAttempt begun = falsification_.Attempt(poised, Corner(), until);
    EXPECT_FALSE(begun.IsWhole());
    EXPECT_FALSE(begun.end);
    int decided = 0;
    for (std::size_t i = 0; i < whole.claims.size(); ++i) {
      if (whole.decisions[i].until > until) continue;
      ++decided;
      const Claim* const claim = Find(begun.claims, whole.claims[i]);
      ASSERT_NE(claim, nullptr) << whole.claims[i].name;
      EXPECT_EQ(claim->observed, whole.claims[i].observed) << claim->name;
      EXPECT_EQ(claim->verdict, whole.claims[i].verdict) << claim->name;
    }
    EXPECT_GT(decided, 0);
  }
}

// Claims about the start of a step are decided at its start. Claims about its end are decided at
// its end.
TEST_F(PickupAfterALook, ClaimsAreDecidedInTheOrderOfTime) {
  const StepAttempt whole = falsification_.Attempt(Poised(), Corner(), Until::kEnd);
  std::set<Until> seen;
  for (std::size_t i = 0; i < whole.claims.size(); ++i) {
    const Until until = whole.decisions[i].until;
    seen.insert(until);
    if (whole.claims[i].about == Claimed::kBefore) {
      EXPECT_EQ(until, Until::kPoised);
    }
    if (whole.claims[i].about == Claimed::kAfter) {
      EXPECT_EQ(until, Until::kEnd);
    }
  }
  EXPECT_EQ(seen, (std::set{Until::kPoised, Until::kReached, Until::kActed, Until::kEnd}));
}

// An error of the engine in a saved state would be confirmed by every execution that starts from
// that state. The finer trial therefore starts with the plan, and finds no violation.
TEST_F(PickupAfterALook, WhatASavedStateHasOfItselfIsNoViolation) {
  const PoisedTrial spoiled = Spoiled(Poised(), {0.004, 0, 0});
  const StepAttempt attempt = falsification_.Attempt(spoiled, Corner(), Until::kPoised);
  EXPECT_FALSE(attempt.claims.empty());
  for (const Claim& claim : attempt.claims) EXPECT_FALSE(claim.IsViolated()) << claim.name;
}

// An observation that half the timestep confirms from the start of the plan is a violation.
TEST_F(PickupAfterALook, WhatIsSoFromTheStartIsAViolation) {
  plan::Plan lied = certified_->plan;
  for (plan::ErrorSet& set : lied.steps[pickup_.index()].certificate.before) {
    set.x = {0.02, 0.03};
  }
  const Experiment experiment{certified_->problem, lied, {}, experiment_->gate};
  const StepFalsification falsification(experiment, pickup_, world().noise);
  const PoisedTrial poised = *falsification.Poise(world(), world().noise, nullptr).poised;
  const StepAttempt attempt = falsification.Attempt(poised, Corner(), Until::kPoised);
  EXPECT_TRUE(std::ranges::any_of(attempt.claims, &Claim::IsViolated));
}

// A brick stands half a millimetre beside the block, and may be 3 mm off.
domain::Problem WithANeighbour() {
  std::ostringstream read;
  read << std::ifstream(ASSAY_SOURCE_DIR "/scenarios/uncertain-known.yaml").rdbuf();
  std::string text = read.str();
  text.replace(text.find("yaw: 30"), 7, "yaw: 0");
  text.insert(text.find("gripper:"),
              "  brick: {model: brick, pose: {stable: upright, at: [664.0, 130]},"
              " error: {x: 3, y: 3, theta: 1}}\n");
  return domain::ReadProblem(Document::Parse(text, "s.yaml"), ASSAY_SOURCE_DIR "/models");
}

// The engine would throw parts apart that overlap.
TEST(AttemptsBesideANeighbour, StartInPossibleWorldsOnly) {
  const Certified certified = CertifiedPlan(WithANeighbour());
  ASSERT_FALSE(certified.plan.steps.empty());
  const Experiment experiment{certified.problem, certified.plan};
  const auto worlds = WorldsOf(experiment, noise::ErrorBox(certified.problem, certified.plan));
  const TriedWorld& world = worlds.front();
  const StepFalsification falsification(experiment, certified.plan.ExecutionOrder().front(),
                                        world.noise);
  const Approach approach = falsification.Poise(world, world.noise, nullptr);
  ASSERT_TRUE(approach.poised);
  const std::vector<std::size_t>& free = falsification.free_channels();
  const noise::PossibleStart start(certified.problem);
  int impossible = 0;
  for (int number = 1; number <= 8; ++number) {
    noise::Noise corner = world.noise;
    std::vector<double> values;
    for (const double end : noise::CornerPoint(static_cast<int>(free.size()), 1, number)) {
      const std::size_t channel = free[values.size()];
      const Interval& range = corner.box()[channel].range;
      values.push_back(end > 0 ? range.high : range.low);
      corner.Set(channel, values.back());
    }
    if (start.FirstOverlap(corner)) ++impossible;
    const StepAttempt attempt = falsification.Attempt(*approach.poised, values, Until::kPoised);
    EXPECT_FALSE(start.FirstOverlap(attempt.noise)) << number;
  }
  EXPECT_GT(impossible, 0);
}

}  // namespace
}  // namespace assay::check::step_falsification_test
