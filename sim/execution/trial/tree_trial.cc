#include "sim/execution/trial/tree_trial.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <numbers>

#include "planner/domain/parts/resting.h"
#include "sim/execution/commands/action_commands.h"
#include "sim/execution/interpretation/knowledge_scenario.h"
#include "sim/execution/interpretation/plan_interpretation.h"
#include "sim/execution/trial/goal_findings.h"
#include "sim/execution/walk/executor.h"
#include "sim/execution/walk/tilt_watch.h"
#include "sim/noise/sampling.h"
#include "sim/sense/overhead_camera.h"

namespace assay::execution {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

// One trial: its simulation, the walk through the tree, and the measurements of both.
class JudgedWalk {
 public:
  JudgedWalk(const KnowledgeScenario& scenario, const TrialWorld& trial,
             const TrialSettings& settings)
      : interpretation_(scenario.interpretation),
        problem_(ProblemOf(scenario, trial.world)),
        settings_(settings),
        random_(settings.seed, fmt::format("enactment {}", trial.number)),
        noise_(noise::Sample(problem_, noise::ErrorBox(problem_, PlanOf(trial.world)),
                             noise::Mode::kUniform, settings.seed, trial.number)),
        scene_(problem_, TrueScene(scenario.scenario.simulation.scene, trial.world)),
        data_(StartOf(problem_, scene_, noise_)),
        tilts_(scene_, data_),
        result_{.number = trial.number, .world = trial.world} {
    options_.sample_rate = settings.sample_rate;
    options_.noise = noise_;
    options_.on_timestep = [this](const mujoco::Data& data) { tilts_.Look(data); };
  }

  TreeTrial Run(const contingent::PlanTree& tree) {
    if (settings_.on_step_end) settings_.on_step_end({"", scene_, data_});
    std::optional<sense::OverheadCamera> camera;
    if (!problem_.open_poses.empty()) options_.sensor = &camera.emplace(scene_, problem_);
    Robots robots(problem_, scene_, data_, options_);
    Readings readings;
    std::optional<sense::ColorSensor> color_sensor;
    if (!interpretation_.colors.empty()) {
      color_sensor.emplace(scene_, problem_, interpretation_.colors);
    }
    Situation situation{.robots = robots,
                        .readings = readings,
                        .sensor_noise = random_,
                        .color_sensor = color_sensor ? &*color_sensor : nullptr,
                        .pose_sensor = options_.sensor};
    WalkOptions walk{.sensing_errors = settings_.sensing_errors, .random = &random_};
    if (result_.world.fault) {
      result_.fault = result_.world.fault->Text(problem_);
      walk.on_step_start = [this](const std::string& action) { Befall(action); };
    }
    if (settings_.on_step_end) {
      walk.on_step_end = [this](const WalkedStep& step) {
        settings_.on_step_end({step.action, scene_, data_});
      };
    }
    result_.walk = TreeWalk(interpretation_, tree, situation, walk).Go();
    if (IsAtRest(result_.walk.end)) ComeToRest(robots);
    result_.collisions = robots.Collisions();
    result_.duration = data_.time();
    Measure(robots);
    Judge();
    if (settings_.sample_rate > 0) KeepTrace(robots);
    return std::move(result_);
  }

 private:
  static const domain::Problem& ProblemOf(const KnowledgeScenario& scenario,
                                          const HiddenWorld& world) {
    const PlannedWorlds* const planned = scenario.interpretation.planned.get();
    return planned == nullptr ? scenario.scenario.problem : planned->worlds[world.world];
  }

  plan::Plan PlanOf(const HiddenWorld& world) const {
    return interpretation_.planned ? *interpretation_.planned->PlanOf(world.world) : plan::Plan{};
  }

  scene::SceneOptions TrueScene(scene::SceneOptions options, const HiddenWorld& world) const {
    options.part_masses = world.masses;
    for (const auto& [part, color] : world.colors) {
      const sense::Color& rgb = interpretation_.colors[color.index()].color;
      options.part_colors[part] << rgb, 1;
    }
    return execution::TrueScene(std::move(options), noise_);
  }

  // Returns whether the hand is free to move after this end of the walk. After an error it may be
  // in the middle of its work.
  static bool IsAtRest(TrialOutcome end) {
    return end != TrialOutcome::kStopped && end != TrialOutcome::kOperatorCalled;
  }

  void Befall(const std::string& action) {
    const Fault& fault = *result_.world.fault;
    if (action != fault.action) return;
    scene_.SetPart(data_, fault.part, fault.After(scene_.TruePose(data_, fault.part)));
  }

  // A robot that holds a part does not go home.
  void ComeToRest(Robots& robots) {
    Execution& execution = robots.acting();
    Progress failure;
    if (execution.world().held().IsNone()) failure = robots.GoHome();
    RestRecord rest;
    if (!failure) failure = Rest(execution, rest);
    if (!failure) {
      rest_ = rest;
      return;
    }
    result_.walk.end = TrialOutcome::kStopped;
    result_.walk.reason = "at the end: " + failure->reason;
  }

  void KeepTrace(Robots& robots) {
    result_.trace = robots.WholeTrace();
    if (rest_) result_.trace.events.emplace_back(*rest_);
    result_.trace.events.emplace_back(ExecutionEnd{
        .outcome = result_.outcome, .reason = result_.reason, .snapshot = robots.acting().Now()});
    result_.scene = scene_.options();
  }

  void Measure(Robots& robots) {
    const Truth truth{problem_, scene_, data_};
    if (interpretation_.planned) {
      MeasureGoals(robots);
    } else {
      result_.is_goal_true = Audit(interpretation_, problem_).IsGoalTrue(truth);
    }
    for (std::size_t i = 0; i < problem_.parts.size(); ++i) {
      const PartId part(i);
      MeasureTilt(truth, part);
      if (interpretation_.planned) continue;  // assembly plans turn parts on purpose
      const bool is_held = IsHeld(part);
      const Pose X_WorldPart = scene_.TruePose(data_, part);
      if (!is_held && StablePoseAt(problem_.part(part), X_WorldPart) != problem_.part(part).resting)
        result_.fallen.push_back(problem_.part(part).name);
    }
  }

  // Judges the goals of an assembly by the same rule as a plan without branches.
  void MeasureGoals(Robots& robots) {
    Trace trace = robots.WholeTrace();
    if (rest_) trace.events.emplace_back(*rest_);
    trace.events.emplace_back(ExecutionEnd{.snapshot = robots.acting().Now()});
    const std::vector<Finding> findings = GoalFindings(problem_, trace, {});
    const auto failed = std::ranges::find(findings, false, &Finding::holds);
    result_.is_goal_true = failed == findings.end();
    if (!result_.is_goal_true) why_missed_ = Text(*failed);
  }

  bool IsHeld(PartId part) const {
    for (std::size_t i = 0; i < problem_.workcell->robots().size(); ++i) {
      const scene::Scene scene = scene_.WorkedBy(RobotId(i));
      if (scene.Touching(data_, part, scene.left_finger())) return true;
    }
    return false;
  }

  void MeasureTilt(const Truth& truth, PartId part) {
    if (!interpretation_.CanSpill(truth, part)) return;
    const double tilt = tilts_.greatest(part);
    result_.greatest_tilt = std::max(result_.greatest_tilt, tilt);
    if (tilt > interpretation_.spill->beyond) result_.spilled.push_back(problem_.part(part).name);
  }

  void Judge() {
    const auto end = [&](TrialOutcome outcome, std::string reason) {
      result_.outcome = outcome;
      result_.reason = std::move(reason);
    };
    const Walk& walk = result_.walk;
    if (!walk.false_claims.empty()) {
      return end(TrialOutcome::kFalseClaim, ReasonOf(walk.false_claims.front()));
    }
    if (walk.end != TrialOutcome::kSucceeded) return end(walk.end, walk.reason);
    if (!result_.collisions.empty()) {
      return end(TrialOutcome::kCollided, ReasonOf(result_.collisions.front()));
    }
    if (!result_.spilled.empty()) {
      return end(TrialOutcome::kSpilled,
                 fmt::format("{} spilled: the greatest tilt was {:.2f} degrees",
                             fmt::join(result_.spilled, ", "), result_.greatest_tilt / kDegree));
    }
    if (!result_.fallen.empty()) {
      return end(TrialOutcome::kFallen, fmt::format("{} fell", fmt::join(result_.fallen, ", ")));
    }
    if (!result_.is_goal_true) return end(TrialOutcome::kMissed, why_missed_);
  }

  static std::string ReasonOf(const FalseClaim& claim) {
    return fmt::format("after step {} {} is claimed to be {} and is {}{}{}", claim.step, claim.atom,
                       claim.claimed, claim.is_true, claim.truth.empty() ? "" : ": ", claim.truth);
  }

  // The reason names the action during which the collision happened.
  std::string ReasonOf(const CollisionRecord& collision) const {
    const auto& steps = result_.walk.steps;
    const auto step = std::ranges::find_if(
        steps, [&](const WalkedStep& walked) { return collision.time <= walked.end; });
    return fmt::format("{}: {} touched {}", step == steps.end() ? "at the end" : step->action,
                       collision.robot, collision.other);
  }

  const Interpretation& interpretation_;
  const domain::Problem& problem_;
  const TrialSettings& settings_;
  RandomStream random_;
  noise::Noise noise_;
  scene::Scene scene_;
  mujoco::Data data_;
  TiltWatch tilts_;
  ExecutorOptions options_;
  std::optional<RestRecord> rest_;
  std::string why_missed_ = "the goal is not true";
  TreeTrial result_;
};

}  // namespace

bool TreeTrial::IsFailed() const {
  if (outcome == TrialOutcome::kOperatorCalled) return !world.fault;
  return outcome != TrialOutcome::kSucceeded;
}

std::string_view TreeTrial::OutcomeName() const {
  return outcome == TrialOutcome::kSucceeded ? "reached" : Name(outcome);
}

TreeTrial RunTrial(const KnowledgeScenario& scenario, const contingent::PlanTree& tree,
                   const TrialWorld& trial, const TrialSettings& settings) {
  return JudgedWalk(scenario, trial, settings).Run(tree);
}

}  // namespace assay::execution
