#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "sim/execution/walk/executor.h"
#include "sim/execution/walk/step_execution.h"
#include "tests/planner/plan/actions.h"
#include "tests/sim/execution/channel.h"
#include "tests/sim/execution/figure15.h"

namespace assay::execution::guarded_move_test {
namespace {

using noise::Effect;
using noise::Noise;

constexpr plan::StepId kPutdown(0);
constexpr plan::StepId kPickup(1);

// Returns a plan in which the peg is picked up and put down where it lay.
plan::Plan UpAndDown(const domain::Problem& problem) {
  plan::Plan plan = TwoActions(problem);
  const auto& pickup = plan.step(kPickup).action;
  plan.steps[kPutdown.index()].action = plan::Putdown(pickup.part, pickup.hold, pickup.place);
  return plan;
}

// The result of a putdown that starts with the peg in the hand.
struct Landing {
  Trace trace;  // of the putdown alone, with a sample at every timestep
  mujoco::Data data;

  const GuardRecord& guard() const { return *trace.All<GuardRecord>().at(0); }
};

class GuardedMove : public Figure15Test {
 protected:
  static const plan::Plan& plan() {
    static const plan::Plan plan = UpAndDown(problem());
    return plan;
  }

  // Returns the checkpoint at the end of the pickup. It is made once for all tests.
  static const Checkpoint& PegInHand() {
    static const Checkpoint checkpoint = [] {
      const ExecutorOptions options{.sample_rate = 0};
      mujoco::Data data = StartOf(problem(), scene(), {});
      Execution execution(problem(), scene(), data, options);
      StepExecution pickup(plan(), kPickup, execution);
      EXPECT_FALSE(pickup.Approach());
      EXPECT_FALSE(pickup.Work());
      return execution.Save();
    }();
    return checkpoint;
  }
  // Puts the peg down on a table that is `height` metres higher than believed.
  static Landing PutDown(double height) {
    const ExecutorOptions options{.sample_rate = 1e6,
                                  .noise = Only(Effect::kTableHeight, height, peg(), kPutdown)};
    Landing landing{{}, mujoco::Data(scene().model())};
    Execution execution(problem(), scene(), landing.data, options);
    execution.Restore(PegInHand());
    StepExecution putdown(plan(), kPutdown, execution);
    EXPECT_FALSE(putdown.Approach());
    EXPECT_FALSE(putdown.Work());
    landing.trace = std::move(execution.trace());
    return landing;
  }
  static const Landing& Onto(double height) {
    static std::map<double, Landing> landings;
    if (!landings.contains(height)) landings.emplace(height, PutDown(height));
    return landings.at(height);
  }
  // Returns the height of the tool at which the part would rest on a table at height 0.
  static double ExpectedHeight() {
    const auto& putdown = plan().step(kPutdown).action;
    return (putdown.place.X_WorldPart * putdown.hold.X_PartTool).translation().z();
  }
  static double RestingHeight() {
    return RestingPoses(problem(), scene()).at(peg().index()).translation().z();
  }
};

class Heights : public GuardedMove, public testing::WithParamInterface<double> {};
INSTANTIATE_TEST_SUITE_P(OfTheTable, Heights, testing::Values(-0.002, 0.0, 0.002));

TEST_P(Heights, TheMoveEndsAtTheTable) {
  const Landing& landing = Onto(GetParam());
  ASSERT_EQ(landing.trace.All<GuardRecord>().size(), 1u);
  EXPECT_TRUE(landing.guard().resisted);
  EXPECT_NEAR(landing.guard().tool.translation().z(), ExpectedHeight() + GetParam(), 1e-4);
}

TEST_P(Heights, ThePartRestsThere) {
  const Landing& landing = Onto(GetParam());
  const Snapshot& end = landing.trace.All<StepEnd>().at(0)->snapshot;
  EXPECT_NEAR(end.table_heights[peg().index()], GetParam(), 1e-15);
  EXPECT_EQ(end.table_heights[1 - peg().index()], 0) << "the other part's stays";
  EXPECT_NEAR(end.parts[peg().index()].truth.translation().z(), RestingHeight() + GetParam(), 2e-5);
  EXPECT_LT(scene().TrueTwist(landing.data, peg()).linear.norm(), 1e-4);
  EXPECT_EQ(end.contacts, (std::vector<std::pair<std::string, std::string>>{{"part/block", "world"},
                                                                            {"part/peg", "world"}}))
      << "let go";
}

// The believed pose after the putdown is the planned one, whatever the table's height.
TEST_P(Heights, ThePartIsBelievedToBeWhereItWasToGo) {
  const Snapshot& end = Onto(GetParam()).trace.All<StepEnd>().at(0)->snapshot;
  const auto& putdown = plan().step(kPutdown).action;
  EXPECT_EQ(end.parts[peg().index()].believed.matrix(), putdown.place.X_WorldPart.matrix());
}

// The force at the wrist is bounded at every timestep while the part is in the hand.
TEST_P(Heights, NothingIsPressedHard) {
  const Landing& landing = Onto(GetParam());
  double greatest = 0;
  for (const Sample* sample : landing.trace.All<Sample>()) {
    if (sample->snapshot.time > landing.guard().time + 0.15) break;
    greatest = std::max(greatest, sample->snapshot.wrist.force.norm());
  }
  EXPECT_GT(greatest, kResistance);
  EXPECT_LT(greatest, 60);
}

// The move goes on by the guarded travel and no farther. Then the part is let go.
TEST_F(GuardedMove, EndsWithoutResistanceWhereThereIsNothing) {
  const Landing& landing = Onto(-0.02);
  EXPECT_FALSE(landing.guard().resisted);
  const double travel = problem().workcell->rules().guarded_travel;
  EXPECT_NEAR(landing.guard().tool.translation().z(), ExpectedHeight() - travel, 1e-6);
  const Snapshot& end = landing.trace.All<StepEnd>().at(0)->snapshot;
  EXPECT_LT(end.parts[peg().index()].truth.translation().z(), RestingHeight() - travel);
}

}  // namespace
}  // namespace assay::execution::guarded_move_test
