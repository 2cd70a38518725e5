#include "sim/noise/error_box.h"

#include <fmt/format.h>

#include <cmath>

#include "planner/base/check.h"
#include "planner/domain/problem/possible_starts.h"

namespace assay::noise {
namespace {

constexpr Interval kNothing = {0, 0};
constexpr char kClearance[] = "clearance";
constexpr char kFriction[] = "friction";
constexpr char kPadFriction[] = "pad_friction";
constexpr char kHand[] = "hand";
constexpr char kSensed[] = "sensed";

class BoxBuilder {
 public:
  explicit BoxBuilder(const domain::Problem& problem) : problem_(problem) {}

  std::vector<Channel> Take() { return std::move(box_); }

  void AddStart() {
    for (std::size_t p = 0; p < problem_.parts.size(); ++p) {
      const domain::PoseError& error = problem_.parts[p].error;
      AddPart(plan::error::kX, Effect::kPartX, p, error.x);
      AddPart(plan::error::kY, Effect::kPartY, p, error.y);
      if (domain::CarrierAtStart(problem_, PartId(p)) == PartId(p)) {
        AddPart(plan::error::kZ, Effect::kTableHeight, p, error.z);
      }
      AddPart(plan::error::kTheta, Effect::kPartYaw, p, error.theta);
    }
    const domain::Tolerances& tolerances = problem_.tolerances;
    AddWhole(kClearance, Effect::kClearance, tolerances.clearance);
    AddWhole(kFriction, Effect::kFriction, tolerances.friction);
    AddWhole(kPadFriction, Effect::kPadFriction, tolerances.pad_friction);
  }

  void AddStep(const plan::PlannedStep& step, StepId id) {
    step_ = &step;
    id_ = id;
    const plan::Action& action = step.action;
    if (action.kind->Has(domain::Argument::kSensor)) return AddSensor(action);
    AddHand();
    if (action.kind->leaves != domain::Leaves::kAtPlace) return;
    const domain::Part& part = problem_.part(action.part);
    AddAtStep(plan::error::kZ, part.name, Effect::kTableHeight, action.part, part.error.z);
  }

 private:
  void AddSensor(const plan::Action& look) {
    const domain::SensorModel* sensor =
        problem_.workcell->uncertainty_operations().FindSensor(look.sensor);
    ASSAY_CHECK(sensor != nullptr, "the workcell has no sensor '{}'", look.sensor);
    AddAtStep(plan::error::kX, kSensed, Effect::kSensedX, look.part, Measured(sensor->x));
    AddAtStep(plan::error::kY, kSensed, Effect::kSensedY, look.part, Measured(sensor->y));
    AddAtStep(plan::error::kZ, kSensed, Effect::kSensedZ, look.part, Measured(sensor->z));
    AddAtStep(plan::error::kTheta, kSensed, Effect::kSensedYaw, look.part, Measured(sensor->theta));
  }

  // A coordinate that a sensor does not measure has no error of measurement.
  static Interval Measured(const Interval& promise) {
    return std::isfinite(promise.low) && std::isfinite(promise.high) ? promise : kNothing;
  }

  void Add(Channel channel) {
    if (channel.range == kNothing) return;
    box_.push_back(std::move(channel));
  }
  void AddPart(const plan::ErrorKind& kind, Effect effect, std::size_t part,
               const Interval& range) {
    Add({.name = fmt::format("{}_{}", kind.stem, problem_.parts[part].name),
         .effect = effect,
         .part = PartId(part),
         .range = range});
  }
  void AddWhole(const char* name, Effect effect, double half_width) {
    Add({.name = name, .effect = effect, .range = {-half_width, half_width}});
  }
  void AddAtStep(const plan::ErrorKind& kind, const std::string& of, Effect effect, PartId part,
                 const Interval& range) {
    Add({.name = fmt::format("{}_{}@{}", kind.stem, of, step_->name),
         .effect = effect,
         .part = part,
         .step = id_,
         .range = range});
  }
  void AddHand() {
    const domain::PoseError& error = problem_.gripper_error;
    AddAtStep(plan::error::kX, kHand, Effect::kHandX, PartId::None(), error.x);
    AddAtStep(plan::error::kY, kHand, Effect::kHandY, PartId::None(), error.y);
    AddAtStep(plan::error::kZ, kHand, Effect::kHandZ, PartId::None(), error.z);
    AddAtStep(plan::error::kTheta, kHand, Effect::kHandYaw, PartId::None(), error.theta);
  }

  const domain::Problem& problem_;
  const plan::PlannedStep* step_ = nullptr;
  StepId id_;
  std::vector<Channel> box_;
};

}  // namespace

domain::Dimension DimensionOf(Effect effect) {
  switch (effect) {
    case Effect::kPartX:
    case Effect::kPartY:
    case Effect::kTableHeight:
    case Effect::kHandX:
    case Effect::kHandY:
    case Effect::kHandZ:
    case Effect::kSensedX:
    case Effect::kSensedY:
    case Effect::kSensedZ:
    case Effect::kClearance:
      return domain::Dimension::kLength;
    case Effect::kPartYaw:
    case Effect::kHandYaw:
    case Effect::kSensedYaw:
      return domain::Dimension::kAngle;
    case Effect::kFriction:
    case Effect::kPadFriction:
      return domain::Dimension::kRatio;
  }
  ASSAY_CHECK(false, "an effect that the switch does not know");
  return domain::Dimension::kRatio;
}

domain::Dimension DimensionOfChannel(std::string_view name) {
  if (const plan::ErrorKind* kind = plan::ErrorKindOf(name)) return kind->dimension;
  return DimensionOf(name == kClearance ? Effect::kClearance : Effect::kFriction);
}

std::vector<Channel> ErrorBox(const domain::Problem& problem, const plan::Plan& plan) {
  BoxBuilder builder(problem);
  builder.AddStart();
  for (const StepId id : plan.ExecutionOrder()) builder.AddStep(plan.step(id), id);
  return builder.Take();
}

}  // namespace assay::noise
