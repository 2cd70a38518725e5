#include "sim/cli/mating_trials.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <utility>

#include "planner/base/random.h"

namespace assay::cli {
namespace {

constexpr double kSeated = 1e-3;  // metres from the seat along the way in

}  // namespace

MatingTrials::MatingTrials(const PlannedProblem& planned, const plan::Assemble& assemble,
                           const finemotion::MatingGeometry& geometry,
                           const MatingTrialSettings& settings)
    : problem_(planned.problem),
      assemble_(assemble),
      geometry_(geometry),
      settings_(settings),
      scene_(planned.problem, settings.scene) {}

MatedTrial MatingTrials::RunStrategy(int number, const plan::Strategy& strategy,
                                     const check::PlannedContacts& contacts) const {
  const exec::MatingSetting setting = SettingOf(number);
  check::ContactObserver observer(scene_, problem_.mating(assemble_.mating), geometry_, contacts);
  exec::MatingTrialOptions options;
  options.observer = std::ref(observer);
  MatedTrial trial =
      Told(number, setting, exec::RunMatingTrial(problem_, scene_, setting, strategy, options));
  const std::vector<check::ContactSpan> bridged = check::Bridged(observer.seen().spans);
  trial.sequence = {observer.seen(), check::StatesOf(bridged), check::Compare(contacts, bridged)};
  return trial;
}

MatedTrial MatingTrials::RunStraight(int number) const {
  const exec::MatingSetting setting = SettingOf(number);
  return Told(number, setting, exec::RunStraightMating(problem_, scene_, setting));
}

exec::MatingSetting MatingTrials::SettingOf(int number) const {
  RandomStream random(settings_.seed, fmt::format("mating trial {}", number));
  exec::MatingSetting setting{
      .mating = assemble_.mating, .hold = assemble_.hold, .X_HeldTip = geometry_.X_HeldTip};
  const auto most = settings_.beyond * settings_.errors.pose;
  for (int i = 0; i < 3; ++i) setting.d[i] = random.Uniform(-most[i], most[i]);
  for (int i = 0; i < 3; ++i) setting.w[i] = random.Uniform(-most[3 + i], most[3 + i]);
  return setting;
}

MatedTrial MatingTrials::Told(int number, const exec::MatingSetting& setting,
                              exec::MatingResult result) const {
  MatedTrial trial{.number = number, .result = std::move(result)};
  for (int i = 0; i < finemotion::kPoseDimensions; ++i) {
    const double half = settings_.errors.pose[i];
    const double error = std::abs(i < 3 ? setting.d[i] : setting.w[i - 3]);
    if (half > 0) trial.scale = std::max(trial.scale, error / half);
  }
  const geometry::Pose at = trial.result.X_FixedHeld * geometry_.X_HeldTip;
  const geometry::Vector3 left = geometry_.X_FixedSeat.translation() - at.translation();
  trial.seated = std::abs(left.dot(geometry_.passage.mating)) < kSeated;
  return trial;
}

}  // namespace assay::cli
