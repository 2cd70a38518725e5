#include "sim/noise/error_box.h"

#include <cmath>

#include "planner/base/check.h"

namespace assay::noise {
namespace {

constexpr Interval kNothing = {0, 0};

class BoxBuilder {
 public:
  explicit BoxBuilder(const domain::Problem& problem) : problem_(problem) {}

  std::vector<Channel> Take() { return std::move(box_); }

  void AddStart() {
    for (std::size_t p = 0; p < problem_.parts.size(); ++p) {
      const domain::PoseError& error = problem_.parts[p].error;
      AddPart("dx", Effect::kPartX, p, error.x);
      AddPart("dy", Effect::kPartY, p, error.y);
      AddPart("dz", Effect::kTableHeight, p, error.z);
      AddPart("theta", Effect::kPartYaw, p, error.theta);
    }
    const domain::Tolerances& tolerances = problem_.tolerances;
    AddWhole("clearance", Effect::kClearance, tolerances.clearance);
    AddWhole("friction", Effect::kFriction, tolerances.friction);
    AddWhole("pad_friction", Effect::kPadFriction, tolerances.pad_friction);
  }

  void AddStep(const plan::PlannedStep& step, StepId id) {
    step_ = &step;
    id_ = id;
    const plan::Action& action = step.action;
    if (action.kind->Has(domain::Argument::kSensor)) return AddSensor(action);
    AddHand();
    if (action.kind->leaves != domain::Leaves::kAtPlace) return;
    const domain::Part& part = problem_.part(action.part);
    AddAtStep("dz_" + part.name, Effect::kTableHeight, action.part, part.error.z);
  }

 private:
  void AddSensor(const plan::Action& look) {
    const domain::SensorModel* sensor =
        problem_.workcell->uncertainty_operations().FindSensor(look.sensor);
    ASSAY_CHECK(sensor != nullptr, "the workcell has no sensor '{}'", look.sensor);
    AddAtStep("dx_sensed", Effect::kSensedX, look.part, Measured(sensor->x));
    AddAtStep("dy_sensed", Effect::kSensedY, look.part, Measured(sensor->y));
    AddAtStep("dz_sensed", Effect::kSensedZ, look.part, Measured(sensor->z));
    AddAtStep("theta_sensed", Effect::kSensedYaw, look.part, Measured(sensor->theta));
  }

  // A coordinate that a sensor does not measure has no error of measurement.
  static Interval Measured(const Interval& promise) {
    return std::isfinite(promise.low) && std::isfinite(promise.high) ? promise : kNothing;
  }

  void Add(Channel channel) {
    if (channel.range == kNothing) return;
    box_.push_back(std::move(channel));
  }
  void AddPart(const char* what, Effect effect, std::size_t part, const Interval& range) {
    Add({.name = std::string(what) + "_" + problem_.parts[part].name,
         .effect = effect,
         .part = PartId(part),
         .range = range});
  }
  void AddWhole(const char* name, Effect effect, double half_width) {
    Add({.name = name, .effect = effect, .range = {-half_width, half_width}});
  }
  void AddAtStep(const std::string& what, Effect effect, PartId part, const Interval& range) {
    Add({.name = what + "@" + step_->name,
         .effect = effect,
         .part = part,
         .step = id_,
         .range = range});
  }
  void AddHand() {
    const domain::PoseError& error = problem_.gripper_error;
    AddAtStep("dx_hand", Effect::kHandX, PartId::None(), error.x);
    AddAtStep("dy_hand", Effect::kHandY, PartId::None(), error.y);
    AddAtStep("dz_hand", Effect::kHandZ, PartId::None(), error.z);
    AddAtStep("theta_hand", Effect::kHandYaw, PartId::None(), error.theta);
  }

  const domain::Problem& problem_;
  const plan::PlannedStep* step_ = nullptr;
  StepId id_;
  std::vector<Channel> box_;
};

}  // namespace

std::vector<Channel> ErrorBox(const domain::Problem& problem, const plan::Plan& plan) {
  BoxBuilder builder(problem);
  builder.AddStart();
  for (const StepId id : plan.ExecutionOrder()) builder.AddStep(plan.step(id), id);
  return builder.Take();
}

}  // namespace assay::noise
