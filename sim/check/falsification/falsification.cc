#include "sim/check/falsification/falsification.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <mutex>
#include <nlopt.hpp>

#include "planner/base/check.h"
#include "planner/base/stop.h"
#include "sim/check/falsification/falsification_tally.h"
#include "sim/check/falsification/shrink.h"
#include "sim/check/falsification/tried_points.h"
#include "sim/check/falsification/tried_step.h"
#include "sim/execution/trial/scheduler.h"
#include "sim/noise/sampling.h"

namespace assay::check {
namespace {

// Upper limits, as shares of the attempts at a step.
constexpr double kShareOfDesign = 0.4;    // corners that show the effects of errors
constexpr double kShareOfExtremes = 0.3;  // corners at which claims are likely to be extreme
constexpr double kShareOfEven = 0.1;
constexpr std::size_t kMostStates = 16;  // states that the next step starts from
constexpr std::size_t kSearches = 8;     // local searches from a step's least margins
// Number of attempts between two checks for a violation, if one violation is enough.
constexpr std::size_t kAtOnce = 4;

bool Violates(const Sample& sample) {
  return std::ranges::any_of(sample.attempt.claims, &Claim::IsViolated);
}

// Returns the samples whose ends the next step starts from: those whose errors are farthest out in
// each direction, and some of the others.
std::vector<const Sample*> FarthestSamples(TriedStep& step) {
  std::map<ClaimKey, std::pair<const Sample*, const Sample*>> farthest;  // least and greatest
  for (const Sample& sample : step.samples()) {
    if (!sample.attempt.end) continue;
    for (const Claim& claim : sample.attempt.claims) {
      if (claim.about != Claimed::kAfter) continue;
      auto& [low, high] = farthest.try_emplace(KeyOf(claim), &sample, &sample).first->second;
      if (claim.observed < Find(low->attempt.claims, KeyOf(claim))->observed) low = &sample;
      if (claim.observed > Find(high->attempt.claims, KeyOf(claim))->observed) high = &sample;
    }
  }
  std::vector<const Sample*> chosen;
  const auto choose = [&](const Sample* sample) {
    if (std::ranges::find(chosen, sample) == chosen.end()) chosen.push_back(sample);
  };
  for (const auto& [key, ends] : farthest) {
    choose(ends.first);
    choose(ends.second);
  }
  // Some of the other samples are added, spread evenly over all.
  const std::size_t stride = std::max<std::size_t>(1, step.samples().size() / kMostStates);
  for (std::size_t i = 0; i < step.samples().size(); i += stride) {
    if (step.samples()[i].attempt.end) choose(&step.samples()[i]);
  }
  if (chosen.size() > kMostStates) chosen.resize(kMostStates);
  return chosen;
}

// Subplex (Rowan 1990) is used because margins have kinks and a little noise.
void Minimize(const std::function<double(const std::vector<double>&)>& f, std::vector<double> point,
              std::int64_t evaluations) {
  nlopt::opt search(nlopt::LN_SBPLX, static_cast<unsigned>(point.size()));
  search.set_lower_bounds(0);
  search.set_upper_bounds(1);
  search.set_initial_step(0.25);
  search.set_maxeval(static_cast<int>(evaluations));
  using Function = std::function<double(const std::vector<double>&)>;
  search.set_min_objective([](const std::vector<double>& x, std::vector<double>&,
                              void* data) { return (*static_cast<const Function*>(data))(x); },
                           const_cast<Function*>(&f));
  double least = 0;
  try {
    search.optimize(point, least);
  } catch (const nlopt::roundoff_limited&) {
    // The search cannot do better than that.
  } catch (const nlopt::forced_stop&) {
    // The falsification was stopped, or has found enough violations.
  }
}

class Falsifier {
 public:
  Falsifier(const Experiment& experiment, const FalsificationOptions& options)
      : experiment_(experiment),
        options_(options),
        scheduler_(options.jobs),
        box_(noise::ErrorBox(experiment.problem, experiment.plan)),
        worlds_(WorldsOf(experiment, box_)) {
    result_.certificates.resize(experiment.plan.steps.size());
    result_.attempts_at.resize(experiment.plan.steps.size());
  }

  FalsificationResult Run() {
    if (!IsFinished([this] { result_.noiseless = ExecuteWithoutNoise(experiment_); })) {
      return std::move(result_);
    }
    if (result_.noiseless.Holds()) {
      IsFinished([this] { FalsifySteps(); });
      Shrink();
    } else {
      CountWithoutNoise();
    }
    return std::move(result_);
  }

 private:
  void FalsifySteps() {
    const std::vector<plan::StepId> order = experiment_.plan.ExecutionOrder();
    std::vector<Start> starts;
    for (const TriedWorld& world : worlds_) starts.push_back({&world, world.noise, nullptr});
    for (std::size_t i = 0; i < order.size() && !starts.empty() && !Stops(); ++i) {
      const std::int64_t budget = Budget(i, order.size());
      if (budget == 0) break;
      TriedStep step(experiment_, order[i], worlds_.front().noise);
      Poise(starts, step);
      if (step.poised().empty()) break;
      FalsifyStep(step, budget);
      result_.attempts_at[order[i].index()] = std::ssize(step.samples());
      starts = Collect(step);
      if (IsEnough(step)) return;
    }
  }

  // Returns the number of attempts at the step with this index. Every step gets a first attempt
  // before any step gets a second one, because an attempt at the next step starts where an attempt
  // at this step has ended.
  std::int64_t Budget(std::size_t index, std::size_t count) const {
    const auto done = static_cast<std::int64_t>(index);
    const auto steps = static_cast<std::int64_t>(count);
    if (options_.attempts < steps) return done < options_.attempts ? 1 : 0;
    return options_.attempts * (done + 1) / steps - options_.attempts * done / steps;
  }

  // Counts the violations of the execution without noise. This execution has no errors that could
  // be reduced, so each counterexample stays as it is.
  void CountWithoutNoise() {
    const noise::Noise none(box_, std::vector<double>(box_.size(), 0));
    const std::vector<Claim>& violated = result_.noiseless.violated;
    if (!violated.empty()) result_.first_violation = 0;
    for (const Claim& claim : violated) {
      result_.claims.Add(claim.verdict);
      result_.worst.push_back({claim, none, FalsificationPhase::kWithoutNoise, 0});
    }
    for (const CertificateVerdict& verdict : ByStep(violated)) {
      result_.certificates[verdict.step.index()].Add(verdict.verdict);
      if (result_.counterexamples.size() == static_cast<std::size_t>(options_.shrunk)) continue;
      result_.counterexamples.push_back({.claim = verdict.worst,
                                         .noise = none,
                                         .steps = experiment_.plan.step(verdict.step).executed,
                                         .replayed = true,
                                         .is_simplest = true});
    }
  }

  // The state from which a step is approached. `from` is null at the start of a trial.
  struct Start {
    const TriedWorld* world;
    noise::Noise noise;
    std::shared_ptr<const execution::Checkpoint> from;
  };

  bool Stops() const { return options_.stop && options_.stop(); }

  // Does the work, and returns false if a stop has ended it during an execution. If no caller asked
  // for results before the stop, the exception is passed on.
  bool IsFinished(const std::function<void()>& work) const {
    try {
      work();
      return true;
    } catch (const Stopped&) {
      if (!Stops()) throw;
      return false;
    }
  }

  void Poise(const std::vector<Start>& starts, TriedStep& step) {
    const auto poise = [&](std::size_t i) {
      return step.falsification().Poise(*starts[i].world, starts[i].noise, starts[i].from.get());
    };
    scheduler_.InOrder(starts.size(), poise, [&](std::size_t i, Approach approach) {
      tally_.Count(approach.claims, starts[i].noise, FalsificationPhase::kVertices);
      if (approach.poised) {
        step.poised().push_back(std::move(*approach.poised));
      } else {
        ++result_.failed_approaches;
      }
    });
  }

  void FalsifyStep(TriedStep& step, std::int64_t budget) {
    const auto share = [&](double of_all) {
      return static_cast<std::int64_t>(of_all * static_cast<double>(budget));
    };
    // The number of corners is rounded up, so that even a single attempt is made at a corner. It is
    // at most the size of the whole design, because further corners show nothing more about the
    // effects.
    const std::int64_t left = budget - share(kShareOfExtremes) - share(kShareOfEven);
    const std::int64_t design = std::min(
        {left, static_cast<std::int64_t>(std::ceil(kShareOfDesign * static_cast<double>(budget))),
         std::int64_t{noise::CornerDesignSize(step.dimensions())}});
    TryAll(step, DesignCorners(step, options_.seed, design));
    if (IsEnough(step)) return;
    step.FindAims();
    TryAll(step, LikelyCorners(step, share(kShareOfExtremes)));
    if (IsEnough(step)) return;
    TryAll(step, EvenPoints(step, options_.seed, share(kShareOfEven)));
    if (IsEnough(step)) return;
    SearchLocally(step, budget - std::ssize(step.samples()));
  }

  bool IsEnough(TriedStep& step) const {
    return Stops() || (options_.until_violated && std::ranges::any_of(step.samples(), Violates));
  }

  void TryAll(TriedStep& step, std::vector<Sample> samples) {
    const std::size_t at_once = options_.until_violated ? kAtOnce : samples.size();
    for (std::size_t first = 0; first < samples.size() && !IsEnough(step); first += at_once) {
      const std::size_t count = std::min(at_once, samples.size() - first);
      const auto attempt = [&](std::size_t i) {
        return Tried(step, std::move(samples[first + i]));
      };
      scheduler_.InOrder(count, attempt, [&](std::size_t, Sample sample) {
        if (sample.was_made) step.samples().push_back(std::move(sample));
      });
    }
  }

  Sample Tried(const TriedStep& step, Sample sample) {
    if (Stops() || !IsFinished([&] { sample.attempt = step.Attempt(sample); })) return sample;
    sample.was_made = true;
    const std::int64_t made = ++made_;
    if (!options_.progress) return sample;
    const std::lock_guard lock(mutex_);
    options_.progress(made);
    return sample;
  }

  // Searches from the least margins of different claims, with one search for each, side by side.
  void SearchLocally(TriedStep& step, std::int64_t budget) {
    std::vector<Aim> aims;
    std::vector<const Sample*> starts;
    for (const auto& [key, sample] : LeastMargins(step)) {
      const Aim* const aim = step.AimAt(key);
      if (aim == nullptr || aims.size() == kSearches) continue;
      aims.push_back(*aim);
      starts.push_back(sample);
    }
    if (aims.empty() || step.dimensions() == 0) return;
    const std::vector<std::int64_t> counts = Allotted(budget, aims);
    // The new samples are kept apart until all searches have ended, because each search reads the
    // step's samples while it runs.
    std::vector<Sample> found;
    scheduler_.InOrder(
        aims.size(), [&](std::size_t i) { return Search(step, aims[i], *starts[i], counts[i]); },
        [&](std::size_t, std::vector<Sample> samples) {
          std::ranges::move(samples, std::back_inserter(found));
        });
    std::ranges::move(found, std::back_inserter(step.samples()));
  }

  std::vector<Sample> Search(const TriedStep& step, const Aim& aim, const Sample& start,
                             std::int64_t budget) {
    std::vector<Sample> samples;
    if (budget < 1) return samples;
    const std::function<double(const std::vector<double>&)> margin =
        [&](const std::vector<double>& point) {
          Sample sample =
              Tried(step, {start.start, point, FalsificationPhase::kLocalSearch, aim.until});
          if (!sample.was_made) throw nlopt::forced_stop();
          const Claim* claim = Find(sample.attempt.claims, aim.claim);
          const double value = claim == nullptr ? 1 : Length(*claim);
          samples.push_back(std::move(sample));
          if (options_.until_violated && Violates(samples.back())) throw nlopt::forced_stop();
          return value;
        };
    Minimize(margin, start.point, budget);
    return samples;
  }

  // Counts the step's samples, and returns the states that the next step starts from.
  std::vector<Start> Collect(TriedStep& step) {
    for (const Sample& sample : step.samples()) tally_.Count(sample);
    std::vector<Start> starts;
    for (const Sample* sample : FarthestSamples(step)) {
      starts.push_back({step.poised()[sample->start].world, sample->attempt.noise,
                        std::make_shared<const execution::Checkpoint>(*sample->attempt.end)});
    }
    return starts;
  }

  // Violations that need the fewest steps are shrunk first, then those with the most negative
  // margins.
  void Shrink() {
    std::vector<const WorstClaim*> violations;
    for (const WorstClaim& worst : result_.worst) {
      if (worst.claim.IsViolated()) violations.push_back(&worst);
    }
    std::ranges::stable_sort(violations, {}, [this](const WorstClaim* worst) {
      return std::pair(experiment_.plan.step(worst->claim.step).executed, Length(worst->claim));
    });
    const auto count = std::min(violations.size(), static_cast<std::size_t>(options_.shrunk));
    const auto shrink = [&](std::size_t i) {
      Counterexample example = AsFound(*violations[i]);
      if (!Stops()) IsFinished([&] { check::Shrink(experiment_, example); });
      return example;
    };
    scheduler_.InOrder(count, shrink, [&](std::size_t, Counterexample example) {
      result_.counterexamples.push_back(std::move(example));
    });
  }

  Counterexample AsFound(const WorstClaim& violation) const {
    return {.claim = violation.claim,
            .noise = violation.noise,
            .steps = experiment_.plan.step(violation.claim.step).executed};
  }

  const Experiment& experiment_;
  const FalsificationOptions& options_;
  execution::Scheduler scheduler_;
  std::vector<noise::Channel> box_;
  std::vector<TriedWorld> worlds_;
  std::mutex mutex_;
  std::atomic<std::int64_t> made_ = 0;
  FalsificationResult result_;
  FalsificationTally tally_{result_};
};

}  // namespace

FalsificationResult Falsify(const Experiment& experiment, const FalsificationOptions& options) {
  return Falsifier(experiment, options).Run();
}

}  // namespace assay::check
