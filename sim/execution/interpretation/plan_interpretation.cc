#include "sim/execution/interpretation/plan_interpretation.h"

#include <fmt/format.h>

#include <algorithm>

#include "planner/assembly/open_poses.h"
#include "planner/base/check.h"
#include "planner/geometry/pose.h"
#include "sim/sense/displacement.h"

namespace assay::execution {
namespace {

using assembly::KnowledgeAction;
using Planned = std::shared_ptr<const PlannedWorlds>;

double AngleBetween(const Pose& a, const Pose& b) {
  return Eigen::AngleAxisd(geometry::Matrix3(a.linear().transpose() * b.linear())).angle();
}

// Returns whether a sensor can measure this deviation. `error` bounds the true deviation and
// `promise` bounds the sensor's error.
bool IsWithin(double measured, const Interval& error, const Interval& promise) {
  return error.low - promise.high <= measured && measured <= error.high - promise.low;
}

class PlanSkill : public Skill {
 public:
  PlanSkill(Planned planned, const KnowledgeAction& action)
      : planned_(std::move(planned)), action_(action) {}

  std::string Lacks(const Roles&) const override { return {}; }
  HeldTouches HeldMayTouch() const override { return HeldTouches::kAnything; }

 protected:
  const PlannedWorlds& planned() const { return *planned_; }
  const KnowledgeAction& action() const { return action_; }
  const plan::Plan& plan() const { return planned_->assembly.plans[action_.plan].plan; }

  bool IsVerified() const {
    return std::ranges::count(plan().verifications, action_.step, &plan::Verification::step) > 0;
  }

 private:
  Planned planned_;
  KnowledgeAction action_;
};

// Looks for the part in each pose that it may have. A pose counts as found if the part is seen no
// farther from it than the errors of part and sensor allow. If exactly one pose is found, the part
// has that pose, and its believed pose is the one that the camera measured.
class LookForPose : public PlanSkill {
 public:
  using PlanSkill::PlanSkill;

  Progress Do(const Roles&, Situation& situation) const override {
    if (Progress failure = situation.robots.GoHome()) return failure;
    Execution& execution = situation.execution();
    std::vector<assembly::NamedPose> found;
    for (const auto& [name, believed] : assembly::PosesOf(planned().worlds, action().part)) {
      const auto seen = situation.pose_sensor->Measure(execution.data(), action().part, believed);
      if (seen && IsPossible(believed, *seen)) found.push_back({name, *seen});
    }
    situation.readings.poses.erase(action().part);
    if (found.size() != 1) return std::nullopt;
    situation.readings.poses[action().part] = found.front().name;
    execution.world().Believe(action().part, found.front().X_WorldPart);
    return std::nullopt;
  }

 private:
  bool IsPossible(const Pose& believed, const Pose& seen) const {
    const domain::Problem& first = planned().worlds.front();
    const domain::PoseError& error = first.part(action().part).error;
    const auto& sensor = *first.workcell->uncertainty_operations().FindSensor(action().sensor);
    const sense::Displacement off = sense::Between(believed, seen);
    return IsWithin(off[0], error.x, sensor.x) && IsWithin(off[1], error.y, sensor.y) &&
           IsWithin(off[3], error.theta, sensor.theta);
  }
};

// Executes a step of a plan. A step without a verification is finished at once. A step with a
// verification leaves the tool in place until the verification is done.
class DoStep : public PlanSkill {
 public:
  using PlanSkill::PlanSkill;

  Progress Do(const Roles&, Situation& situation) const override {
    situation.step = std::make_unique<StepExecution>(plan(), action().step, situation.execution());
    if (Progress failure = situation.step->Approach()) return failure;
    if (Progress failure = situation.step->Attempt()) return failure;
    return IsVerified() ? std::nullopt : situation.step->Finish();
  }
};

class Verify : public PlanSkill {
 public:
  using PlanSkill::PlanSkill;

  Progress Do(const Roles&, Situation& situation) const override {
    const std::string error = situation.step->Verify();
    situation.readings.errors[action().name] = error;
    return error.empty() ? situation.step->Finish() : std::nullopt;
  }
};

// Names the error. It does nothing, because the verification has measured already.
class Diagnose : public PlanSkill {
 public:
  using PlanSkill::PlanSkill;
  Progress Do(const Roles&, Situation&) const override { return std::nullopt; }
};

class Recover : public PlanSkill {
 public:
  using PlanSkill::PlanSkill;

  Progress Do(const Roles&, Situation& situation) const override {
    situation.readings.errors.erase(action().name);
    return situation.step->TryAgain(action().error);
  }
};

class CallOperator : public PlanSkill {
 public:
  using PlanSkill::PlanSkill;

  Progress Do(const Roles&, Situation&) const override {
    return Failure{TrialOutcome::kOperatorCalled, action().error};
  }
};

std::unique_ptr<const Skill> SkillOf(const Planned& planned, const KnowledgeAction& action) {
  using Kind = KnowledgeAction::Kind;
  switch (action.kind) {
    case Kind::kLook:
      return std::make_unique<LookForPose>(planned, action);
    case Kind::kStep:
      return std::make_unique<DoStep>(planned, action);
    case Kind::kVerify:
      return std::make_unique<Verify>(planned, action);
    case Kind::kDiagnose:
      return std::make_unique<Diagnose>(planned, action);
    case Kind::kRecover:
      return std::make_unique<Recover>(planned, action);
    case Kind::kOperator:
      return std::make_unique<CallOperator>(planned, action);
  }
  ASSAY_CHECK(false, "an action that the switch does not know");
  return nullptr;
}

// The meaning of pose(part) = name.
class IsPosed : public Predicate {
 public:
  explicit IsPosed(Planned planned) : planned_(std::move(planned)) {}

  bool IsTrue(const Truth& truth, const Roles& roles) const override {
    const PartId part = PartOf(roles);
    const Pose X_WorldPart = truth.scene.TruePose(truth.data, part);
    const auto poses = assembly::PosesOf(planned_->worlds, part);
    const auto nearest = std::ranges::min_element(poses, {}, [&](const auto& named) {
      return AngleBetween(named.X_WorldPart, X_WorldPart) +
             (named.X_WorldPart.translation() - X_WorldPart.translation()).norm();
    });
    return nearest->name == PoseOf(roles);
  }
  bool IsObservable() const override { return true; }
  std::optional<bool> Observed(const Readings& readings, const Roles& roles) const override {
    const auto found = readings.poses.find(PartOf(roles));
    if (found == readings.poses.end()) return std::nullopt;
    return found->second == PoseOf(roles);
  }
  std::optional<bool> IsTrueIn(const HiddenWorld& world, const Roles& roles) const override {
    const auto& open = planned_->worlds[world.world].open_poses;
    const auto found = std::ranges::find(open, PartOf(roles), &domain::OpenPose::part);
    if (found == open.end()) return std::nullopt;
    return found->names[found->chosen] == PoseOf(roles);
  }

 private:
  // The task's symbols stand for names of the scenario.
  PartId PartOf(const Roles& roles) const {
    const std::vector<domain::Part>& parts = planned_->worlds.front().parts;
    const std::string& name = planned_->assembly.knowledge.names.at(roles.symbols.front());
    const auto found = std::ranges::find(parts, name, &domain::Part::name);
    return PartId(static_cast<std::size_t>(found - parts.begin()));
  }
  const std::string& PoseOf(const Roles& roles) const {
    return planned_->assembly.knowledge.names.at(roles.symbols.back());
  }

  Planned planned_;
};

// A predicate of a step, which the task names "plan1-action_2".
class OfStep : public Predicate {
 public:
  explicit OfStep(Planned planned) : planned_(std::move(planned)) {}

 protected:
  const plan::Plan& PlanOf(const Roles& roles) const {
    return planned_->assembly.plans[ActionOf(roles).plan].plan;
  }
  plan::StepId StepOf(const Roles& roles) const { return ActionOf(roles).step; }
  // Returns the error by its name in the workcell.
  const std::string& ErrorOf(const Roles& roles) const {
    return planned_->assembly.knowledge.names.at(roles.symbols.back());
  }

 private:
  const KnowledgeAction& ActionOf(const Roles& roles) const {
    return planned_->assembly.knowledge.actions.at(roles.symbols.front());
  }

  Planned planned_;
};

class Passed : public OfStep {
 public:
  using OfStep::OfStep;

  bool IsTrue(const Truth&, const Roles&) const override {
    ASSAY_CHECK(false, "no audit asks what was told");
    return false;
  }
  bool IsAudited() const override { return false; }
  bool IsObservable() const override { return true; }
  std::optional<bool> Observed(const Readings& readings, const Roles& roles) const override {
    const auto found = readings.errors.find(roles.symbols.front());
    if (found == readings.errors.end()) return std::nullopt;
    return found->second.empty();
  }
  // The action is expected to fail only if the world's fault is in this action.
  std::optional<bool> IsTrueIn(const HiddenWorld& world, const Roles& roles) const override {
    return !world.fault || world.fault->action != roles.symbols.front();
  }
};

class Signals : public OfStep {
 public:
  using OfStep::OfStep;

  bool IsTrue(const Truth& truth, const Roles& roles) const override {
    return std::ranges::any_of(PlanOf(roles).verifications, [&](const auto& check) {
      if (check.step != StepOf(roles)) return false;
      const double off = Measured(truth, check.quantity) - check.expected;
      return (off < -check.tolerance && check.below == ErrorOf(roles)) ||
             (off > check.tolerance && check.above == ErrorOf(roles));
    });
  }
  bool IsObservable() const override { return true; }
  std::optional<bool> Observed(const Readings& readings, const Roles& roles) const override {
    const auto found = readings.errors.find(roles.symbols.front());
    if (found == readings.errors.end()) return std::nullopt;
    return found->second == ErrorOf(roles);
  }
  std::optional<bool> IsTrueIn(const HiddenWorld& world, const Roles& roles) const override {
    return world.fault && world.fault->action == roles.symbols.front() &&
           world.fault->error == ErrorOf(roles);
  }

 private:
  static double Measured(const Truth& truth, domain::MeasuredQuantity quantity) {
    return quantity == domain::MeasuredQuantity::kGripperOpening
               ? truth.scene.Opening(truth.data)
               : truth.scene.ToolPose(truth.data).translation().z();
  }
};

}  // namespace

Interpretation InterpretationOf(Planned planned) {
  Interpretation interpretation;
  interpretation.task = planned->assembly.knowledge.task;
  for (const auto& [name, action] : planned->assembly.knowledge.actions) {
    interpretation.skills[name] = SkillOf(planned, action);
  }
  interpretation.predicates["pose"] = std::make_unique<IsPosed>(planned);
  interpretation.predicates["passed"] = std::make_unique<Passed>(planned);
  interpretation.predicates["signals"] = std::make_unique<Signals>(planned);
  interpretation.predicates["done"] = nullptr;
  interpretation.predicates["moved"] = nullptr;
  interpretation.predicates["operatorCalled"] = nullptr;
  interpretation.planned = std::move(planned);
  return interpretation;
}

}  // namespace assay::execution
