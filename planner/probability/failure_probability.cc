#include "planner/probability/failure_probability.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "planner/algebra/bounding_methods/first_order_form.h"
#include "planner/base/check.h"
#include "planner/base/input_files/input_error.h"
#include "planner/budget/obstacle.h"
#include "planner/numeric/interval_arithmetic.h"
#include "planner/probability/sum_of_errors.h"
#include "planner/uncertainty/error_sets/sensing.h"
#include "planner/uncertainty/preconditions/bounded_claim.h"
#include "planner/uncertainty/preconditions/certify.h"

namespace assay::probability {
namespace {

using algebra::FirstOrderForm;
using uncertainty::DeclaredError;
using uncertainty::Precondition;
using uncertainty::UncertainWorld;

// A precondition of a step, as it is recognized in boxes of different sizes.
using Subject = std::pair<plan::StepId, std::string>;

// What is known of failures, if all errors are inside of one box.
struct InBox {
  double outside = 0;  // the probability that an error is outside the box, or more
  std::map<Subject, Interval> failures = {};  // of preconditions that are not proved
};

const domain::SensorModel& SensorOf(const domain::Problem& problem, const std::string& name) {
  const domain::SensorModel* const sensor =
      problem.workcell->uncertainty_operations().FindSensor(name);
  ASSAY_CHECK(sensor != nullptr, "the workcell has no sensor '{}'", name);
  return *sensor;
}

// The box of the errors whose distributions are not cut off.
struct Box {
  double deviations;      // standard deviations on either side
  bool is_never_smaller;  // true: no error has less room than it is declared to have
};

// Returns boxes of many sizes. A box that is smaller than declared proves more, and a box that is
// not is one for which looks measure as planned.
std::vector<Box> Boxes() {
  std::vector<Box> boxes;
  for (double deviations = 1; deviations <= 7; deviations += 0.25) {
    boxes.push_back({deviations, true});
    boxes.push_back({deviations, false});
  }
  return boxes;
}

// Finds bounds of probabilities for one box of errors.
class BoxedPlan {
 public:
  BoxedPlan(const domain::Problem& problem, const plan::Plan& plan, const DistributedErrors& errors,
            const Box& box)
      : declared_(problem),
        plan_(plan),
        errors_(errors),
        box_(box),
        problem_(budget::WithBounds(problem, BoundsOf(problem))),
        world_(problem_, uncertainty::Propagation::kSound) {}

  // Returns nothing if looks would replace other coordinates than they do in the plan.
  std::optional<InBox> Failures() {
    InBox found;
    for (const plan::StepId id : plan_.ExecutionOrder()) {
      const plan::PlannedStep& step = plan_.step(id);
      if (!step.action.sensor.empty() && !LooksAsPlanned(step)) return std::nullopt;
      AddFailures(id, found.failures);
    }
    for (const budget::Obstacle& obstacle : budget::ObstaclesBesideCertificates(problem_, plan_)) {
      found.failures[{StepNamed(obstacle.step), obstacle.meaning}] = {0, 1};
    }
    found.outside = Outside();
    return found;
  }

 private:
  std::vector<Interval> BoundsOf(const domain::Problem& problem) const {
    std::vector<Interval> bounds;
    for (const budget::ErrorQuantity& quantity : budget::ErrorQuantitiesOf(problem)) {
      const auto found = errors_.distributions.find(quantity.name);
      if (found == errors_.distributions.end()) {
        bounds.push_back(quantity.bounds);
      } else if (found->second.IsCutOff()) {
        bounds.push_back(found->second.range);
      } else {
        const double most = box_.deviations * found->second.deviation;
        const Interval errors = {-most, most};
        bounds.push_back(box_.is_never_smaller ? Hull(errors, quantity.bounds) : errors);
      }
    }
    return bounds;
  }

  // An execution takes over what a sensor measures if the plan's certificate says that the sensor
  // knows better.
  bool LooksAsPlanned(const plan::PlannedStep& look) const {
    const plan::ErrorSet& planned = look.certificate.before.front();
    const domain::SensorModel& promised = SensorOf(declared_, look.action.sensor);
    const domain::SensorModel& in_box = SensorOf(problem_, look.action.sensor);
    const uncertainty::RestingError& error = world_.resting_in_world(look.action.part);
    const auto agree = [&](const Interval& planned_error, const Interval& planned_promise,
                           const uncertainty::Expression& its_error, const Interval& its_promise) {
      return uncertainty::TakesOver(planned_error, planned_promise) ==
             uncertainty::TakesOver(world_.TightRangeOf(its_error), its_promise);
    };
    return agree(planned.x, promised.x, error.displacement[0], in_box.x) &&
           agree(planned.y, promised.y, error.displacement[1], in_box.y) &&
           agree(planned.z, promised.z, error.displacement[2], in_box.z) &&
           agree(planned.theta, promised.theta, error.theta, in_box.theta);
  }

  plan::StepId StepNamed(const std::string& name) const {
    const auto step = std::ranges::find(plan_.steps, name, &plan::PlannedStep::name);
    if (step == plan_.steps.end()) return plan::StepId::None();  // the way home
    return plan::StepId(static_cast<std::size_t>(step - plan_.steps.begin()));
  }

  void AddFailures(plan::StepId id, std::map<Subject, Interval>& failures) {
    const plan::PlannedStep& step = plan_.step(id);
    const plan::Strategy* strategy = step.strategy ? &*step.strategy : nullptr;
    for (const Precondition& precondition :
         uncertainty::PreconditionsOf(world_, step.action, strategy)) {
      if (plan::Absorbs(step.strategy, precondition.condition) || IsProved(precondition)) continue;
      Interval probability = ProbabilityOfFailure(precondition);
      if (!IsOfErrorsAlone(precondition)) probability.low = 0;
      Interval& known = failures[{id, precondition.meaning}];
      known = {std::max(known.low, probability.low), std::min(1., known.high + probability.high)};
    }
  }

  bool IsProved(const Precondition& precondition) const {
    return uncertainty::ClaimOf(precondition, uncertainty::BoundOf(precondition, world_, {}))
        .holds();
  }

  // Returns whether expression and limit are the same for every box. Other conditions contain
  // numbers that are the worst of the box, for example the least patch that closed pads touch. They
  // may be true for smaller errors.
  bool IsOfErrorsAlone(const Precondition& precondition) const {
    const domain::Tolerances& tolerances = problem_.tolerances;
    return precondition.condition->is_published() && tolerances.clearance == 0 &&
           tolerances.friction == 0 && tolerances.pad_friction == 0;
  }

  // The expression is a sum of errors with distributions, plus a number, plus something that lies
  // in [-rest, rest] and may be chosen against the plan.
  Interval ProbabilityOfFailure(const Precondition& precondition) const {
    const FirstOrderForm form = world_.ToFirstOrder(precondition.expression);
    if (!std::isfinite(form.rest)) return {0, 1};
    const double sign = precondition.relation == plan::Relation::kLess ? 1 : -1;
    double number = sign * form.centre;
    double rest = form.rest;
    Correlated correlated;
    SumOfErrors sum;
    for (const FirstOrderForm::Slope& slope : form.slopes) {
      const auto declared = world_.DeclaredAs(algebra::VariableId(slope.variable));
      const ErrorDistribution* distribution = declared ? DistributionOf(declared->name) : nullptr;
      if (distribution == nullptr) {
        rest += std::abs(slope.value);
        continue;
      }
      const Interval& range = world_.constraints().box[slope.variable];
      const double factor = sign * 2 * slope.value / (range.high - range.low);
      number -= factor * (range.low + range.high) / 2;
      sum.Add(factor, *distribution);
      correlated.push_back({*declared, factor * distribution->deviation});
    }
    sum.AddVariance(CovarianceOf(correlated));
    const double limit = sign * precondition.limit - number;
    return {sum.Beyond(limit + rest).low, sum.Beyond(limit - rest).high};
  }

  const ErrorDistribution* DistributionOf(const std::string& name) const {
    const auto found = errors_.distributions.find(name);
    return found == errors_.distributions.end() ? nullptr : &found->second;
  }

  // An error and the standard deviation of its share in a sum. The sign is that of its factor.
  struct Share {
    DeclaredError error;
    double deviation;
  };
  using Correlated = std::vector<Share>;

  // Returns what correlations add to the variance of a sum.
  double CovarianceOf(const Correlated& shares) const {
    double covariance = 0;
    for (const Correlation& correlation : errors_.correlations) {
      for (const Share& a : shares) {
        for (const Share& b : shares) {
          if (a.error.name != correlation.first || b.error.name != correlation.second) continue;
          if (a.error.draw != b.error.draw) continue;
          covariance += 2 * correlation.coefficient * a.deviation * b.deviation;
        }
      }
    }
    return covariance;
  }

  // Boole's inequality over all draws of errors that are not cut off.
  double Outside() const {
    double outside = 0;
    for (std::size_t v = 0; v < world_.constraints().box.size(); ++v) {
      const auto declared = world_.DeclaredAs(algebra::VariableId(static_cast<int>(v)));
      if (!declared) continue;
      const ErrorDistribution* distribution = DistributionOf(declared->name);
      if (distribution == nullptr || distribution->IsCutOff()) continue;
      const Interval& range = world_.constraints().box[v];
      outside += StandardNormalAtMost(range.low / distribution->deviation) +
                 StandardNormalAtMost(-range.high / distribution->deviation);
    }
    return std::min(1., outside);
  }

  const domain::Problem& declared_;
  const plan::Plan& plan_;
  const DistributedErrors& errors_;
  Box box_;
  domain::Problem problem_;
  UncertainWorld world_;
};

// Returns nothing for a box in which the parts could not be as the problem has them, or in which
// the plan would be executed otherwise.
std::optional<InBox> FailuresInBox(const domain::Problem& problem, const plan::Plan& plan,
                                   const DistributedErrors& errors, const Box& box) {
  try {
    return BoxedPlan(problem, plan, errors, box).Failures();
  } catch (const InputError&) {
    return std::nullopt;
  }
}

// Collects what boxes say of one event. Each box gives valid bounds, so the best counts.
void Narrow(Interval& known, const Interval& in_box, double outside) {
  known.low = std::max(known.low, in_box.low - outside);
  known.high = std::min(known.high, std::min(1., in_box.high + outside));
}

// Returns bounds of the probability that any of some preconditions fails: at least that of one of
// them, and at most that of all together.
template <class IsMeant>
Interval AnyOf(const InBox& box, const IsMeant& is_meant) {
  Interval any = {0, 0};
  for (const auto& [subject, probability] : box.failures) {
    if (!is_meant(subject.first)) continue;
    any = {std::max(any.low, probability.low), std::min(1., any.high + probability.high)};
  }
  return any;
}

}  // namespace

FailureProbabilities FailureProbabilitiesOf(const domain::Problem& problem, const plan::Plan& plan,
                                            const DistributedErrors& errors) {
  std::vector<InBox> boxes;
  for (const Box& box : Boxes()) {
    if (auto failures = FailuresInBox(problem, plan, errors, box)) boxes.push_back(*failures);
  }
  FailureProbabilities found = {{}, std::vector<Interval>(plan.steps.size(), {0, 1}), {0, 1}};
  std::map<Subject, Interval> by_subject;
  for (const InBox& box : boxes) {
    for (const auto& [subject, probability] : box.failures) by_subject[subject] = {0, 1};
  }
  for (const InBox& box : boxes) {
    for (auto& [subject, known] : by_subject) {
      const auto failure = box.failures.find(subject);
      Narrow(known, failure == box.failures.end() ? Interval{0, 0} : failure->second, box.outside);
    }
    for (std::size_t step = 0; step < plan.steps.size(); ++step) {
      const auto of_step = [&](plan::StepId id) { return id == plan::StepId(step); };
      Narrow(found.steps[step], AnyOf(box, of_step), box.outside);
    }
    Narrow(found.plan, AnyOf(box, [](plan::StepId) { return true; }), box.outside);
  }
  for (const auto& [subject, probability] : by_subject)
    found.preconditions.push_back({subject.first, subject.second, probability});
  return found;
}

}  // namespace assay::probability
