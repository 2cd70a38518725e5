#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <numbers>

#include "planner/geometry/pose.h"
#include "sim/execution/walk/executor.h"
#include "sim/execution/walk/step_execution.h"
#include "tests/sim/execution/channel.h"
#include "tests/sim/execution/figure15.h"

// Each channel of the noise alone moves one quantity by what was drawn, and nothing else.
namespace assay::execution::noise_channels_test {
namespace {

using noise::Effect;
using noise::Noise;

constexpr double kMillimetre = 0.001;
constexpr double kFollows = 1e-4;   // metres, within which the arm follows its commands
constexpr plan::StepId kPickup(1);  // in the plan of two actions

class Channels : public Figure15Test {
 protected:
  static PartId block() { return PartNamed(problem(), "block"); }
  static const mujoco::Data& StartWithout() {
    static const mujoco::Data data = StartOf(problem(), scene(), {});
    return data;
  }
};

// A simulation that starts with one error of the peg. The struct also stores by how much this error
// changes the peg's pose.
struct ErroneousStart {
  mujoco::Data data;
  Vector3 displacement;
  geometry::Matrix3 turn;
};

class StartChannels : public Channels {
 protected:
  static ErroneousStart Start(Effect effect, double value) {
    mujoco::Data data = StartOf(problem(), scene(), Only(effect, value, peg()));
    const Pose before = scene().TruePose(StartWithout(), peg());
    const Pose after = scene().TruePose(data, peg());
    EXPECT_EQ(scene().TruePose(data, block()).matrix(),
              scene().TruePose(StartWithout(), block()).matrix());
    EXPECT_EQ(scene().TableHeight(data, block()), 0);
    return {std::move(data), after.translation() - before.translation(),
            after.linear() * before.linear().transpose()};
  }
};

TEST_F(StartChannels, PlacesAlongTheWorldsAxes) {
  for (const auto& [effect, axis] : {std::pair(Effect::kPartX, 0), std::pair(Effect::kPartY, 1)}) {
    const ErroneousStart start = Start(effect, 2 * kMillimetre);
    EXPECT_LT((start.displacement - 2 * kMillimetre * Vector3::Unit(axis)).norm(), 1e-12);
    EXPECT_TRUE(start.turn.isIdentity(1e-12));
  }
}

// The yaw error turns the part about the world's vertical through the part's own origin.
TEST_F(StartChannels, YawAboutTheOrigin) {
  const ErroneousStart start = Start(Effect::kPartYaw, 0.05);
  EXPECT_LT(start.displacement.norm(), 1e-12);
  EXPECT_TRUE(start.turn.isApprox(geometry::RotationZ(0.05).linear(), 1e-12));
}

// The table under the part is higher, and the part rests on it.
TEST_F(StartChannels, HeightOfTheTable) {
  ErroneousStart start = Start(Effect::kTableHeight, 2 * kMillimetre);
  EXPECT_NEAR(scene().TableHeight(start.data, peg()), 2 * kMillimetre, 1e-15);
  EXPECT_LT((start.displacement - Vector3(0, 0, 2 * kMillimetre)).norm(), 1e-12);
  EXPECT_TRUE(start.turn.isIdentity(1e-12));
  const Pose before = scene().TruePose(start.data, peg());
  while (start.data.time() < 0.3) start.data.Step();
  const Pose after = scene().TruePose(start.data, peg());
  EXPECT_LT((after.translation() - before.translation()).norm(), 5e-6) << "neither falls nor leaps";
}

// Without errors, parts are at the places and yaws of the problem, at rest in the engine.
TEST_F(StartChannels, PartsRestAtTheStart) {
  const std::vector<Pose> resting = RestingPoses(problem(), scene());
  mujoco::Data data = StartOf(problem(), scene(), {});
  while (data.time() < 0.3) data.Step();
  for (std::size_t p = 0; p < resting.size(); ++p) {
    const Pose& said = problem().parts[p].X_WorldPart;
    EXPECT_EQ(resting[p].translation().head<2>(), said.translation().head<2>());
    EXPECT_NEAR(resting[p].translation().z(), said.translation().z(), 1e-4);
    EXPECT_LT(geometry::AngleBetween(resting[p].linear(), said.linear()), 2e-3);
    const geometry::Matrix3 turn = resting[p].linear() * said.linear().transpose();
    EXPECT_NEAR(turn(1, 0), turn(0, 1), 1e-12) << "the yaw that the problem says";
    const Pose after = scene().TruePose(data, PartId(p));
    EXPECT_LT((after.translation() - resting[p].translation()).norm(), 5e-6);
    EXPECT_LT(geometry::AngleBetween(after.linear(), resting[p].linear()), 1e-4);
  }
}

// The tool is poised for the pickup once for all tests. From there the hand takes up its errors and
// acts.
class HandChannels : public Channels {
 protected:
  HandChannels() : data_(scene().model()), execution_(problem(), scene(), data_, options_) {
    execution_.Restore(Poised());
  }

  static const Checkpoint& Poised() {
    static const Checkpoint poised = [] {
      const ExecutorOptions options{.sample_rate = 0};
      mujoco::Data data = StartOf(problem(), scene(), {});
      Execution execution(problem(), scene(), data, options);
      StepExecution step(plan(), kPickup, execution);
      EXPECT_FALSE(step.Approach());
      return execution.Save();
    }();
    return poised;
  }
  // Returns the pose of the tool at a milestone of the pickup.
  TrueAndBelieved ToolAt(Stage stage) {
    for (const Milestone* milestone : execution_.trace().All<Milestone>()) {
      if (milestone->stage == stage) return milestone->snapshot.tool;
    }
    ADD_FAILURE() << "no milestone " << Name(stage);
    return {};
  }
  // Expects the true hand to be displaced by T_dM in the frame of the commanded hand.
  void ExpectHandError(const Pose& error) {
    StepExecution step(plan(), kPickup, execution_);
    ASSERT_FALSE(step.TakeUpNoise());
    ASSERT_FALSE(step.Work());
    const auto& pickup = plan().step(kPickup).action;
    const Pose told = pickup.place.X_WorldPart * pickup.hold.X_PartTool;
    for (const Stage stage : {Stage::kPoised, Stage::kReached}) {
      const TrueAndBelieved tool = ToolAt(stage);
      const Pose off = tool.believed.inverse() * tool.truth;
      EXPECT_LT((off.translation() - error.translation()).norm(), kFollows) << Name(stage);
      EXPECT_LT(geometry::AngleBetween(off.linear(), error.linear()), 2e-4) << Name(stage);
    }
    EXPECT_TRUE(ToolAt(Stage::kReached).believed.isApprox(told, 1e-9)) << "it knows of no error";
  }

  ExecutorOptions options_{.sample_rate = 0};
  mujoco::Data data_;
  Execution execution_;
};

TEST_F(HandChannels, None) { ExpectHandError(Pose::Identity()); }

TEST_F(HandChannels, AlongX) {
  options_.noise = Only(Effect::kHandX, 2 * kMillimetre, PartId::None(), kPickup);
  ExpectHandError(geometry::Translation(2 * kMillimetre, 0, 0));
}

TEST_F(HandChannels, AlongY) {
  options_.noise = Only(Effect::kHandY, 2 * kMillimetre, PartId::None(), kPickup);
  ExpectHandError(geometry::Translation(0, 2 * kMillimetre, 0));
}

TEST_F(HandChannels, AlongZ) {
  options_.noise = Only(Effect::kHandZ, 2 * kMillimetre, PartId::None(), kPickup);
  ExpectHandError(geometry::Translation(0, 0, 2 * kMillimetre));
}

TEST_F(HandChannels, AboutZ) {
  options_.noise = Only(Effect::kHandYaw, 0.03, PartId::None(), kPickup);
  ExpectHandError(geometry::RotationZ(0.03));
}

TEST_F(HandChannels, OfAnotherStepAreNotFelt) {
  options_.noise = Only(Effect::kHandX, 2 * kMillimetre, PartId::None(), plan::StepId(0));
  ExpectHandError(Pose::Identity());
}

// If an execution has noise from its start, the hand has the same error as if the noise is taken up
// when the tool is poised.
TEST_F(Channels, AnExecutionErrsAsItsNoiseSays) {
  const Noise noise = FourErrors(Effect::kHandX, kPickup, {0.001, -0.002, 0.0015, 0.02});
  mujoco::Data data = StartOf(problem(), scene(), noise);
  const Trace trace = Execute(problem(), plan(), scene(), data,
                              {.sample_rate = 0, .noise = noise, .last = kPickup});
  ASSERT_EQ(trace.end().outcome, TrialOutcome::kSucceeded) << trace.end().reason;
  const Pose error = noise.HandError(kPickup);
  const auto milestones = trace.All<Milestone>();
  ASSERT_EQ(milestones.size(), 3u);
  for (const Milestone* milestone : {milestones[0], milestones[1]}) {
    const TrueAndBelieved& tool = milestone->snapshot.tool;
    const Pose off = tool.believed.inverse() * tool.truth;
    EXPECT_LT((off.translation() - error.translation()).norm(), kFollows);
    EXPECT_LT(geometry::AngleBetween(off.linear(), error.linear()), 2e-4);
  }
  EXPECT_TRUE(trace.All<GraspFact>().at(0)->holds());
}

// Returns how far the peg can be moved to each side in the hole before it touches the block, in
// metres. The shaft is 5 mm out of its seat. Only poses are tested for contact, and nothing is
// simulated.
double PlayOf(const domain::Problem& problem, const Noise& noise) {
  const scene::Scene scene(problem, TrueScene({}, noise));
  const domain::Mating& mating = problem.mating(domain::MatingId(0));
  mujoco::Data data = scene.Start();
  const Pose X_WorldFixed = scene.TruePose(data, mating.fixed);
  const Pose loose =
      geometry::Translation(-0.005 * mating.mating_vector.normalized()) * mating.X_FixedHeld;
  const auto touches = [&](double shift) {
    scene.SetPart(data, mating.held, X_WorldFixed * geometry::Translation(0, shift, 0) * loose);
    data.Forward();
    return scene.Touching(data, mating.held, scene.Body(mating.fixed));
  };
  double free = 0;
  double touching = 0.002;
  EXPECT_FALSE(touches(free));
  EXPECT_TRUE(touches(touching));
  while (touching - free > 1e-7) {
    const double middle = (free + touching) / 2;
    (touches(middle) ? touching : free) = middle;
  }
  return free;
}

TEST_F(Channels, ClearanceOfTheHole) {
  EXPECT_NEAR(PlayOf(problem(), {}), problem().clearance, 2e-6);
  for (const double error : {-1e-4, 2e-4}) {
    EXPECT_NEAR(PlayOf(problem(), Only(Effect::kClearance, error)), problem().clearance + error,
                2e-6);
  }
}

// Returns the sliding frictions of a body's geoms in the model.
std::vector<double> Frictions(const scene::Scene& scene, mujoco::BodyId body) {
  const mujoco::Data data = scene.Start();
  std::vector<double> frictions;
  for (int g = 0; g < data.own_model()->ngeom; ++g) {
    if (data.own_model()->geom_bodyid[g] != body.index()) continue;
    frictions.push_back(data.own_model()->geom_friction[3 * g]);
  }
  return frictions;
}

TEST_F(Channels, FrictionOfParts) {
  const scene::Scene rough(problem(), TrueScene({}, Only(Effect::kFriction, 0.05)));
  for (const PartId part : {peg(), block()}) {
    for (const double friction : Frictions(rough, rough.Body(part))) {
      EXPECT_NEAR(friction, problem().part(part).model->friction() + 0.05, 1e-12);
    }
  }
  EXPECT_EQ(Frictions(rough, rough.left_finger()), Frictions(scene(), scene().left_finger()));
}

TEST_F(Channels, FrictionOfPads) {
  const scene::Scene rough(problem(), TrueScene({}, Only(Effect::kPadFriction, -0.05)));
  for (const auto& [finger, before] : {std::pair(rough.left_finger(), scene().left_finger()),
                                       std::pair(rough.right_finger(), scene().right_finger())}) {
    std::vector<double> said = Frictions(scene(), before);
    std::vector<double> truth = Frictions(rough, finger);
    ASSERT_EQ(said.size(), truth.size());
    double changed = 0;
    for (std::size_t g = 0; g < said.size(); ++g) changed += truth[g] - said[g];
    EXPECT_NEAR(changed, 4 * -0.05, 1e-12) << "the four tiles of each finger's pad";
  }
  EXPECT_EQ(Frictions(rough, rough.Body(peg())), Frictions(scene(), scene().Body(peg())));
}

}  // namespace
}  // namespace assay::execution::noise_channels_test
