#include "sim/cli/tasks/mating_trials.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>

#include "planner/base/random.h"
#include "sim/cli/command_line/usage_error.h"
#include "sim/execution/trial/finding.h"
#include "sim/noise/possible_start.h"

namespace assay::cli {

MatingTrials::MatingTrials(const MatingTask& task, const finemotion::MatingGeometry& geometry,
                           const plan::Strategy& strategy, const MatingTrialSettings& settings)
    : problem_(task.planned.problem),
      assemble_(task.assemble),
      geometry_(geometry),
      strategy_(strategy),
      settings_(settings),
      scene_(task.planned.problem, settings.scene) {}

MatedTrial MatingTrials::RunStrategy(int number, const check::PlannedContacts& contacts,
                                     double sample_rate) const {
  const Drawn drawn = DrawnFor(number);
  check::ContactObserver observer(scene_, problem_.mating(assemble_.mating), geometry_, contacts);
  const execution::MatingTrialOptions options{.observer = std::ref(observer),
                                              .sample_rate = sample_rate};
  MatedTrial trial =
      Recorded(number, drawn,
               execution::RunMatingTrial(problem_, scene_, drawn.setting, strategy_, options));
  const std::vector<check::ContactSpan> bridged = check::Bridged(observer.seen().spans);
  trial.sequence = {observer.seen(), check::StatesOf(bridged), check::Compare(contacts, bridged)};
  return trial;
}

MatedTrial MatingTrials::RunStraight(int number, double sample_rate) const {
  const Drawn drawn = DrawnFor(number);
  return Recorded(
      number, drawn,
      execution::RunStraightMating(problem_, scene_, drawn.setting, {.sample_rate = sample_rate}));
}

MatingTrials::Drawn MatingTrials::DrawnFor(int number) const {
  RandomStream random(settings_.seed, fmt::format("mating trial {}", number));
  Drawn drawn{.setting = {.mating = assemble_.mating,
                          .hold = assemble_.hold,
                          .X_HeldTip = geometry_.X_HeldTip,
                          .near = settings_.near}};
  execution::MatingSetting& setting = drawn.setting;
  const auto most = settings_.beyond * settings_.errors.pose;
  const std::optional<int> redrawn = noise::DrawUntilPossible([&] {
    for (int i = 0; i < 3; ++i) setting.d[i] = random.Uniform(-most[i], most[i]);
    for (int i = 0; i < 3; ++i) setting.w[i] = random.Uniform(-most[3 + i], most[3 + i]);
    return CanStart(problem_, setting, strategy_);
  });
  if (!redrawn) {
    throw UsageError(fmt::format("mate: --beyond {:g}: with {} draws of errors no trial can begin",
                                 settings_.beyond, noise::kMostDraws));
  }
  drawn.redrawn = *redrawn;
  return drawn;
}

MatedTrial MatingTrials::Recorded(int number, const Drawn& drawn,
                                  execution::MatingResult result) const {
  MatedTrial trial{.number = number, .redrawn = drawn.redrawn, .result = std::move(result)};
  for (int i = 0; i < finemotion::kPoseDimensions; ++i) {
    const double half = settings_.errors.pose[i];
    const double error = std::abs(i < 3 ? drawn.setting.d[i] : drawn.setting.w[i - 3]);
    if (half > 0) trial.scale = std::max(trial.scale, error / half);
  }
  const std::vector<execution::Finding> findings = execution::MatingFindings(
      problem_, problem_.mating(assemble_.mating), trial.result.X_FixedHeld);
  const auto failed = std::ranges::find(findings, false, &execution::Finding::holds);
  trial.seated = failed == findings.end();
  // A strategy may be completed in the belief that the part is seated, and give no reason.
  std::string& reason = trial.result.end.reason;
  if (!trial.seated && reason.empty()) reason = execution::Text(*failed);
  return trial;
}

}  // namespace assay::cli
