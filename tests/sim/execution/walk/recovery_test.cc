#include "sim/execution/walk/recovery.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "planner/geometry/collision.h"
#include "planner/geometry/pose.h"
#include "sim/execution/walk/executor.h"
#include "tests/sim/execution/figure15.h"
#include "tests/sim/execution/trace/trace_schema.h"

namespace assay::execution::recovery_test {
namespace {

using domain::RecoveryStrategy;

constexpr plan::StepId kAssemble(0);
constexpr plan::StepId kPickup(1);

plan::Recovery Groping(plan::StepId step, const std::string& error, double radius, double pitch) {
  return {.step = step,
          .error = error,
          .strategy = RecoveryStrategy::kGropingSearch,
          .radius = radius,
          .pitch = pitch};
}

plan::Recovery Simple(plan::StepId step, const std::string& error, RecoveryStrategy strategy) {
  return {.step = step, .error = error, .strategy = strategy};
}

// Neighbouring places on a circle are about a pitch apart. This gives 7 places on the first circle
// (2 pi), 13 on the second and 19 on the third.
TEST(PlacesToTryTest, AreOnCirclesThatGrowByThePitch) {
  const std::vector<Vector3> places =
      PlacesToTry(Groping(kPickup, "error1", 0.010, 0.003), Vector3::UnitZ());
  ASSERT_EQ(places.size(), 7u + 13 + 19);
  std::size_t i = 0;
  for (const auto& [circle, count] : {std::pair(1, 7), std::pair(2, 13), std::pair(3, 19)}) {
    const Vector3 first = places[i];
    for (int k = 0; k < count; ++k, ++i) {
      EXPECT_NEAR(places[i].norm(), circle * 0.003, 1e-12);
      EXPECT_EQ(places[i].z(), 0);
      const double angle = 2 * std::numbers::pi * k / count;
      EXPECT_NEAR(places[i].dot(first), std::cos(angle) * first.squaredNorm(), 1e-12);
    }
  }
}

// Every point within the radius is near a place that is tried. The distance is at most half the
// diagonal of a square whose side is the pitch.
TEST(PlacesToTryTest, LeaveNoGap) {
  const double radius = 0.004, pitch = 0.001;
  std::vector<Vector3> tried =
      PlacesToTry(Groping(kAssemble, "error4", radius, pitch), Vector3::UnitZ());
  EXPECT_EQ(tried.size(), 7u + 13 + 19 + 26);
  tried.emplace_back(0, 0, 0);  // the place of the first attempt
  for (double x = -radius; x <= radius; x += pitch / 10) {
    for (double y = -radius; y <= radius; y += pitch / 10) {
      if (std::hypot(x, y) > radius) continue;
      double nearest = 1;
      for (const Vector3& place : tried)
        nearest = std::min(nearest, std::hypot(place.x() - x, place.y() - y));
      ASSERT_LE(nearest, std::sqrt(0.5) * pitch + 1e-9) << x << ", " << y;
    }
  }
}

TEST(PlacesToTryTest, AreAcrossTheAxis) {
  const Vector3 axis = Vector3(1, -2, 0.5).normalized();
  const std::vector<Vector3> places = PlacesToTry(Groping(kPickup, "error1", 0.002, 0.001), axis);
  ASSERT_EQ(places.size(), 7u + 13);
  for (const Vector3& place : places) EXPECT_NEAR(place.dot(axis), 0, 1e-15);
}

TEST(PlacesToTryTest, OfARetryAreTheSame) {
  const plan::Recovery retry = Simple(kPickup, "error1", RecoveryStrategy::kRetry);
  EXPECT_EQ(PlacesToTry(retry, Vector3::UnitZ()), std::vector<Vector3>(kRetries, Vector3(0, 0, 0)));
}

TEST(PlacesToTryTest, OfTheOperatorAreNone) {
  const plan::Recovery call = Simple(kPickup, "error2", RecoveryStrategy::kCallOperator);
  EXPECT_TRUE(PlacesToTry(call, Vector3::UnitZ()).empty());
}

// The plan of Spar's figure 15 with two verifications: the gripper's opening after the pickup, and
// the tool's height after the mating.
class Recovering : public testing::Test {
 protected:
  Recovering()
      : problem_(Figure15()), peg_(PartNamed(problem_, "peg")), plan_(TwoActions(problem_)) {
    const auto& pickup = plan_.step(kPickup).action;
    const domain::Mating& mating = problem_.mating(domain::MatingId(0));
    const Pose seated =
        problem_.part(mating.fixed).X_WorldPart * mating.X_FixedHeld * pickup.hold.X_PartTool;
    plan_.verifications = {{.step = kPickup,
                            .name = "gripper-opening",
                            .quantity = domain::MeasuredQuantity::kGripperOpening,
                            .expected = pickup.hold.width,
                            .tolerance = 0.001,
                            .below = "error1",
                            .above = "error2"},
                           {.step = kAssemble,
                            .name = "seated",
                            .quantity = domain::MeasuredQuantity::kToolHeight,
                            .expected = seated.translation().z(),
                            .tolerance = 0.002,
                            .below = "error3",
                            .above = "error4"}};
    plan_.recoveries = {Groping(kPickup, "error1", 0.015, 0.015),
                        Simple(kPickup, "error2", RecoveryStrategy::kCallOperator),
                        Simple(kAssemble, "error3", RecoveryStrategy::kCallOperator),
                        Groping(kAssemble, "error4", 0.004, 0.001)};
  }

  static const scene::Scene& scene() {
    static const scene::Scene scene(Figure15(), {});
    return scene;
  }
  // Executes the plan with a part displaced from its believed pose, in the world's axes.
  Trace Run(PartId part, const Vector3& displacement, const ExecutorOptions& options) {
    mujoco::Data data = StartOf(problem_, scene(), {});
    const Pose X_WorldPart = scene().TruePose(data, part);
    scene().SetPart(data, part, geometry::Translation(displacement) * X_WorldPart);
    return Execute(problem_, plan_, scene(), data, options);
  }
  // Returns a displacement of the peg along its shaft by `length` metres. It takes the plate out
  // from between the pads.
  Vector3 OutOfThePads(double length) const {
    Vector3 shaft = problem_.part(peg_).X_WorldPart.linear().col(0);
    shaft.z() = 0;
    return length * shaft.normalized();
  }
  // Expects that the attempts of a search count up from 1 and are made at its places.
  static void ExpectAttempts(const Trace& trace, const plan::Recovery& recovery,
                             const Vector3& axis) {
    const auto records = trace.All<RecoveryRecord>();
    const std::vector<Vector3> places = PlacesToTry(recovery, axis);
    for (std::size_t i = 0; i < records.size(); ++i) {
      if (records[i]->strategy == RecoveryStrategy::kCallOperator) continue;
      EXPECT_EQ(records[i]->error, recovery.error);
      EXPECT_EQ(records[i]->step, recovery.step);
      EXPECT_EQ(records[i]->attempt, static_cast<int>(i) + 1);
      EXPECT_LT((records[i]->offset - places[i]).norm(), 1e-9);
    }
  }

  domain::Problem problem_;
  PartId peg_;
  plan::Plan plan_;
};

TEST_F(Recovering, NothingIsDoneWhenAllIsWell) {
  const Trace trace = Run(peg_, Vector3::Zero(), {.sample_rate = 0});
  EXPECT_EQ(trace.end().outcome, TrialOutcome::kSucceeded) << trace.end().reason;
  const auto checks = trace.All<VerificationRecord>();
  ASSERT_EQ(checks.size(), 2u);
  EXPECT_EQ(checks[0]->name, "gripper-opening");
  EXPECT_NEAR(checks[0]->measured, checks[0]->expected, 1e-4);
  EXPECT_EQ(checks[1]->name, "seated");
  EXPECT_NEAR(checks[1]->measured, checks[1]->expected, 2e-4);
  for (const VerificationRecord* check : checks) EXPECT_EQ(check->error, "");
  EXPECT_TRUE(trace.All<RecoveryRecord>().empty());
}

TEST_F(Recovering, ASearchFindsWhatThePadsMissed) {
  const Trace trace = Run(peg_, OutOfThePads(30e-3), {.sample_rate = 0, .last = kPickup});
  ASSERT_EQ(trace.end().outcome, TrialOutcome::kSucceeded) << trace.end().reason;
  const auto checks = trace.All<VerificationRecord>();
  const auto recoveries = trace.All<RecoveryRecord>();
  ASSERT_GE(recoveries.size(), 1u);
  ASSERT_EQ(checks.size(), recoveries.size() + 1) << "once more after each attempt";
  for (std::size_t i = 0; i < recoveries.size(); ++i) {
    EXPECT_EQ(checks[i]->error, "error1");
    EXPECT_LT(checks[i]->time, recoveries[i]->time + 1e-9);
    EXPECT_LT(recoveries[i]->time, checks[i + 1]->time);
  }
  EXPECT_EQ(checks.back()->error, "");
  ExpectAttempts(trace, plan_.recoveries[0], Vector3::UnitZ());
  EXPECT_TRUE(trace.All<GraspFact>().back()->holds());
  const TrueAndBelieved& lifted = trace.end().snapshot.parts[peg_.index()];
  EXPECT_GT(lifted.truth.translation().z(), 0.2) << "it is in the hand";
  const auto& pickup = plan_.step(kPickup).action;
  const Vector3 told = (pickup.place.X_WorldPart * pickup.hold.X_PartTool).translation();
  const Vector3 tool = trace.end().snapshot.tool.believed.translation();
  EXPECT_LT((tool - told - recoveries.back()->offset).head<2>().norm(), 1e-6)
      << "straight up from where it was found";
  EXPECT_THAT(SchemaErrors(trace), testing::IsEmpty());
}

// No place gives the expected opening. Each place is tried once, and then the operator is called.
TEST_F(Recovering, ASearchInVainCallsTheOperator) {
  plan_.verifications[0].expected += 0.002;
  plan_.recoveries[0] = Groping(kPickup, "error1", 0.001, 0.001);
  const Trace trace = Run(peg_, Vector3::Zero(), {.sample_rate = 0});
  EXPECT_EQ(trace.end().outcome, TrialOutcome::kOperatorCalled);
  EXPECT_EQ(trace.end().reason, "action_2: error1, and no attempt to mend it succeeded");
  const auto recoveries = trace.All<RecoveryRecord>();
  ASSERT_EQ(recoveries.size(), 8u) << "one circle of 7 places, and the operator";
  ExpectAttempts(trace, plan_.recoveries[0], Vector3::UnitZ());
  EXPECT_EQ(recoveries.back()->strategy, RecoveryStrategy::kCallOperator);
  EXPECT_EQ(recoveries.back()->attempt, 0);
  EXPECT_TRUE(trace.All<StepEnd>().empty()) << "the step did not end";
}

// The block stands 5 mm beside the hand. The peg is gone, and it is looked for within 15 mm.
TEST_F(Recovering, NoSearchLeadsTheHandIntoAnotherPart) {
  const PartId block = PartNamed(problem_, "block");
  const auto& pickup = plan_.step(kPickup).action;
  const Pose tool = pickup.place.X_WorldPart * pickup.hold.X_PartTool;
  const geometry::CollisionShape hand =
      problem_.workcell->HandShape(problem_.workcell->gripper().max_opening());
  const geometry::CollisionShape& shape = problem_.part(block).model->shape();
  Pose& X_WorldBlock = problem_.parts[block.index()].X_WorldPart;
  const auto room = [&](const Vector3& offset) {
    return Distance(hand, geometry::Translation(offset) * tool, shape, X_WorldBlock);
  };
  const double height = X_WorldBlock.translation().z();
  X_WorldBlock.translation() = tool.translation() + Vector3(0.4, 0, 0);
  X_WorldBlock.translation().z() = height;
  while (room(Vector3::Zero()) > 0.005) X_WorldBlock.translation().x() -= 0.0005;
  mujoco::Data data = StartOf(problem_, scene(), {});
  scene().SetPart(data, block, X_WorldBlock);
  scene().SetPart(data, peg_,
                  geometry::Translation(Vector3(-0.3, 0, 0)) * scene().TruePose(data, peg_));
  const Trace trace = Execute(problem_, plan_, scene(), data, {.sample_rate = 0, .last = kPickup});
  EXPECT_EQ(trace.end().outcome, TrialOutcome::kOperatorCalled) << trace.end().reason;
  const auto recoveries = trace.All<RecoveryRecord>();
  EXPECT_GT(recoveries.size(), 1u);
  EXPECT_LT(recoveries.size(), 8u) << "some of the circle's 7 places are in the block";
  for (const RecoveryRecord* record : recoveries) {
    EXPECT_GE(room(record->offset), room(Vector3::Zero()) - 1e-9);
  }
}

// The gripper is wider open than expected, so that something else seems to be grasped.
TEST_F(Recovering, SomeErrorsCallTheOperatorAtOnce) {
  plan_.verifications[0].expected -= 0.002;
  const Trace trace = Run(peg_, Vector3::Zero(), {.sample_rate = 0});
  EXPECT_EQ(trace.end().outcome, TrialOutcome::kOperatorCalled);
  EXPECT_EQ(trace.end().reason, "action_2: error2");
  const auto recoveries = trace.All<RecoveryRecord>();
  ASSERT_EQ(recoveries.size(), 1u);
  EXPECT_EQ(recoveries[0]->attempt, 0);
}

// The plan has no recovery for the error.
TEST_F(Recovering, AnErrorWithoutARecoveryCallsTheOperator) {
  plan_.verifications[0].expected -= 0.002;
  plan_.recoveries.clear();
  const Trace trace = Run(peg_, Vector3::Zero(), {.sample_rate = 0});
  EXPECT_EQ(trace.end().outcome, TrialOutcome::kOperatorCalled);
  EXPECT_EQ(trace.end().reason, "action_2: error2");
}

TEST_F(Recovering, WithoutRecoveryTheOperatorIsCalledAtOnce) {
  const Trace trace = Run(peg_, OutOfThePads(30e-3), {.sample_rate = 0, .recovers = false});
  EXPECT_EQ(trace.end().outcome, TrialOutcome::kOperatorCalled);
  EXPECT_EQ(trace.end().reason, "action_2: error1");
  EXPECT_EQ(trace.All<RecoveryRecord>().size(), 1u);
}

// The error stays. The step is tried a few more times at the same place.
TEST_F(Recovering, ARetryIsMadeAFewTimes) {
  plan_.verifications[0].expected += 0.002;
  plan_.recoveries[0].strategy = RecoveryStrategy::kRetry;
  const Trace trace = Run(peg_, Vector3::Zero(), {.sample_rate = 0});
  EXPECT_EQ(trace.end().outcome, TrialOutcome::kOperatorCalled);
  const auto recoveries = trace.All<RecoveryRecord>();
  ASSERT_EQ(recoveries.size(), static_cast<std::size_t>(kRetries) + 1);
  ExpectAttempts(trace, plan_.recoveries[0], Vector3::UnitZ());
  const auto grasps = trace.All<GraspFact>();
  ASSERT_EQ(grasps.size(), static_cast<std::size_t>(kRetries) + 1);
  for (const GraspFact* grasp : grasps) EXPECT_NEAR(grasp->opening, grasp->expected_width, 1e-4);
}

// The block is displaced by 1.7 mm, which is more than the hole's clearance. The peg meets the rim,
// and then finds the hole at the block's true pose.
TEST_F(Recovering, APegThatStopsAtTheRimIsGropedIn) {
  const domain::Mating& mating = problem_.mating(domain::MatingId(0));
  const Trace trace = Run(mating.fixed, {0.0015, 0.0008, 0}, {.sample_rate = 0});
  ASSERT_EQ(trace.end().outcome, TrialOutcome::kSucceeded) << trace.end().reason;
  const auto recoveries = trace.All<RecoveryRecord>();
  ASSERT_GE(recoveries.size(), 1u);
  const Vector3 axis =
      problem_.part(mating.fixed).X_WorldPart.linear() * mating.mating_vector.normalized();
  ExpectAttempts(trace, plan_.recoveries[3], axis);
  const auto checks = trace.All<VerificationRecord>();
  EXPECT_EQ(checks[1]->error, "error4");
  EXPECT_EQ(checks.back()->error, "");
  const std::vector<TrueAndBelieved>& parts = trace.end().snapshot.parts;
  const Pose X_FixedHeld =
      parts[mating.fixed.index()].truth.inverse() * parts[mating.held.index()].truth;
  EXPECT_LT((X_FixedHeld.translation() - mating.X_FixedHeld.translation()).norm(), 0.002);
  const Vector3 moved = parts[mating.fixed.index()].believed.translation() -
                        problem_.part(mating.fixed).X_WorldPart.translation();
  EXPECT_LT((moved - recoveries.back()->offset).norm(), 1e-9) << "the belief follows";
}

}  // namespace
}  // namespace assay::execution::recovery_test
