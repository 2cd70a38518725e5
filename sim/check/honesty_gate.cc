#include "sim/check/honesty_gate.h"

#include <algorithm>
#include <cmath>

#include "sim/check/confirmation.h"
#include "sim/check/observed_error.h"
#include "sim/exec/step_execution.h"
#include "sim/mujoco/contact.h"

namespace assay::check {
namespace {

constexpr double kHold = 0.5;  // seconds that a hand is kept still

// Of one step, without noise.
struct StepMeasurement {
  struct Error {
    Claimed about;
    ObservedError error;
    double turned = 0;  // what of the set's other displacements noise may turn into this one
  };
  std::vector<Error> errors;
  double duration = 0;      // seconds
  double creep = 0;         // m/s
  double penetration = 0;   // metres
  double force_ripple = 0;  // newtons
};

double Magnitude(const Interval& range) { return std::max(-range.low, range.high); }

// By how much noise may turn a part against where the plan has it, radians.
double GreatestTurn(const domain::Problem& problem) {
  double turn = 0;
  for (const domain::Part& part : problem.parts) turn = std::max(turn, Magnitude(part.error.theta));
  return turn + Magnitude(problem.gripper_error.theta);
}

double DistanceOff(const std::vector<ObservedError>& errors) {
  double squares = 0;
  for (const ObservedError& error : errors) {
    if (error.unit == "m") squares += error.observed * error.observed;
  }
  return std::sqrt(squares);
}

class NoiselessExecution {
 public:
  NoiselessExecution(const domain::Problem& problem, const plan::Plan& plan,
                     const scene::SceneOptions& options)
      : problem_(problem),
        plan_(plan),
        scene_(problem, options),
        data_(exec::StartOf(problem, scene_, {})),
        execution_(problem, scene_, data_, options_) {}

  // By StepId; empty for steps that were not reached.
  std::vector<StepMeasurement> Run(bool holds_still) {
    std::vector<StepMeasurement> measured(plan_.steps.size());
    for (const plan::StepId id : plan_.ExecutionOrder()) {
      const double start = data_.time();
      exec::StepExecution step(plan_, id, execution_);
      if (step.Approach()) break;
      StepMeasurement& m = measured[id.index()];
      Measure(Claimed::kBefore, plan_.step(id).certificate.before, id, m);
      if (step.Work()) break;
      Measure(Claimed::kAfter, plan_.step(id).certificate.after, id, m);
      m.duration = data_.time() - start;
      if (holds_still) HoldStill(m);
    }
    return measured;
  }

 private:
  void Measure(Claimed about, const std::vector<plan::ErrorSet>& sets, plan::StepId id,
               StepMeasurement& m) {
    const exec::Moment now = execution_.Now();
    for (const plan::ErrorSet& set : sets) {
      std::vector<ObservedError> errors = ObservedErrors(problem_, plan_.step(id).action, set, now);
      const double turned = GreatestTurn(problem_) * DistanceOff(errors);
      for (ObservedError& error : errors) {
        const bool is_displacement = error.unit == "m";
        m.errors.push_back({about, std::move(error), is_displacement ? turned : 0});
      }
    }
  }

  // A held part's place in the hand, else nothing.
  geometry::Vector3 Held() const {
    const domain::PartId part = execution_.world().held();
    if (part.IsNone()) return geometry::Vector3::Zero();
    return (scene_.ToolPose(data_).inverse() * scene_.TruePose(data_, part)).translation();
  }

  void HoldStill(StepMeasurement& m) {
    const exec::Checkpoint checkpoint = execution_.Save();
    const geometry::Vector3 before = Held();
    double sum = 0;
    double squares = 0;
    int count = 0;
    const double end = data_.time() + kHold;
    while (data_.time() < end) {
      if (execution_.Stay(0, exec::Stepping::kContact)) break;
      const double force = scene_.WristWrench(data_).force.norm();
      sum += force;
      squares += force * force;
      ++count;
      for (const mujoco::Contact& contact : mujoco::Contacts(data_)) {
        m.penetration = std::max(m.penetration, -contact.distance);
      }
    }
    m.creep = (Held() - before).norm() / kHold;
    m.force_ripple = std::sqrt(std::max(0.0, squares / count - sum / count * (sum / count)));
    execution_.Restore(checkpoint);
  }

  const domain::Problem& problem_;
  const plan::Plan& plan_;
  exec::ExecutorOptions options_ = {.sample_rate = 0};
  scene::Scene scene_;
  mujoco::Data data_;
  exec::Execution execution_;
};

StepGate GateOf(const StepMeasurement& coarse, const StepMeasurement& fine, double arm) {
  StepGate gate = {.components = {},
                   .arm = arm,
                   .creep = coarse.creep * coarse.duration,
                   .penetration = coarse.penetration,
                   .force_ripple = coarse.force_ripple};
  for (std::size_t i = 0; i < coarse.errors.size(); ++i) {
    const auto& [about, error, turned] = coarse.errors[i];
    const bool both = i < fine.errors.size();
    const double change = both ? std::abs(error.observed - fine.errors[i].error.observed) : 0;
    gate.components.push_back({about, error.name, std::abs(error.observed) + turned, change});
  }
  return gate;
}

}  // namespace

double StepGate::For(const Claim& claim) const {
  double gate = 0;
  for (const ComponentGate& component : components) {
    const bool same = component.about == claim.about && component.name == claim.name;
    const bool of_poses =
        claim.about == Claimed::kPrecondition && component.about == Claimed::kBefore;
    // Other loads and lever arms under noise change the offset, by as much as there is of it.
    if (same || of_poses) gate = std::max(gate, 2 * component.offset + component.step_size);
  }
  if (claim.unit == "m") return gate + creep + penetration;
  return claim.unit == "rad" ? gate + (creep + penetration) / arm : 0;
}

double HonestyGate::For(const Claim& claim) const {
  return steps.empty() ? 0 : steps[claim.step.index()].For(claim);
}

HonestyGate MeasureGate(const domain::Problem& problem, const plan::Plan& plan,
                        const scene::SceneOptions& options) {
  const auto coarse = NoiselessExecution(problem, plan, options).Run(true);
  const auto fine = NoiselessExecution(problem, plan, Finer(options)).Run(false);
  HonestyGate gate;
  const double arm = problem.workcell->gripper().pad_half_extents().minCoeff();
  for (std::size_t i = 0; i < coarse.size(); ++i) {
    gate.steps.push_back(GateOf(coarse[i], fine[i], arm));
  }
  return gate;
}

}  // namespace assay::check
