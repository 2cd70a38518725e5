#include "sim/execution/walk/executor.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "planner/geometry/pose.h"
#include "sim/execution/commands/action_commands.h"
#include "tests/sim/execution/figure15.h"
#include "tests/sim/execution/trace/trace_schema.h"

namespace assay::execution::executor_test {
namespace {

using testing::HasSubstr;

std::string Text(const Trace& trace) {
  std::ostringstream out;
  WriteTrace(trace, out);
  return out.str();
}

// The plan of Spar's figure 15, executed without noise, once for all tests.
class Figure15Executed : public Figure15Test {
 protected:
  static Trace Run(const ExecutorOptions& options = {}) {
    mujoco::Data data = scene().Start();
    return Execute(problem(), plan(), scene(), data, options);
  }
  static const Trace& trace() {
    static const Trace trace = Run();
    return trace;
  }

  // Returns the samples from the closing of the gripper until the end of the step that opens it.
  static std::vector<const Sample*> SamplesInHand() {
    const double closed = trace().All<GraspFact>().front()->time;
    std::vector<const Sample*> samples;
    for (const Sample* sample : trace().All<Sample>()) {
      const bool closed_on_it =
          sample->snapshot.opening < HoldForMating(problem(), domain::MatingId(0)).width + 1e-4;
      if (sample->snapshot.time > closed && closed_on_it) samples.push_back(sample);
    }
    return samples;
  }
};

Vector3 Error(const TrueAndBelieved& pose) {
  return pose.truth.translation() - pose.believed.translation();
}

TEST_F(Figure15Executed, Assembles) {
  const ExecutionEnd& end = trace().end();
  ASSERT_EQ(end.outcome, TrialOutcome::kSucceeded) << end.reason;
  const domain::Mating& mating = problem().mating(domain::MatingId(0));
  const Pose X_FixedHeld = end.snapshot.parts[mating.fixed.index()].truth.inverse() *
                           end.snapshot.parts[mating.held.index()].truth;
  EXPECT_LT((X_FixedHeld.translation() - mating.X_FixedHeld.translation()).norm(), 2e-4);
  EXPECT_LT(geometry::AngleBetween(X_FixedHeld.linear(), mating.X_FixedHeld.linear()), 2e-3);
}

TEST_F(Figure15Executed, PickupLiftsThePegAndKeepsIt) {
  const auto facts = trace().All<GraspFact>();
  ASSERT_EQ(facts.size(), 1u);
  EXPECT_TRUE(facts[0]->holds());
  EXPECT_NEAR(facts[0]->opening, facts[0]->expected_width, 5e-5);
  const Snapshot& lifted = trace().All<StepEnd>()[0]->snapshot;
  EXPECT_GT(lifted.parts[peg().index()].truth.translation().z(), 0.2);
  EXPECT_THAT(lifted.contacts, testing::Contains(std::pair<std::string, std::string>(
                                   "gripper/finger_left", "part/peg")));
}

// The held part stays where the world model has it. Its slip is bounded over the whole way.
TEST_F(Figure15Executed, HeldPegSlipsLessThanAFifthOfAMillimetre) {
  const auto samples = SamplesInHand();
  ASSERT_GT(samples.size(), 200u);
  for (const Sample* sample : samples) {
    const TrueAndBelieved& part = sample->snapshot.parts[peg().index()];
    const TrueAndBelieved& tool = sample->snapshot.tool;
    const Pose X_ToolPart = tool.truth.inverse() * part.truth;
    const Pose X_ToolPartBelieved = tool.believed.inverse() * part.believed;
    ASSERT_LT((X_ToolPart.translation() - X_ToolPartBelieved.translation()).norm(), 2e-4)
        << "at " << sample->snapshot.time << " s";
  }
}

// The believed pose of the tool is the commanded one. The arm follows the commanded pose on
// straight lines and between them.
TEST_F(Figure15Executed, TheToolFollowsItsCommands) {
  for (const Sample* sample : trace().All<Sample>()) {
    ASSERT_LT(Error(sample->snapshot.tool).norm(), 2e-4) << "at " << sample->snapshot.time << " s";
  }
}

// The true positions of the tool lie on a straight line between the ends of the mating motion.
TEST_F(Figure15Executed, TheMatingMotionIsStraight) {
  const StepCommands commands =
      CommandsFor(problem(), WorldModel(problem()), plan().steps[0].action);
  const Vector3 a = std::get<MoveStraight>(commands.approach[1]).X_WorldTool.translation();
  const Vector3 b = std::get<MoveStraight>(commands.advance[0]).X_WorldTool.translation();
  const Vector3 along = (b - a).normalized();
  int seen = 0;
  for (const Sample* sample : SamplesInHand()) {
    const Vector3 p = sample->snapshot.tool.believed.translation();
    const Vector3 off = (p - a) - along * along.dot(p - a);
    const double gone = along.dot(p - a);
    if (off.norm() > 1e-5 || gone < 0.01 || gone > (b - a).norm()) continue;
    ++seen;
    const Vector3 q = sample->snapshot.tool.truth.translation();
    ASSERT_LT(((q - a) - along * along.dot(q - a)).norm(), 2e-4);
  }
  EXPECT_GT(seen, 100);
}

TEST_F(Figure15Executed, PartsAreAtRestAfterwards) {
  const auto rest = trace().All<RestRecord>();
  ASSERT_EQ(rest.size(), 1u);
  for (const auto& speeds : rest[0]->parts) {
    EXPECT_LT(speeds.linear, 1e-5);
    EXPECT_LT(speeds.angular, 1e-4);
  }
}

TEST_F(Figure15Executed, SamplesComeAtTheirRate) {
  const auto samples = trace().All<Sample>();
  for (std::size_t i = 0; i < samples.size(); ++i) {
    ASSERT_NEAR(samples[i]->snapshot.time, static_cast<double>(i) / 50, 0.0025);
  }
}

// Records what it observes, and checks that each event is observed when it happens.
class Chronicler : public Observer {
 public:
  void SeeStart(const mujoco::Data& data) override {
    EXPECT_EQ(data.time(), 0);
    EXPECT_EQ(timesteps, 0);
    ++starts;
  }
  void SeeTimestep(const mujoco::Data& data) override {
    EXPECT_GT(data.time(), last_time);
    last_time = data.time();
    ++timesteps;
  }
  void SeeMilestone(const Milestone& milestone, const mujoco::Data& data) override {
    EXPECT_EQ(milestone.snapshot.time, data.time());
    seen.push_back(fmt::format("{} {}", milestone.step.index(), Name(milestone.stage)));
  }
  void SeeStepEnd(const StepEnd& end, const mujoco::Data& data) override {
    EXPECT_EQ(end.snapshot.time, data.time());
    seen.push_back(end.name);
  }

  int starts = 0;
  double last_time = 0;
  std::int64_t timesteps = 0;
  std::vector<std::string> seen;
};

// The observer sees all events in the order of the trace, and changes nothing.
TEST_F(Figure15Executed, AnObserverSeesWhatTheTraceHas) {
  Chronicler chronicler;
  const Trace observed = Run({.observer = &chronicler});
  EXPECT_EQ(Text(observed), Text(trace()));
  EXPECT_EQ(chronicler.starts, 1);
  EXPECT_EQ(chronicler.timesteps, trace().end().steps);
  std::vector<std::string> traced;
  for (const TraceEvent& event : trace().events) {
    if (const auto* milestone = std::get_if<Milestone>(&event)) {
      traced.push_back(fmt::format("{} {}", milestone->step.index(), Name(milestone->stage)));
    }
    if (const auto* end = std::get_if<StepEnd>(&event)) traced.push_back(end->name);
  }
  EXPECT_EQ(chronicler.seen, traced);
}

TEST_F(Figure15Executed, WritesWhatItsSchemaSays) {
  EXPECT_THAT(SchemaErrors(trace()), testing::IsEmpty());
}

// Each step has the milestones poised, reached and acted. Each way down is a guarded move. Only the
// last one meets resistance, at the bottom of the hole.
TEST_F(Figure15Executed, MilestonesMarkTheWay) {
  std::string stages;
  for (const Milestone* milestone : trace().All<Milestone>()) {
    stages += fmt::format("{} {}, ", plan().step(milestone->step).name, Name(milestone->stage));
  }
  EXPECT_EQ(stages,
            "action_2 poised, action_2 reached, action_2 acted, "
            "action_1 poised, action_1 reached, action_1 acted, ");
  const auto guards = trace().All<GuardRecord>();
  ASSERT_EQ(guards.size(), 2u);
  EXPECT_FALSE(guards[0]->resisted);
  EXPECT_TRUE(guards[1]->resisted);
}

// The part is not where it is believed to be, and the gripper closes on nothing. The trace records
// that and the execution goes on. Later the open fingers touch the block at the hole.
TEST_F(Figure15Executed, AMissedPartIsAFactInTheTrace) {
  mujoco::Data data = scene().Start();
  const Pose away = geometry::Translation(0, -0.15, 0) * problem().part(peg()).X_WorldPart;
  scene().SetPart(data, peg(), away);
  const Trace missed = Execute(problem(), plan(), scene(), data, {});
  const auto facts = missed.All<GraspFact>();
  ASSERT_EQ(facts.size(), 1u);
  EXPECT_FALSE(facts[0]->holds());
  EXPECT_FALSE(facts[0]->pads_touch);
  EXPECT_LT(facts[0]->opening, 0.001);
  EXPECT_EQ(missed.end().outcome, TrialOutcome::kSucceeded);
  const std::pair<std::string, std::string> in_the_hole("gripper/finger_left", "part/block");
  EXPECT_TRUE(std::ranges::any_of(missed.All<Sample>(), [&](const Sample* sample) {
    return std::ranges::count(sample->snapshot.contacts, in_the_hole) > 0;
  }));
}

TEST_F(Figure15Executed, SaysWhereTheArmCannotGo) {
  domain::Problem far = problem();
  far.parts[peg().index()].X_WorldPart.translation().x() = 3;
  mujoco::Data data = scene().Start();
  const Trace trace = Execute(far, plan(), scene(), data, {});
  EXPECT_EQ(trace.end().outcome, TrialOutcome::kUnreachable);
  EXPECT_THAT(trace.end().reason, HasSubstr("action_2: no configuration of the arm reaches (3"));
}

// The execution stops when the force at the wrist exceeds the limit. A limit of 1 N is exceeded
// even without errors.
TEST_F(Figure15Executed, StopsWhenTheWristFeelsTooMuch) {
  mujoco::Data data = scene().Start();
  const Trace trace = Execute(problem(), plan(), scene(), data, {.force_limit = 1});
  EXPECT_EQ(trace.end().outcome, TrialOutcome::kOverload);
  EXPECT_THAT(trace.end().reason, HasSubstr("the wrist felt"));
}

TEST_F(Figure15Executed, WorksWithAWeldToo) {
  const scene::Scene welded(problem(), {.grasp = scene::GraspMode::kWeld});
  mujoco::Data data = welded.Start();
  const Trace trace = Execute(problem(), plan(), welded, data, {});
  ASSERT_EQ(trace.end().outcome, TrialOutcome::kSucceeded) << trace.end().reason;
  EXPECT_LT(Error(trace.end().snapshot.parts[peg().index()]).norm(), 2e-4);
}

}  // namespace
}  // namespace assay::execution::executor_test
