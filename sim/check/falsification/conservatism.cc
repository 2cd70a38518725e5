#include "sim/check/falsification/conservatism.h"

#include <algorithm>
#include <array>
#include <functional>

#include "planner/base/stop.h"
#include "planner/numeric/threshold.h"
#include "planner/uncertainty/preconditions/certify.h"
#include "sim/execution/trial/scheduler.h"
#include "sim/noise/possible_start.h"
#include "sim/noise/sampling.h"

namespace assay::check {
namespace {

using noise::Channel;
using noise::Effect;

std::string NameOfEffect(Effect effect) {
  switch (effect) {
    case Effect::kPartX:
      return "x";
    case Effect::kPartY:
      return "y";
    case Effect::kPartYaw:
      return "yaw";
    case Effect::kTableHeight:
      return "height";
    case Effect::kHandX:
      return "x of the hand";
    case Effect::kHandY:
      return "y of the hand";
    case Effect::kHandZ:
      return "z of the hand";
    case Effect::kHandYaw:
      return "yaw of the hand";
    case Effect::kSensedX:
      return "sensed x";
    case Effect::kSensedY:
      return "sensed y";
    case Effect::kSensedZ:
      return "sensed z";
    case Effect::kSensedYaw:
      return "sensed yaw";
    case Effect::kClearance:
      return "clearance";
    case Effect::kFriction:
      return "friction";
    case Effect::kPadFriction:
      return "friction of the pads";
  }
  return {};
}

Interval Times(double factor, const Interval& range) {
  return {factor * range.low, factor * range.high};
}

// A problem in which only the varied errors are left, with a multiple of their bounds.
class ScaledProblem {
 public:
  ScaledProblem(const domain::Problem& problem, const VariedErrors& varied)
      : original_(problem), varied_(varied) {}

  domain::Problem At(double multiple) const {
    using enum Effect;
    const auto factor = [&](Effect effect, domain::PartId part = domain::PartId::None()) {
      return varied_.Include(effect, part) ? multiple : 0;
    };
    domain::Problem problem = original_;
    for (std::size_t i = 0; i < problem.parts.size(); ++i) {
      const domain::PartId part(i);
      Scale({factor(kPartX, part), factor(kPartY, part), factor(kTableHeight, part),
             factor(kPartYaw, part)},
            problem.parts[i].error);
    }
    Scale({factor(kHandX), factor(kHandY), factor(kHandZ), factor(kHandYaw)},
          problem.gripper_error);
    problem.tolerances.clearance *= factor(kClearance);
    problem.tolerances.friction *= factor(kFriction);
    problem.tolerances.pad_friction *= factor(kPadFriction);
    return problem;
  }

 private:
  // `factors` are those of x, y, z and theta.
  static void Scale(const std::array<double, 4>& factors, domain::PoseError& error) {
    error.x = Times(factors[0], error.x);
    error.y = Times(factors[1], error.y);
    error.z = Times(factors[2], error.z);
    error.theta = Times(factors[3], error.theta);
  }

  const domain::Problem& original_;
  const VariedErrors& varied_;
};

// A sensor's promise is not multiplied, because it belongs to the workcell.
bool IsSensed(const Channel& channel) {
  return channel.effect == Effect::kSensedX || channel.effect == Effect::kSensedY ||
         channel.effect == Effect::kSensedZ || channel.effect == Effect::kSensedYaw;
}

class Comparison {
 public:
  Comparison(const Experiment& experiment, const ConservatismOptions& options,
             execution::Scheduler& scheduler)
      : experiment_(experiment),
        options_(options),
        scheduler_(scheduler),
        box_(noise::ErrorBox(experiment.problem, experiment.plan)),
        start_(experiment.problem) {}

  std::vector<VariedErrors> Variables() const {
    std::vector<VariedErrors> variables;
    for (const Channel& channel : box_) {
      const VariedErrors variable{channel.effect, channel.part};
      if (IsSensed(channel) || std::ranges::count(variables, variable) > 0) continue;
      variables.push_back(variable);
    }
    variables.emplace_back();
    return variables;
  }

  ConservatismRatio Of(const VariedErrors& variable) const {
    const auto unproved = [&](double multiple) {
      BreakOffIfStopped();
      return !Proves(variable, multiple);
    };
    const auto fails = [&](double multiple) { return Fails(variable, multiple); };
    // The bound up to which everything is proved is searched with this share of the precision for
    // trials, because a proof costs very little.
    constexpr double kFinely = 0.1;
    const double guaranteed =
        FindThreshold(unproved, 1, options_.greatest, kFinely * options_.precision).holds;
    // The trials begin at the greatest proved multiple less a tenth, because the engine's own
    // errors (the noise floor) may add up to a tenth of what is certified. Smaller multiples are
    // tried only if the trials at the first multiple fail.
    constexpr double kInside = 0.9;
    const double first = guaranteed > 0 ? kInside * guaranteed : 1;
    return {.variable = NameOf(experiment_.problem, variable),
            .guaranteed = guaranteed,
            .broken = FindThreshold(fails, first, options_.greatest, options_.precision).fails};
  }

 private:
  void BreakOffIfStopped() const {
    if (scheduler_.Ends()) throw Stopped();
  }

  bool Proves(const VariedErrors& variable, double multiple) const {
    const domain::Problem problem = ScaledProblem(experiment_.problem, variable).At(multiple);
    uncertainty::UncertainWorld world(problem, uncertainty::Propagation::kSound);
    for (const plan::StepId id : experiment_.plan.ExecutionOrder()) {
      const plan::PlannedStep& step = experiment_.plan.step(id);
      using enum uncertainty::Wanted;
      const auto unproved = uncertainty::DecideStep(world, step.action, {},
                                                    step.strategy ? kAllUnproved : kFirstUnproved,
                                                    step.strategy ? &*step.strategy : nullptr);
      const bool holds = std::ranges::all_of(unproved, [&](const uncertainty::Unproved& unmet) {
        return plan::Absorbs(step.strategy, unmet.claim.condition);
      });
      if (!holds) return false;
    }
    return true;
  }

  // Returns whether a trial fails at the ends of the variable's bounds, or at corners of the whole
  // box for all errors. Sensors' promises are varied in both cases.
  bool Fails(const VariedErrors& variable, double multiple) const {
    std::vector<Channel> box = box_;
    std::vector<std::size_t> varied;
    for (std::size_t i = 0; i < box.size(); ++i) {
      if (!IsSensed(box[i])) box[i].range = Times(multiple, box[i].range);
      if (variable.Include(box[i].effect, box[i].part) || IsSensed(box[i])) varied.push_back(i);
    }
    const int dimensions = static_cast<int>(varied.size());
    const int trials = std::min(options_.corners, dimensions == 1 ? 2 : options_.corners);
    for (int number = 1; number <= trials; ++number) {
      BreakOffIfStopped();
      const noise::Noise none(box, std::vector<double>(box.size(), 0));
      std::vector<double> values = none.values();
      const auto corner = noise::CornerPoint(dimensions, options_.seed, number);
      for (std::size_t i = 0; i < varied.size(); ++i) {
        const Interval& range = box[varied[i]].range;
        values[varied[i]] = corner[i] > 0 ? range.high : range.low;
      }
      execution::ExecutorOptions executor;
      executor.sample_rate = 0;
      executor.recovers = false;
      const Verdict verdict =
          JudgeTrial(experiment_, start_.MovedBack({box, std::move(values)}, none), executor);
      if (verdict.outcome != TrialOutcome::kSucceeded) return true;
    }
    return false;
  }

  const Experiment& experiment_;
  const ConservatismOptions& options_;
  execution::Scheduler& scheduler_;
  std::vector<Channel> box_;
  noise::PossibleStart start_;
};

}  // namespace

std::string NameOf(const domain::Problem& problem, const VariedErrors& errors) {
  if (!errors.effect) return "all";
  const std::string name = NameOfEffect(*errors.effect);
  return errors.part.IsNone() ? name : name + " of " + problem.part(errors.part).name;
}

std::optional<double> ConservatismRatio::ratio() const {
  if (!broken || guaranteed <= 0) return std::nullopt;
  return *broken / guaranteed;
}

std::vector<ConservatismRatio> Conservatism(const Experiment& experiment,
                                            const ConservatismOptions& options) {
  execution::Scheduler scheduler(options.jobs, options.stop);
  const Comparison comparison(experiment, options, scheduler);
  const std::vector<VariedErrors> variables =
      options.variables.empty() ? comparison.Variables() : options.variables;
  std::vector<ConservatismRatio> ratios;
  scheduler.InOrder(
      variables.size(), [&](std::size_t i) { return comparison.Of(variables[i]); },
      [&](std::size_t, ConservatismRatio ratio) { ratios.push_back(std::move(ratio)); });
  return ratios;
}

}  // namespace assay::check
