#include "sim/check/trial_verdicts/ledger.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "sim/execution/walk/executor.h"
#include "sim/execution/walk/step_execution.h"
#include "sim/noise/sampling.h"
#include "tests/sim/check/certified.h"

namespace assay::check::ledger_test {
namespace {

using noise::Effect;
using noise::Noise;

// Tolerances for the accuracy of the engine. The arm follows its command to half a micrometre, or
// to two micrometres with a part in the hand. Parts rest within a fifth of a micrometre.
constexpr double kLength = 3e-6;                           // metres
constexpr double kAngle = 0.001 * std::numbers::pi / 180;  // radians
constexpr double kFriction = 1e-12;
// Tolerance in metres or radians for the errors that the engine and the executor apply.
constexpr double kGiven = 1e-6;

double ToleranceOf(const LedgerEntry& entry) {
  const domain::Dimension dimension = noise::DimensionOf(entry.channel.effect);
  if (dimension == domain::Dimension::kRatio) return kFriction;
  return dimension == domain::Dimension::kLength ? kLength : kAngle;
}

// A scenario with its plan, and an error box that includes the errors of the tolerances.
struct Case {
  Certified certified;
  std::vector<noise::Channel> box;

  Experiment experiment() const { return {certified.problem, certified.plan}; }
  Noise Drawn() const { return noise::Sample(certified.problem, box, noise::Mode::kUniform, 7, 1); }
  Noise None() const { return noise::Sample(certified.problem, box, noise::Mode::kNone, 7, 1); }

  // The execution ends with the first error that is signalled. Groping takes long and changes no
  // entry of the ledger.
  execution::Trace TraceOf(const Noise& noise, plan::StepId last = plan::StepId::None()) const {
    const domain::Problem& problem = certified.problem;
    const scene::Scene scene(problem, execution::TrueScene({}, noise));
    mujoco::Data data = execution::StartOf(problem, scene, noise);
    return execution::Execute(problem, certified.plan, scene, data,
                              {.sample_rate = 0, .noise = noise, .recovers = false, .last = last});
  }
  std::vector<LedgerEntry> Ledger(const Noise& noise, const execution::Trace& trace) const {
    return LedgerOf(experiment(), noise, trace);
  }
};

// Returns the problem with a sensor whose measurements are used. A sensor's height is not used
// where the height is known better already. In that case the sensor is one that measures no
// heights.
domain::Problem WithSensorsThatAreBelieved(domain::Problem problem) {
  // Metres. The error bound that the camera promises for heights is not greater than this.
  constexpr double kPromised = 1e-4;
  const auto is_known_better = [](const domain::Part& part) {
    return part.error.z.high < kPromised;
  };
  if (!problem.sensors.empty() && std::ranges::all_of(problem.parts, is_known_better)) {
    problem.sensors = {"coarse-camera"};
  }
  return problem;
}

const Case& Of(const std::string& scenario) {
  static std::map<std::string, Case> cases;
  const auto [at, is_new] = cases.try_emplace(scenario);
  if (is_new) {
    Case& made = at->second;
    made.certified = CertifiedPlan(WithSensorsThatAreBelieved(ScenarioNamed(scenario)));
    domain::Problem& problem = made.certified.problem;
    problem.tolerances = {
        .clearance = 0.4 * problem.clearance, .friction = 0.05, .pad_friction = 0.05};
    made.box = noise::ErrorBox(problem, made.certified.plan);
  }
  return at->second;
}

void ExpectAsDrawn(const LedgerEntry& entry) {
  ASSERT_TRUE(entry.applied && entry.measured) << entry.channel.name;
  EXPECT_NEAR(*entry.applied, entry.drawn, kGiven) << entry.channel.name;
  EXPECT_NEAR(*entry.measured, entry.drawn, ToleranceOf(entry)) << entry.channel.name;
}

// All errors at once, each with a value of its own, so that none can stand for another.
class WholeTrial : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Scenarios, WholeTrial, testing::Values("uncertain-sensing", "spar-fig15"));

TEST_P(WholeTrial, WhatWasDrawnIsWhatIsMeasured) {
  const Case& of = Of(GetParam());
  const Noise drawn = of.Drawn();
  const auto ledger = of.Ledger(drawn, of.TraceOf(drawn));
  ASSERT_EQ(ledger.size(), of.box.size());
  for (std::size_t i = 0; i < ledger.size(); ++i) {
    EXPECT_EQ(ledger[i].channel, of.box[i]);
    EXPECT_EQ(ledger[i].drawn, drawn.values()[i]);
    EXPECT_NE(ledger[i].drawn, 0);
    ExpectAsDrawn(ledger[i]);
  }
}

// A putdown has its own error of the table's height, apart from that at the pickup. Steps that were
// not reached have no entries applied.
TEST(Ledger, EndsWithTheTrial) {
  const Case& of = Of("spar-fig13");
  const plan::StepId putdown = FirstStep(domain::kPutdown, of.certified.plan);
  const Noise drawn = of.Drawn();
  int heights = 0;
  int unreached = 0;
  for (const LedgerEntry& entry : of.Ledger(drawn, of.TraceOf(drawn, putdown))) {
    const plan::StepId step = entry.channel.step;
    const auto executed = [&](plan::StepId id) { return of.certified.plan.step(id).executed; };
    if (step.IsNone() || executed(step) <= executed(putdown)) {
      ExpectAsDrawn(entry);
      if (step == putdown && entry.channel.effect == Effect::kTableHeight) ++heights;
    } else {
      EXPECT_FALSE(entry.applied || entry.measured) << entry.channel.name;
      ++unreached;
    }
  }
  EXPECT_EQ(heights, 1);
  EXPECT_GT(unreached, 0);
}

TEST(Ledger, NamesAreUnique) {
  for (const char* scenario : {"spar-fig13", "uncertain-sensing"}) {
    std::set<std::string> names;
    for (const noise::Channel& channel : Of(scenario).box) {
      EXPECT_TRUE(names.insert(channel.name).second) << channel.name;
    }
  }
}

class Alone : public testing::Test {
 protected:
  Noise Only(std::size_t channel) const {
    Noise only = of_.None();
    only.Set(channel, of_.box[channel].range.high);
    return only;
  }
  // Expects that this error changes only its own entry of the ledger. Entries without a measured
  // value, which belong to steps that were not reached, are ignored.
  void ExpectAlone(std::size_t channel, const std::vector<LedgerEntry>& ledger) const {
    ExpectAsDrawn(ledger[channel]);
    EXPECT_GT(std::abs(*ledger[channel].measured), ToleranceOf(ledger[channel]));
    for (std::size_t i = 0; i < ledger.size(); ++i) {
      if (i == channel || !ledger[i].measured) continue;
      EXPECT_NEAR(*ledger[i].applied, 0, kGiven) << ledger[channel].channel.name;
      EXPECT_NEAR(*ledger[i].measured, 0, ToleranceOf(ledger[i]))
          << ledger[channel].channel.name << " moves " << ledger[i].channel.name;
    }
  }

  const Case& of_ = Of("uncertain-sensing");
  const plan::Plan& plan_ = of_.certified.plan;
};

TEST_F(Alone, EachErrorOfTheStartAndOfASensor) {
  const plan::StepId look = plan_.ExecutionOrder().front();
  ASSERT_TRUE(plan_.step(look).action.Is(domain::kSense));
  int tried = 0;
  for (std::size_t i = 0; i < of_.box.size(); ++i) {
    if (!of_.box[i].step.IsNone() && of_.box[i].step != look) continue;
    const Noise only = Only(i);
    ExpectAlone(i, of_.Ledger(only, of_.TraceOf(only, look)));
    ++tried;
  }
  EXPECT_EQ(tried, 14);  // four of each part, three tolerances, three of the sensor
}

// The tool is poised for the pickup, and this state is saved once. Each error of the hand is
// applied to the saved state.
TEST_F(Alone, EachErrorOfTheHand) {
  const plan::StepId pickup = FirstStep(domain::kPickup, plan_);
  const domain::Problem& problem = of_.certified.problem;
  const scene::Scene scene(problem, {});
  mujoco::Data data = execution::StartOf(problem, scene, {});
  execution::ExecutorOptions options{.sample_rate = 0};
  execution::Execution poised(problem, scene, data, options);
  ASSERT_FALSE(execution::StepExecution(plan_, pickup, poised).Approach());
  const execution::Checkpoint checkpoint = poised.Save();
  int tried = 0;
  for (std::size_t i = 0; i < of_.box.size(); ++i) {
    if (of_.box[i].step != pickup) continue;
    options.noise = Only(i);
    execution::Execution execution(problem, scene, data, options);
    execution.Restore(checkpoint);
    ASSERT_FALSE(execution::StepExecution(plan_, pickup, execution).TakeUpNoise());
    ExpectAlone(i, of_.Ledger(options.noise, execution.trace()));
    ++tried;
  }
  EXPECT_EQ(tried, 4);
}

// The measured value comes from the trace. With the trace of another trial it differs from the
// drawn value.
TEST_F(Alone, AnErrorThatDoesNothingShows) {
  const execution::Trace without = of_.TraceOf(of_.None(), plan_.ExecutionOrder().front());
  for (const LedgerEntry& entry : of_.Ledger(of_.Drawn(), without)) {
    if (entry.channel.part.IsNone() || !entry.measured) continue;
    EXPECT_GT(std::abs(entry.drawn), ToleranceOf(entry)) << entry.channel.name;
    EXPECT_NEAR(*entry.measured, 0, ToleranceOf(entry)) << entry.channel.name;
  }
}

// The sensor may measure something else than what was drawn. An error of a measurement that is not
// used has no effect.
TEST_F(Alone, WhatASensorTellsIsNotAlwaysBelieved) {
  const plan::StepId look = plan_.ExecutionOrder().front();
  execution::Trace trace = of_.TraceOf(of_.None(), look);
  for (execution::TraceEvent& event : trace.events) {
    auto* record = std::get_if<execution::LookRecord>(&event);
    if (record != nullptr) record->measured.translation().x() += 0.001;
  }
  int looked = 0;
  for (const LedgerEntry& entry : of_.Ledger(of_.None(), trace)) {
    if (entry.channel.step != look) continue;
    const bool told = entry.channel.effect == Effect::kSensedX;
    EXPECT_NEAR(entry.applied.value(), told ? -0.001 : 0, kGiven) << entry.channel.name;
    EXPECT_EQ(entry.measured.has_value(), !told) << entry.channel.name;
    ++looked;
  }
  EXPECT_EQ(looked, 3);
}

}  // namespace
}  // namespace assay::check::ledger_test
