#include "sim/check/falsification/step_falsification.h"

#include <algorithm>
#include <utility>

#include "planner/base/check.h"
#include "sim/check/certificate_claims/certificate_check.h"
#include "sim/check/noise_floor/confirmation.h"
#include "sim/execution/walk/executor.h"
#include "sim/noise/possible_start.h"
#include "sim/noise/sampling.h"

namespace assay::check {
namespace {

using domain::PartId;
using noise::Channel;
using noise::Effect;

bool IsOfWorld(const Channel& channel) {
  return channel.effect == Effect::kClearance || channel.effect == Effect::kFriction ||
         channel.effect == Effect::kPadFriction;
}

// Parts that are assembled with each other at the start are touched together.
std::vector<PartId> UntouchedBefore(const Experiment& experiment, plan::StepId step) {
  const domain::Problem& problem = experiment.problem;
  std::vector<PartId> touched;  // parts that stand on tables
  for (const plan::StepId id : experiment.plan.ExecutionOrder()) {
    if (id == step) break;
    for (const PartId part : PartsOf(problem, experiment.plan.step(id).action)) {
      touched.push_back(domain::CarrierAtStart(problem, part));
    }
  }
  std::vector<PartId> untouched;
  for (std::size_t p = 0; p < problem.parts.size(); ++p) {
    const PartId carrier = domain::CarrierAtStart(problem, PartId(p));
    if (std::ranges::find(touched, carrier) == touched.end()) untouched.emplace_back(p);
  }
  return untouched;
}

// Nothing more is claimed after an unproved precondition has failed, or after a recovery.
bool StillClaims(const std::vector<Claim>& claims) {
  return std::ranges::none_of(claims, [](const Claim& claim) {
    return claim.about == Claimed::kAfter && claim.verdict == ClaimVerdict::kNotClaimed;
  });
}

execution::ExecutorOptions QuietOptions(const noise::Noise& noise) {
  execution::ExecutorOptions options;
  options.sample_rate = 0;
  options.noise = noise;
  options.recovers = false;  // after a recovery nothing is claimed
  return options;
}

void End(const execution::Progress& failure, execution::Execution& execution) {
  execution.trace().events.push_back(execution::ExecutionEnd{failure->outcome, failure->reason,
                                                             execution.Now(), execution.steps()});
}

double TimeOf(const execution::TraceEvent& event) {
  if (const auto* milestone = std::get_if<execution::Milestone>(&event))
    return milestone->snapshot.time;
  if (const auto* end = std::get_if<execution::StepEnd>(&event)) return end->snapshot.time;
  if (const auto* end = std::get_if<execution::ExecutionEnd>(&event)) return end->snapshot.time;
  ASSAY_CHECK(false, "a trace of a step ends with one of these");
  return 0;
}

execution::Stage StageOf(Until until) {
  switch (until) {
    case Until::kPoised:
      return execution::Stage::kPoised;
    case Until::kReached:
      return execution::Stage::kReached;
    case Until::kActed:
    case Until::kEnd:
      return execution::Stage::kActed;
  }
  return execution::Stage::kActed;
}

// Returns the trace of a step up to a stage, or nothing if the step did not come there.
std::optional<execution::Trace> UpTo(Until until, const execution::Trace& trace) {
  execution::Trace begun{.problem = trace.problem, .parts = trace.parts};
  for (const execution::TraceEvent& event : trace.events) {
    begun.events.push_back(event);
    const auto* milestone = std::get_if<execution::Milestone>(&event);
    if (milestone != nullptr && milestone->stage == StageOf(until)) return begun;
  }
  return std::nullopt;
}

bool SaysTheSame(const Claim& claim, const std::vector<Claim>& others) {
  return std::ranges::any_of(others, [&](const Claim& other) {
    return IsSame(claim, other) && claim.observed == other.observed &&
           claim.verdict == other.verdict;
  });
}

}  // namespace

StepFalsification::StepFalsification(const Experiment& experiment, plan::StepId step,
                                     const noise::Noise& noise)
    : experiment_(experiment),
      start_(experiment.problem),
      step_(step),
      untouched_(UntouchedBefore(experiment, step)) {
  for (std::size_t i = 0; i < noise.box().size(); ++i) {
    const Channel& channel = noise.box()[i];
    const bool untouched = channel.step.IsNone() && !IsOfWorld(channel) &&
                           std::ranges::find(untouched_, channel.part) != untouched_.end();
    if (channel.step == step || untouched) free_.push_back(i);
  }
}

// The engine's errors add up on the way, so the trial with half the timestep is executed from the
// start as well.
Approach StepFalsification::Poise(const TriedWorld& world, const noise::Noise& noise,
                                  const execution::Checkpoint* from) const {
  Approach approach = PoiseIn(world.scene, world, noise, from);
  approach.claims = Confirmed(std::move(approach.claims),
                              [&] { return PoiseIn(world.finer, world, noise, nullptr).claims; });
  return approach;
}

Approach StepFalsification::PoiseIn(const scene::Scene& scene, const TriedWorld& world,
                                    const noise::Noise& noise,
                                    const execution::Checkpoint* from) const {
  const execution::ExecutorOptions options = QuietOptions(noise);
  mujoco::Data data = from == nullptr ? execution::StartOf(experiment_.problem, scene, noise)
                                      : mujoco::Data(scene.model());
  execution::Execution execution(experiment_.problem, scene, data, options);
  execution::Progress failure;
  if (from != nullptr) {
    execution.Restore(*from);
  } else {
    failure = ExecuteStepsBefore(execution);
  }
  Approach approach;
  if (failure) return approach;
  execution.trace().events = {execution::ExecutionStart{execution.Now()}};
  execution::StepExecution step(experiment_.plan, step_, execution);
  failure = step.Approach();
  if (failure) End(failure, execution);
  // An attempt makes claims about the places of the parts that the step handles.
  for (Claim& claim : ClaimsOf(execution.trace())) {
    if (claim.about == Claimed::kAfter) approach.claims.push_back(std::move(claim));
  }
  if (!failure) approach.poised = PoisedTrial{&world, noise, execution.Save()};
  return approach;
}

execution::Progress StepFalsification::ExecuteStepsBefore(execution::Execution& execution) const {
  for (const plan::StepId id : experiment_.plan.ExecutionOrder()) {
    if (id == step_) break;
    execution::StepExecution step(experiment_.plan, id, execution);
    if (execution::Progress failure = step.Approach()) return failure;
    if (execution::Progress failure = step.Work()) return failure;
  }
  return std::nullopt;
}

// Claims of an attempt that ends early do not count if an unproved precondition fails later.
StepAttempt StepFalsification::Attempt(const PoisedTrial& poised, const std::vector<double>& values,
                                       Until until) const {
  noise::Noise noise = poised.noise;
  for (std::size_t i = 0; i < free_.size(); ++i) noise.Set(free_[i], values[i]);
  noise = start_.MovedBack(std::move(noise), poised.noise);
  const TriedWorld& world = *poised.world;
  StepAttempt attempt = AttemptIn(world.scene, world, poised.checkpoint, noise, until);
  const bool violates = std::ranges::any_of(attempt.claims, &Claim::IsViolated);
  if (violates && until != Until::kEnd && !IsAllProved()) {
    attempt = AttemptIn(world.scene, world, poised.checkpoint, noise, Until::kEnd);
  }
  Until latest = attempt.IsWhole() ? Until::kPoised : until;
  for (std::size_t i = 0; i < attempt.decisions.size(); ++i) {
    if (attempt.claims[i].IsViolated()) latest = std::max(latest, attempt.decisions[i].until);
  }
  attempt.claims =
      Confirmed(std::move(attempt.claims), [&] { return FinerClaims(poised, noise, latest); });
  return attempt;
}

bool StepFalsification::IsAllProved() const {
  const plan::PlannedStep& step = experiment_.plan.step(step_);
  return std::ranges::all_of(
      step.certificate.preconditions, [&](const plan::CertifiedPrecondition& claim) {
        return claim.holds() || plan::Absorbs(step.strategy, claim.condition);
      });
}

std::vector<Claim> StepFalsification::FinerClaims(const PoisedTrial& poised,
                                                  const noise::Noise& noise, Until until) const {
  const TriedWorld& world = *poised.world;
  FinerTrial& finer = *poised.finer;
  std::call_once(finer.once, [&] {
    const Approach approach = PoiseIn(world.finer, world, poised.noise, nullptr);
    if (approach.poised) finer.checkpoint = approach.poised->checkpoint;
  });
  if (!finer.checkpoint) return {};
  return AttemptIn(world.finer, world, *finer.checkpoint, noise, until).claims;
}

StepAttempt StepFalsification::AttemptIn(const scene::Scene& scene, const TriedWorld& world,
                                         const execution::Checkpoint& from,
                                         const noise::Noise& noise, Until until) const {
  StepAttempt attempt{.noise = noise, .claims = {}};
  const execution::ExecutorOptions options = QuietOptions(noise);
  mujoco::Data data(scene.model());
  execution::Execution execution(experiment_.problem, scene, data, options);
  execution.Restore(from);
  execution::PlaceAtStart(experiment_.problem, scene, world.resting, noise, untouched_, data);
  execution::StepExecution step(experiment_.plan, step_, execution);
  execution::Progress failure = step.TakeUpNoise();
  if (!failure) failure = Work(step, until);
  if (failure) End(failure, execution);
  attempt.claims = ClaimsOf(execution.trace());
  if (failure || until == Until::kEnd) {
    attempt.decisions = DecisionsOn(attempt.claims, execution.trace(), from.state.time);
  }
  if (!failure && until == Until::kEnd && StillClaims(attempt.claims)) {
    attempt.end = execution.Save();
  }
  return attempt;
}

execution::Progress StepFalsification::Work(execution::StepExecution& step, Until until) const {
  switch (until) {
    case Until::kPoised:
      return std::nullopt;
    case Until::kReached:
      return step.Advance();
    case Until::kActed:
      return step.Attempt();
    case Until::kEnd:
      return step.Work();
  }
  return std::nullopt;
}

std::vector<Claim> StepFalsification::ClaimsOf(const execution::Trace& trace) const {
  return CheckCertificates(experiment_.problem, experiment_.plan, trace, experiment_.gate, step_);
}

// A claim is decided at the earliest stage at which the trace up to there gives it the same result.
std::vector<Decision> StepFalsification::DecisionsOn(const std::vector<Claim>& claims,
                                                     const execution::Trace& trace,
                                                     double start) const {
  const double whole = TimeOf(trace.events.back()) - start;
  std::vector<Decision> decisions(claims.size(), {Until::kEnd, whole});
  for (const Until until : {Until::kActed, Until::kReached, Until::kPoised}) {
    const std::optional<execution::Trace> begun = UpTo(until, trace);
    if (!begun) continue;
    const std::vector<Claim> so_far = ClaimsOf(*begun);
    for (std::size_t i = 0; i < claims.size(); ++i) {
      if (SaysTheSame(claims[i], so_far)) {
        decisions[i] = {until, TimeOf(begun->events.back()) - start};
      }
    }
  }
  return decisions;
}

std::vector<TriedWorld> WorldsOf(const Experiment& experiment, const std::vector<Channel>& box) {
  std::vector<std::size_t> of_world;
  for (std::size_t i = 0; i < box.size(); ++i) {
    if (IsOfWorld(box[i])) of_world.push_back(i);
  }
  const int dimensions = static_cast<int>(of_world.size());
  // One tolerance has two corners. With two or three tolerances, four corners put each at both of
  // its ends in turn.
  const int count = dimensions == 0 ? 1 : dimensions == 1 ? 2 : 4;
  std::vector<TriedWorld> worlds;
  for (int number = 1; number <= count; ++number) {
    noise::Noise noise(box, std::vector<double>(box.size(), 0));
    const std::vector<double> corner = noise::CornerPoint(dimensions, 0, number);
    for (std::size_t i = 0; i < of_world.size(); ++i) {
      const Interval& range = box[of_world[i]].range;
      noise.Set(of_world[i], corner[i] > 0 ? range.high : range.low);
    }
    const scene::SceneOptions truth = execution::TrueScene(experiment.scene, noise);
    scene::Scene scene(experiment.problem, truth);
    std::vector<geometry::Pose> resting = execution::RestingPoses(experiment.problem, scene);
    worlds.push_back({std::move(scene),
                      {experiment.problem, Finer(truth)},
                      std::move(noise),
                      std::move(resting)});
  }
  return worlds;
}

}  // namespace assay::check
