#include "sim/check/noise_floor/measure_noise_floor.h"

#include <algorithm>
#include <cmath>

#include "sim/check/certificate_claims/certificate_check.h"
#include "sim/check/noise_floor/confirmation.h"
#include "sim/execution/walk/executor.h"
#include "sim/execution/walk/step_execution.h"
#include "sim/mujoco/contact.h"

namespace assay::check {
namespace {

constexpr double kHold = 0.1;  // seconds that a hand is kept still

// An execution of the plan without noise, as far as it comes.
class NoiselessExecution {
 public:
  NoiselessExecution(const domain::Problem& problem, const plan::Plan& plan,
                     const scene::SceneOptions& options)
      : problem_(problem),
        plan_(plan),
        scene_(problem, options),
        data_(execution::StartOf(problem, scene_, {})),
        execution_(problem, scene_, data_, options_),
        penetrations_(plan.steps.size()) {}

  void Run(bool holds_still) {
    execution_.trace().events.emplace_back(execution::ExecutionStart{execution_.Now()});
    for (const plan::StepId id : plan_.ExecutionOrder()) {
      execution::StepExecution step(plan_, id, execution_);
      if (step.Approach()) return;
      if (holds_still) HoldStill(id);
      if (step.Attempt()) return;
      // Pads that squeeze a part leave it where they held it.
      if (holds_still && plan_.step(id).action.Is(domain::kSqueeze)) HoldStill(id);
      if (step.Complete()) return;
      if (holds_still) HoldStill(id);
    }
  }

  const execution::Trace& trace() { return execution_.trace(); }
  double penetration(plan::StepId id) const { return penetrations_[id.index()]; }
  std::vector<Claim> Claims() { return CheckCertificates(problem_, plan_, trace(), {}); }

 private:
  void HoldStill(plan::StepId id) {
    const execution::Checkpoint checkpoint = execution_.Save();
    const double end = data_.time() + kHold;
    do {
      LookForDeepest(penetrations_[id.index()]);
    } while (data_.time() < end && !execution_.Stay(0));
    execution_.Restore(checkpoint);
  }

  void LookForDeepest(double& penetration) const {
    for (const mujoco::Contact& contact : mujoco::Contacts(data_)) {
      penetration = std::max(penetration, -contact.distance);
    }
  }

  const domain::Problem& problem_;
  const plan::Plan& plan_;
  execution::ExecutorOptions options_ = {.sample_rate = 0};
  scene::Scene scene_;
  mujoco::Data data_;
  execution::Execution execution_;
  std::vector<double> penetrations_;  // by StepId, metres
};

// Returns by how much the timestep changes what is observed. If another case of a precondition
// decides it then, whose prediction differs, their margins are compared.
double ChangeFrom(const Claim& fine, const Claim& coarse) {
  const bool is_same_case =
      fine.predicted.low == coarse.predicted.low && fine.predicted.high == coarse.predicted.high;
  return is_same_case ? coarse.observed - fine.observed : coarse.margin - fine.margin;
}

void AddComponent(const Claim& coarse, const std::vector<Claim>& fine, StepNoiseFloor& gate) {
  if (!coarse.dimension) return;
  const auto same = std::ranges::find_if(fine, [&](const Claim& c) { return IsSame(c, coarse); });
  const double change = same == fine.end() ? 0 : ChangeFrom(*same, coarse);
  const bool of_set = coarse.about != Claimed::kPrecondition;
  gate.components.push_back({coarse.about, coarse.name, of_set ? coarse.observed : 0, change});
}

// Without noise the hand should be at its commanded pose, so its error is the arm's lag.
void AddLag(const execution::Snapshot& snapshot, StepNoiseFloor& gate) {
  const geometry::Pose off = snapshot.tool.believed.inverse() * snapshot.tool.truth;
  gate.lag = std::max(gate.lag, off.translation().norm());
  gate.lag_turn = std::max(gate.lag_turn, std::abs(Eigen::AngleAxisd(off.rotation()).angle()));
}

}  // namespace

NoiseFloor MeasureNoiseFloor(const domain::Problem& problem, const plan::Plan& plan,
                             const scene::SceneOptions& options) {
  NoiselessExecution coarse(problem, plan, options);
  coarse.Run(true);
  NoiselessExecution fine(problem, plan, Finer(options));
  fine.Run(false);
  NoiseFloor gate;
  gate.steps.resize(plan.steps.size());
  for (std::size_t i = 0; i < gate.steps.size(); ++i) {
    gate.steps[i].arm = problem.workcell->gripper().pad_half_extents().minCoeff();
    gate.steps[i].penetration = coarse.penetration(plan::StepId(i));
  }
  const std::vector<Claim> with_half = fine.Claims();
  for (const Claim& claim : coarse.Claims()) {
    AddComponent(claim, with_half, gate.steps[claim.step.index()]);
  }
  for (const execution::Milestone* milestone : coarse.trace().All<execution::Milestone>()) {
    AddLag(milestone->snapshot, gate.steps[milestone->step.index()]);
  }
  for (const execution::StepEnd* end : coarse.trace().All<execution::StepEnd>()) {
    AddLag(end->snapshot, gate.steps[end->step.index()]);
  }
  return gate;
}

}  // namespace assay::check
