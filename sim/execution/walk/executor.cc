#include "sim/execution/walk/executor.h"

#include <algorithm>
#include <cmath>

#include "planner/geometry/pose.h"
#include "sim/execution/commands/action_commands.h"
#include "sim/execution/commands/run.h"
#include "sim/execution/walk/step_execution.h"
#include "sim/noise/possible_start.h"

namespace assay::execution {
namespace {

constexpr double kRestDuration = 0.5;  // seconds during which speeds at rest are recorded
constexpr double kSettling = 0.25;     // seconds for the parts to settle
constexpr double kBeforeRest = 0.1;    // seconds for the change to small timesteps

Progress RunPlan(const plan::Plan& plan, Execution& execution) {
  for (const plan::StepId id : plan.ExecutionOrder()) {
    StepExecution step(plan, id, execution);
    if (Progress failure = step.Approach()) return failure;
    if (Progress failure = step.Work()) return failure;
    if (id == execution.options().last) return std::nullopt;
  }
  const auto run = [&](const auto& command) { return Run(command, {}, execution); };
  if (Progress failure = std::visit(run, HomingOf(execution.problem(), plan))) return failure;
  RestRecord rest;
  if (Progress failure = Rest(execution, rest)) return failure;
  execution.trace().events.emplace_back(rest);
  return std::nullopt;
}

}  // namespace

scene::SceneOptions TrueScene(scene::SceneOptions options, const noise::Noise& noise) {
  options.clearance_error += noise.Of(noise::Effect::kClearance);
  options.friction_error += noise.Of(noise::Effect::kFriction);
  options.pad_friction_error += noise.Of(noise::Effect::kPadFriction);
  return options;
}

std::vector<Pose> RestingPoses(const domain::Problem& problem, const scene::Scene& scene) {
  mujoco::Data data = scene.Start();
  while (data.time() < kSettling) data.Step();
  std::vector<Pose> poses;
  for (std::size_t p = 0; p < problem.parts.size(); ++p) {
    const Pose& placed = problem.parts[p].X_WorldPart;
    const Pose settled = scene.TruePose(data, PartId(p));
    const geometry::Matrix3 turn = placed.linear() * settled.linear().transpose();
    Pose X_WorldPart =
        geometry::RotationZ(std::atan2(turn(1, 0) - turn(0, 1), turn(0, 0) + turn(1, 1))) * settled;
    X_WorldPart.translation() = placed.translation();
    X_WorldPart.translation().z() = settled.translation().z();
    poses.push_back(X_WorldPart);
  }
  return poses;
}

void PlaceAtStart(const domain::Problem& problem, const scene::Scene& scene,
                  const std::vector<Pose>& resting, const noise::Noise& noise,
                  const std::vector<PartId>& parts, mujoco::Data& data) {
  const std::vector<Pose> truly = noise::TruePoses(problem, noise, resting);
  for (const PartId part : parts) {
    scene.SetTableHeight(data, part, noise::HeightAtStart(problem, noise, part));
    scene.SetPart(data, part, truly[part.index()]);
  }
}

mujoco::Data StartOf(const domain::Problem& problem, const scene::Scene& scene,
                     const noise::Noise& noise) {
  std::vector<PartId> parts;
  for (std::size_t p = 0; p < problem.parts.size(); ++p) parts.emplace_back(p);
  mujoco::Data data = scene.Start();
  PlaceAtStart(problem, scene, RestingPoses(problem, scene), noise, parts, data);
  return data;
}

Progress Rest(Execution& execution, RestRecord& rest) {
  const scene::Scene& scene = execution.scene();
  mujoco::Data& data = execution.data();
  if (Progress failure = execution.Stay(kBeforeRest)) return failure;
  rest.duration = kRestDuration;
  rest.parts.resize(static_cast<std::size_t>(scene.part_count()));
  return execution.Stay(kRestDuration, [&] {
    for (std::size_t i = 0; i < rest.parts.size(); ++i) {
      const scene::Twist twist = scene.TrueTwist(data, PartId(i));
      rest.parts[i].linear = std::max(rest.parts[i].linear, twist.linear.norm());
      rest.parts[i].angular = std::max(rest.parts[i].angular, twist.angular.norm());
    }
  });
}

Trace Execute(const domain::Problem& problem, const plan::Plan& plan, const scene::Scene& scene,
              mujoco::Data& data, const ExecutorOptions& options) {
  Execution execution(problem, scene, data, options);
  execution.trace().events.emplace_back(ExecutionStart{execution.Now()});
  if (options.observer != nullptr) options.observer->SeeStart(data);
  const Progress failure = RunPlan(plan, execution);
  ExecutionEnd end{.snapshot = execution.Now(), .steps = execution.steps()};
  if (failure) {
    end.outcome = failure->outcome;
    end.reason = failure->reason;
  }
  execution.trace().events.push_back(end);
  return std::move(execution.trace());
}

}  // namespace assay::execution
