#include "sim/execution/trial/mating_trial.h"

#include <limits>

#include "planner/base/check.h"
#include "planner/domain/problem/possible_starts.h"
#include "planner/geometry/pose.h"
#include "sim/execution/commands/action_commands.h"
#include "sim/execution/commands/run.h"
#include "sim/execution/trial/finding.h"
#include "sim/execution/walk/executor.h"

namespace assay::execution {
namespace {

constexpr double kClosing = 0.2;  // seconds for the grip to build up

// Returns the tool's pose in the tip's frame, with the part in the hand as believed.
Pose X_TipToolOf(const MatingSetting& setting) {
  return setting.X_HeldTip.inverse() * setting.hold.X_PartTool;
}

Pose HandError(const MatingSetting& setting) {
  Pose displaced = geometry::Translation(setting.d);
  const double angle = setting.w.norm();
  if (angle > 0) displaced.rotate(Eigen::AngleAxisd(angle, setting.w / angle));
  return X_TipToolOf(setting).inverse() * displaced * X_TipToolOf(setting);
}

// Returns the joint values for the pose that are nearest to where the arm should start, or none.
std::optional<JointVector> JointsFor(const domain::Workcell& workcell, const Pose& X_WorldTool,
                                     const MatingSetting& setting) {
  const JointVector& near = setting.near ? *setting.near : workcell.home();
  std::optional<JointVector> nearest;
  for (const auto& s : workcell.arm().Inverse(workcell.FlangeFor(X_WorldTool), near)) {
    const auto q = workcell.arm().NearestInRange(s.q, near);
    if (q && (!nearest || (*q - near).norm() < (*nearest - near).norm())) nearest = *q;
  }
  return nearest;
}

// The simulation and the execution of a trial.
class Trial {
 public:
  Trial(const domain::Problem& problem, const scene::Scene& scene, const MatingSetting& setting,
        const MatingTrialOptions& options)
      : mating_(problem.mating(setting.mating)),
        scene_(scene),
        setting_(setting),
        options_{.sample_rate = options.sample_rate,
                 .kinematic_step = options.kinematic_step,
                 .force_limit = options.law.force_limit},
        data_(scene.Start()),
        execution_(problem, scene, data_, options_) {
    scene.SetPart(data_, mating_.fixed, RestingPoses(problem, scene)[mating_.fixed.index()]);
    scene.Clamp(data_, mating_.fixed, problem.part(mating_.fixed).clamp);
    execution_.world().Believe(mating_.fixed, scene.TruePose(data_, mating_.fixed));
  }

  // Places the closed hand, with the part in it, so that the hand's believed pose is X_WorldTool.
  Progress Poise(const Pose& X_WorldTool) {
    execution_.SetHandError(HandError(setting_));
    const Pose truly = execution_.Erring(X_WorldTool);
    const auto q = JointsFor(*execution_.problem().workcell, truly, setting_);
    if (!q) return Failure{TrialOutcome::kUnreachable, "the arm cannot start"};
    execution_.Place(*q);
    scene_.SetGripper(data_, setting_.hold.width);
    scene_.SetPart(data_, mating_.held, truly * setting_.hold.X_PartTool.inverse());
    data_.Forward();
    scene_.CommandGripper(data_, 0);
    scene_.AttachPart(data_, mating_.held);
    execution_.world().Take(mating_.held, setting_.hold);
    return execution_.Stay(kClosing);
  }

  Execution& execution() { return execution_; }
  Pose X_WorldFixed() const { return execution_.world().PartPose(mating_.fixed); }

  MatingResult Result(StrategyEnd end) {
    const bool was_taken = !execution_.world().held().IsNone();
    if (end.outcome != TrialOutcome::kEngineWarning && was_taken && !execution_.IsInHand())
      end.outcome = TrialOutcome::kDropped;
    return {.end = std::move(end),
            .duration = data_.time(),
            .greatest_force = execution_.greatest_force(),
            .X_FixedHeld = scene_.TruePose(data_, mating_.fixed).inverse() *
                           scene_.TruePose(data_, mating_.held),
            .trace = TraceIfSampled()};
  }

 private:
  Trace TraceIfSampled() {
    if (options_.sample_rate == 0) return {};
    Trace trace = execution_.trace();
    trace.events.emplace_back(ExecutionEnd{.snapshot = execution_.Now()});
    return trace;
  }

  const domain::Mating& mating_;
  const scene::Scene& scene_;
  const MatingSetting& setting_;
  ExecutorOptions options_;
  mujoco::Data data_;
  Execution execution_;
};

}  // namespace

bool CanStart(const domain::Problem& problem, const MatingSetting& setting,
              const plan::Strategy& strategy) {
  const domain::Mating& mating = problem.mating(setting.mating);
  const Pose& X_WorldFixed = problem.part(mating.fixed).X_WorldPart;
  const Pose truly =
      X_WorldFixed * strategy.X_FixedStart * X_TipToolOf(setting) * HandError(setting);
  const domain::PlacedPart held = {mating.held, truly * setting.hold.X_PartTool.inverse()};
  return JointsFor(*problem.workcell, truly, setting) &&
         !domain::PossibleStarts(problem).Overlap(held, {mating.fixed, X_WorldFixed});
}

MatingResult RunMatingTrial(const domain::Problem& problem, const scene::Scene& scene,
                            const MatingSetting& setting, const plan::Strategy& strategy,
                            const MatingTrialOptions& options) {
  ASSAY_CHECK(CanStart(problem, setting, strategy), "errors with which no trial can begin");
  Trial trial(problem, scene, setting, options);
  if (const Progress failure =
          trial.Poise(trial.X_WorldFixed() * strategy.X_FixedStart * X_TipToolOf(setting))) {
    return trial.Result({failure->outcome, failure->reason});
  }
  HybridControl control(strategy, problem.mating(setting.mating).fixed, options.law,
                        trial.execution());
  StrategyEnd end = control.Run(options.observer);
  return trial.Result(std::move(end));
}

MatingResult RunStraightMating(const domain::Problem& problem, const scene::Scene& scene,
                               const MatingSetting& setting, const MatingTrialOptions& options) {
  Trial trial(problem, scene, setting, options);
  Execution& execution = trial.execution();
  const plan::Action assemble{.kind = &domain::kAssemble,
                              .mating = setting.mating,
                              .hold = setting.hold,
                              .place = {"", trial.X_WorldFixed()}};
  const StepCommands commands = CommandsFor(problem, execution.world(), assemble);
  const auto& start = std::get<MoveStraight>(commands.approach.back());
  const auto& advance = std::get<MoveStraight>(commands.advance.back());
  Progress failure = trial.Poise(start.X_WorldTool);
  if (!failure) failure = Run(advance, {}, execution);
  if (failure) return trial.Result({failure->outcome, failure->reason});
  MatingResult result = trial.Result({});
  const domain::Mating& mating = problem.mating(setting.mating);
  if (!SeatedDepth(problem, mating, result.X_FixedHeld).holds) {
    const plan::Strategy usual;
    result.end = {.outcome = TrialOutcome::kWrongContact, .reason = "resistance before the seat"};
    result.end.holding = TrueHolding(execution, mating.fixed, setting.X_HeldTip,
                                     mating.mating_vector.normalized(), usual.length);
  }
  return result;
}

}  // namespace assay::execution
