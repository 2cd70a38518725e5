#include <gtest/gtest.h>

#include <sstream>
#include <thread>

#include "sim/execution/walk/executor.h"
#include "sim/execution/walk/step_execution.h"
#include "sim/noise/sampling.h"
#include "tests/sim/execution/figure15.h"

namespace assay::execution::checkpoint_test {
namespace {

constexpr plan::StepId kAssemble(0);
constexpr plan::StepId kPickup(1);

std::string Text(const Trace& trace) {
  std::ostringstream out;
  WriteTrace(trace, out);
  return out.str();
}

// The plan of Spar's figure 15, under noise that is small enough for it to succeed.
class Checkpoints : public Figure15Test {
 protected:
  static const domain::Problem& problem() {
    static const domain::Problem problem = [] {
      domain::Problem with_small_errors = Figure15();
      for (domain::Part& part : with_small_errors.parts) {
        for (Interval* range : {&part.error.x, &part.error.y, &part.error.z, &part.error.theta}) {
          *range = {-3e-4, 3e-4};
        }
      }
      return with_small_errors;
    }();
    return problem;
  }
  static const noise::Noise& Drawn() {
    static const noise::Noise drawn =
        noise::Sample(problem(), noise::ErrorBox(problem(), plan()), noise::Mode::kUniform, 5, 1);
    return drawn;
  }
  static const ExecutorOptions& Options() {
    static const ExecutorOptions options{.noise = Drawn()};
    return options;
  }

  // An execution of the plan step by step. It is saved after each step and where the second step is
  // poised.
  struct Uninterrupted {
    std::vector<Checkpoint> saved;
    std::vector<std::size_t> events;  // number of events in the trace at each save
    Trace trace;
  };
  static const Uninterrupted& WithoutInterruption() {
    static const Uninterrupted whole = [] {
      Uninterrupted result;
      mujoco::Data data = StartOf(problem(), scene(), Drawn());
      Execution execution(problem(), scene(), data, Options());
      const auto save = [&] {
        result.saved.push_back(execution.Save());
        result.events.push_back(execution.trace().events.size());
      };
      execution.trace().events.emplace_back(ExecutionStart{execution.Now()});
      StepExecution pickup(plan(), kPickup, execution);
      EXPECT_FALSE(pickup.Approach());
      EXPECT_FALSE(pickup.Work());
      save();
      StepExecution assemble(plan(), kAssemble, execution);
      EXPECT_FALSE(assemble.Approach());
      save();
      EXPECT_FALSE(assemble.Work());
      save();
      result.trace = std::move(execution.trace());
      return result;
    }();
    return whole;
  }
  // Returns the lines of the uninterrupted trace after a checkpoint.
  static std::string After(std::size_t checkpoint) {
    Trace rest = WithoutInterruption().trace;
    const auto from = static_cast<std::ptrdiff_t>(WithoutInterruption().events[checkpoint]);
    rest.events.erase(rest.events.begin(), rest.events.begin() + from);
    return Text(rest);
  }
  static void ExpectTheEnd(Execution& execution) {
    const Checkpoint& end = WithoutInterruption().saved.back();
    EXPECT_TRUE(execution.Save().state == end.state);
    EXPECT_EQ(execution.commanded(), end.commanded.q);
  }
};

TEST_F(Checkpoints, AnExecutionGoesOnToTheBit) {
  mujoco::Data data(scene().model());
  Execution execution(problem(), scene(), data, Options());
  execution.Restore(WithoutInterruption().saved[0]);
  StepExecution assemble(plan(), kAssemble, execution);
  ASSERT_FALSE(assemble.Approach());
  ASSERT_FALSE(assemble.Work());
  EXPECT_EQ(Text(execution.trace()), After(0));
  ExpectTheEnd(execution);
}

// The checkpoint is in the middle of a step. The simulation has been elsewhere before it is
// restored.
TEST_F(Checkpoints, ItMatterNotWhatWasDoneInTheMeantime) {
  const Uninterrupted& whole = WithoutInterruption();
  mujoco::Data data(scene().model());
  Execution execution(problem(), scene(), data, Options());
  execution.Restore(whole.saved[2]);
  ASSERT_FALSE(execution.Stay(0.1));
  execution.Restore(whole.saved[1]);
  execution.trace().events.clear();
  StepExecution assemble(plan(), kAssemble, execution);
  ASSERT_FALSE(assemble.Work());
  EXPECT_EQ(Text(execution.trace()), After(1));
  ExpectTheEnd(execution);
}

TEST_F(Checkpoints, HoldBeliefAndHandError) {
  mujoco::Data data(scene().model());
  Execution execution(problem(), scene(), data, Options());
  execution.Restore(WithoutInterruption().saved[0]);
  EXPECT_EQ(execution.world().held(), PartNamed(problem(), "peg"));
  const Pose error = Drawn().HandError(kPickup);
  EXPECT_GT((error.translation()).norm(), 1e-6);
  EXPECT_TRUE(execution.Erring(Pose::Identity()).isApprox(error, 1e-15));
}

// An execution under noise does not depend on what runs beside it.
TEST_F(Checkpoints, TwoThreadsGiveTheSameBytesUnderNoise) {
  const auto run = [](std::string& text) {
    mujoco::Data data = StartOf(problem(), scene(), Drawn());
    text = Text(Execute(problem(), plan(), scene(), data, Options()));
  };
  std::string first, second;
  std::thread a([&] { run(first); });
  std::thread b([&] { run(second); });
  a.join();
  b.join();
  EXPECT_EQ(first, second);
  EXPECT_TRUE(first.starts_with(Text(WithoutInterruption().trace))) << "nor on how it is driven";
}

}  // namespace
}  // namespace assay::execution::checkpoint_test
