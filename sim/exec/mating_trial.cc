#include "sim/exec/mating_trial.h"

#include <limits>

#include "planner/base/check.h"
#include "sim/exec/action_commands.h"
#include "sim/exec/straight_line.h"
#include "sim/mujoco/contact.h"

namespace assay::exec {
namespace {

constexpr double kClosing = 0.2;   // seconds for the grip to build up
constexpr double kSeated = 0.001;  // metres
constexpr double kApart = 1e-4;    // metres that parts may overlap where they are put

// Everything that a trial needs, with the part in the hand.
class Trial {
 public:
  Trial(const domain::Problem& problem, const scene::Scene& scene, const MatingSetting& setting,
        const MatingTrialOptions& options)
      : mating_(problem.mating(setting.mating)),
        scene_(scene),
        setting_(setting),
        options_{.sample_rate = 0, .force_limit = options.law.force_limit},
        data_(scene.Start()),
        execution_(problem, scene, data_, options_) {
    scene.SetPart(data_, mating_.fixed, RestingPoses(problem, scene)[mating_.fixed.index()]);
    scene.Clamp(data_, mating_.fixed, kClampForce);
    execution_.world().Believe(mating_.fixed, scene.TruePose(data_, mating_.fixed));
  }

  // The hand, closed on the part, where it believes itself to be at X_WorldTool.
  Progress Poise(const Pose& X_WorldTool) {
    execution_.SetHandError(HandError());
    const Pose truly = execution_.Erring(X_WorldTool);
    if (!PlaceArm(truly)) return Failure{ExecutionOutcome::kUnreachable, "the arm cannot start"};
    scene_.SetGripper(data_, setting_.hold.width);
    scene_.SetPart(data_, mating_.held, truly * setting_.hold.X_PartTool.inverse());
    data_.Forward();
    for (const auto& contact :
         mujoco::ContactsBetween(data_, scene_.Body(mating_.fixed), scene_.Body(mating_.held))) {
      if (contact.distance < -kApart)
        return Failure{ExecutionOutcome::kOverload, "the parts overlap where it is to start"};
    }
    scene_.CommandGripper(data_, 0);
    scene_.AttachPart(data_, mating_.held);
    execution_.world().Take(mating_.held, setting_.hold);
    return execution_.Stay(kClosing, Stepping::kContact);
  }

  Execution& execution() { return execution_; }
  Pose X_WorldFixed() const { return execution_.world().PartPose(mating_.fixed); }

  MatingResult Result(StrategyEnd end) const {
    const bool was_taken = !execution_.world().held().IsNone();
    if (end.outcome != MatingOutcome::kEngineWarning && was_taken && !execution_.IsInHand())
      end.outcome = MatingOutcome::kDropped;
    return {.end = std::move(end),
            .duration = data_.time(),
            .greatest_force = execution_.greatest_force(),
            .X_FixedHeld = scene_.TruePose(data_, mating_.fixed).inverse() *
                           scene_.TruePose(data_, mating_.held)};
  }

 private:
  Pose HandError() const {
    Pose displaced = geometry::Translation(setting_.d);
    const double angle = setting_.w.norm();
    if (angle > 0) displaced.rotate(Eigen::AngleAxisd(angle, setting_.w / angle));
    const Pose X_TipTool = setting_.X_HeldTip.inverse() * setting_.hold.X_PartTool;
    return X_TipTool.inverse() * displaced * X_TipTool;
  }

  // Of the arm's configurations that which is nearest to the workcell's home.
  bool PlaceArm(const Pose& X_WorldTool) {
    const domain::Workcell& workcell = *execution_.problem().workcell;
    std::optional<JointVector> nearest;
    for (const auto& s : workcell.arm().Inverse(workcell.FlangeFor(X_WorldTool), workcell.home())) {
      const auto q = workcell.arm().NearestInRange(s.q, workcell.home());
      if (!q) continue;
      const auto turn = [&](const JointVector& to) { return (to - workcell.home()).norm(); };
      if (!nearest || turn(*q) < turn(*nearest)) nearest = *q;
    }
    if (nearest) execution_.Place(*nearest);
    return nearest.has_value();
  }

  const domain::Mating& mating_;
  const scene::Scene& scene_;
  const MatingSetting& setting_;
  ExecutorOptions options_;
  mujoco::Data data_;
  Execution execution_;
};

}  // namespace

MatingResult RunMatingTrial(const domain::Problem& problem, const scene::Scene& scene,
                            const MatingSetting& setting, const plan::Strategy& strategy,
                            const MatingTrialOptions& options) {
  Trial trial(problem, scene, setting, options);
  const Pose X_TipTool = strategy.X_HeldTip.inverse() * setting.hold.X_PartTool;
  if (const Progress failure =
          trial.Poise(trial.X_WorldFixed() * strategy.X_FixedStart * X_TipTool)) {
    return trial.Result({OutcomeOf(failure->outcome), failure->reason});
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
  const plan::Assemble assemble{setting.mating, setting.hold, {"", trial.X_WorldFixed()}};
  const StepCommands commands = CommandsFor(problem, execution.world(), assemble);
  const auto& start = std::get<MoveStraight>(commands.approach.back());
  const auto& advance = std::get<MoveStraight>(commands.advance.back());
  Progress failure = trial.Poise(start.X_WorldTool);
  if (!failure) failure = Run(advance, {}, execution);
  if (failure) return trial.Result({OutcomeOf(failure->outcome), failure->reason});
  MatingResult result = trial.Result({});
  const domain::Mating& mating = problem.mating(setting.mating);
  const Vector3 short_by = mating.X_FixedHeld.translation() - result.X_FixedHeld.translation();
  if (std::abs(short_by.dot(mating.mating_vector.normalized())) > kSeated) {
    const plan::Strategy usual;
    result.end = {.outcome = MatingOutcome::kWrongContact, .reason = "resistance before the seat"};
    result.end.holding = TrueHolding(execution, mating.fixed, setting.X_HeldTip,
                                     mating.mating_vector.normalized(), usual.length);
  }
  return result;
}

}  // namespace assay::exec
