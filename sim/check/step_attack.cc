#include "sim/check/step_attack.h"

#include <algorithm>

#include "sim/check/certificate_check.h"
#include "sim/check/confirmation.h"
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

// The parts that an action handles, looks at or touches with what it handles.
struct TouchedParts {
  const domain::Problem& problem;

  std::vector<PartId> operator()(const plan::Assemble& assemble) const {
    const domain::Mating& mating = problem.mating(assemble.mating);
    return {mating.held, mating.fixed};
  }
  std::vector<PartId> operator()(const auto& action) const { return {action.part}; }
};

std::vector<PartId> UntouchedBefore(const Experiment& experiment, plan::StepId step) {
  std::vector<PartId> touched;
  for (const plan::StepId id : experiment.plan.ExecutionOrder()) {
    if (id == step) break;
    const auto parts =
        std::visit(TouchedParts{experiment.problem}, experiment.plan.step(id).action);
    touched.insert(touched.end(), parts.begin(), parts.end());
  }
  std::vector<PartId> untouched;
  for (std::size_t p = 0; p < experiment.problem.parts.size(); ++p) {
    if (std::ranges::find(touched, PartId(p)) == touched.end()) untouched.push_back(PartId(p));
  }
  return untouched;
}

// Nothing more is claimed once something failed that had not been proved, or was mended.
bool StillClaims(const std::vector<Claim>& claims) {
  return std::ranges::none_of(claims, [](const Claim& claim) {
    return claim.about == Claimed::kAfter && claim.verdict == ClaimVerdict::kNotClaimed;
  });
}

exec::ExecutorOptions QuietOptions(const noise::Noise& noise) {
  exec::ExecutorOptions options;
  options.sample_rate = 0;
  options.noise = noise;
  options.recovers = false;  // after a recovery nothing is claimed
  return options;
}

void End(const exec::Progress& failure, exec::Execution& execution) {
  execution.trace().events.push_back(
      exec::ExecutionEnd{failure->outcome, failure->reason, execution.Now(), execution.steps()});
}

}  // namespace

StepAttack::StepAttack(const Experiment& experiment, plan::StepId step, const noise::Noise& noise)
    : experiment_(experiment), step_(step), untouched_(UntouchedBefore(experiment, step)) {
  for (std::size_t i = 0; i < noise.box().size(); ++i) {
    const Channel& channel = noise.box()[i];
    const bool untouched = channel.step.IsNone() && !IsOfWorld(channel) &&
                           std::ranges::find(untouched_, channel.part) != untouched_.end();
    if (channel.step == step || untouched) free_.push_back(i);
  }
}

Approach StepAttack::Poise(const AttackedWorld& world, const noise::Noise& noise,
                           const exec::Checkpoint* from) const {
  Approach approach = PoiseIn(world.scene, world, noise, from);
  approach.claims = Confirmed(std::move(approach.claims),
                              [&] { return PoiseIn(world.finer, world, noise, from).claims; });
  return approach;
}

Approach StepAttack::PoiseIn(const scene::Scene& scene, const AttackedWorld& world,
                             const noise::Noise& noise, const exec::Checkpoint* from) const {
  const exec::ExecutorOptions options = QuietOptions(noise);
  mujoco::Data data = from == nullptr ? exec::StartOf(experiment_.problem, scene, noise)
                                      : mujoco::Data(scene.model());
  exec::Execution execution(experiment_.problem, scene, data, options);
  if (from != nullptr) execution.Restore(*from);
  exec::StepExecution step(experiment_.plan, step_, execution);
  const exec::Progress failure = step.Approach();
  if (failure) End(failure, execution);
  Approach approach;
  for (Claim& claim : CheckCertificates(experiment_.problem, experiment_.plan, execution.trace(),
                                        experiment_.gate, step_)) {
    if (claim.unit == Unit::kNone) approach.claims.push_back(std::move(claim));
  }
  if (!failure) approach.poised = PoisedTrial{&world, noise, execution.Save()};
  return approach;
}

StepAttempt StepAttack::Attempt(const PoisedTrial& poised,
                                const std::vector<double>& values) const {
  noise::Noise noise = poised.noise;
  for (std::size_t i = 0; i < free_.size(); ++i) noise.Set(free_[i], values[i]);
  StepAttempt attempt = AttemptIn(poised.world->scene, poised, noise);
  attempt.claims = Confirmed(std::move(attempt.claims),
                             [&] { return AttemptIn(poised.world->finer, poised, noise).claims; });
  return attempt;
}

StepAttempt StepAttack::AttemptIn(const scene::Scene& scene, const PoisedTrial& poised,
                                  const noise::Noise& noise) const {
  StepAttempt attempt{.noise = noise, .claims = {}, .end = {}};
  const exec::ExecutorOptions options = QuietOptions(noise);
  mujoco::Data data(scene.model());
  exec::Execution execution(experiment_.problem, scene, data, options);
  execution.Restore(poised.checkpoint);
  for (const PartId part : untouched_) {
    scene.SetTableHeight(data, part, noise.TableHeight(part));
    scene.SetPart(data, part, noise.TruePose(part, poised.world->resting[part.index()]));
  }
  exec::StepExecution step(experiment_.plan, step_, execution);
  exec::Progress failure = step.TakeUpNoise();
  if (!failure) failure = step.Work();
  if (failure) End(failure, execution);
  attempt.claims = CheckCertificates(experiment_.problem, experiment_.plan, execution.trace(),
                                     experiment_.gate, step_);
  if (!failure && StillClaims(attempt.claims)) attempt.end = execution.Save();
  return attempt;
}

std::vector<AttackedWorld> WorldsOf(const Experiment& experiment, const std::vector<Channel>& box) {
  std::vector<std::size_t> of_world;
  for (std::size_t i = 0; i < box.size(); ++i) {
    if (IsOfWorld(box[i])) of_world.push_back(i);
  }
  const int dimensions = static_cast<int>(of_world.size());
  // Two corners of one tolerance, four of two or three that are at both ends in turn.
  const int count = dimensions == 0 ? 1 : dimensions == 1 ? 2 : 4;
  std::vector<AttackedWorld> worlds;
  for (int number = 1; number <= count; ++number) {
    noise::Noise noise(box, std::vector<double>(box.size(), 0));
    const std::vector<double> corner = noise::CornerPoint(dimensions, 0, number);
    for (std::size_t i = 0; i < of_world.size(); ++i) {
      const Interval& range = box[of_world[i]].range;
      noise.Set(of_world[i], corner[i] > 0 ? range.high : range.low);
    }
    const scene::SceneOptions truth = exec::TrueScene(experiment.scene, noise);
    scene::Scene scene(experiment.problem, truth);
    std::vector<geometry::Pose> resting = exec::RestingPoses(experiment.problem, scene);
    worlds.push_back({std::move(scene),
                      {experiment.problem, Finer(truth)},
                      std::move(noise),
                      std::move(resting)});
  }
  return worlds;
}

}  // namespace assay::check
