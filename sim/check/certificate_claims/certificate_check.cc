#include "sim/check/certificate_claims/certificate_check.h"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "planner/geometry/pose.h"
#include "planner/plan/certificates/condition_table.h"
#include "sim/check/measurements/observed_error.h"
#include "sim/check/measurements/step_events.h"

namespace assay::check {
namespace {

constexpr double kLeftToTheEngine = 0.1;  // of a margin

// Returns the distance between two poses of a part, in metres. AsLength converts the turn into a
// length.
double ShiftBetween(const geometry::Pose& from, const geometry::Pose& to) {
  return (to.translation() - from.translation()).norm() +
         AsLength(geometry::AngleBetween(from.linear(), to.linear()), domain::Dimension::kAngle);
}

class CertificateCheck {
 public:
  CertificateCheck(const domain::Problem& problem, const plan::Plan& plan,
                   const execution::Trace& trace, const NoiseFloor& gate, plan::StepId first,
                   const std::vector<Measurement>& measurements)
      : problem_(problem),
        plan_(plan),
        trace_(trace),
        gate_(gate),
        measurements_(measurements),
        steps_(StepsFrom(plan, first)) {
    SortCollisions();
  }

  std::vector<Claim> Run() {
    bool ended = true;
    for (const StepEvents& events : EventsByStep(trace_)) {
      step_ = events.step;
      Check(events);
      ended = events.end != nullptr;
    }
    if (ended) CheckStoppedOnTheWay();
    return std::move(claims_);
  }

 private:
  static std::vector<plan::StepId> StepsFrom(const plan::Plan& plan, plan::StepId first) {
    std::vector<plan::StepId> steps = plan.ExecutionOrder();
    if (!first.IsNone()) steps.erase(steps.begin(), std::ranges::find(steps, first));
    return steps;
  }
  // Returns how many steps of the trace came to their ends.
  std::size_t Ended() const { return trace_.All<execution::StepEnd>().size(); }

  // Assigns each collision to the step on whose way or in whose work it happened. A collision on
  // the way home belongs to the last step.
  void SortCollisions() {
    std::size_t ended = 0;
    for (const execution::TraceEvent& event : trace_.events) {
      if (std::holds_alternative<execution::StepEnd>(event)) ++ended;
      const bool collided = std::holds_alternative<execution::CollisionRecord>(event);
      if (collided) collided_.push_back(steps_[std::min(ended, steps_.size() - 1)]);
    }
  }

  void Check(const StepEvents& events) {
    const plan::PlannedStep& step = plan_.step(step_);
    const plan::Certificate& certificate = step.certificate;
    if (events.poised != nullptr) CheckSets(Claimed::kBefore, certificate.before, *events.poised);
    CheckPreconditions(step, events);
    if (events.recovered) assumed_ = false;
    CheckClear();
    CheckBystanders(certificate, events);
    if (events.end != nullptr) {
      CheckSets(Claimed::kAfter, certificate.after, *events.end);
    } else {
      CheckStopped();
    }
  }

  // The execution may end on the way to a step, before its tool is poised.
  void CheckStoppedOnTheWay() {
    if (Ended() >= steps_.size()) return;
    step_ = steps_[Ended()];
    if (trace_.events.empty() ||
        !std::holds_alternative<execution::ExecutionEnd>(trace_.events.back()))
      return;
    CheckClear();
    CheckStopped();
  }

  void CheckClear() {
    if (std::ranges::count(collided_, step_) > 0) AddFailed("keeps clear of everything else");
  }

  // The error set of a part that the step does not handle stays as it is. A part that is believed
  // to stay is not in the hand, and must therefore stay, also on the way to the step.
  void CheckBystanders(const plan::Certificate& certificate, const StepEvents& events) {
    if (certificate.before.empty() || events.poised == nullptr) return;
    const execution::Snapshot* const first = events.begun != nullptr ? events.begun : events.poised;
    const execution::Snapshot* const last = events.end != nullptr       ? events.end
                                            : events.stopped != nullptr ? events.stopped
                                                                        : events.poised;
    for (std::size_t i = 0; i < last->parts.size(); ++i) {
      const domain::PartId part(i);
      const execution::TrueAndBelieved& from = first->parts[i];
      const execution::TrueAndBelieved& to = last->parts[i];
      if (std::ranges::count(certificate.before, part, &plan::ErrorSet::part) > 0) continue;
      if (from.believed.matrix() != to.believed.matrix()) continue;
      const Claim claim =
          gate_.Passed({.step = step_,
                        .about = Claimed::kAfter,
                        .name = "leaves " + problem_.part(part).name + " where it is",
                        .dimension = domain::Dimension::kLength,
                        .predicted = {0, kMostCreep},
                        .observed = ShiftBetween(from.truth, to.truth)});
      if (claim.observed > claim.predicted.high) AddPassed(claim);
    }
  }

  void CheckSets(Claimed about, const std::vector<plan::ErrorSet>& sets,
                 const execution::Snapshot& snapshot) {
    for (const plan::ErrorSet& set : sets) {
      const plan::Action& action = plan_.step(step_).action;
      const bool is_mating = action.kind->leaves == domain::Leaves::kMated;
      for (ObservedError& error : ObservedErrors(problem_, action, set, snapshot)) {
        Add({.step = step_,
             .about = about,
             .name = std::move(error.name),
             .dimension = error.dimension,
             .predicted = error.predicted,
             .observed = error.observed,
             .lever = error.lever,
             .is_of_fixed = is_mating && set.part != action.part});
      }
    }
  }

  // Preconditions of one name make one claim, or two if only some of them were proved. A
  // precondition that was not proved may fail in a trial, or nothing may measure whether it does.
  // In both cases neither the other preconditions of its step nor anything later is claimed: a
  // finger that comes down on the part has moved it before the next precondition is measured.
  void CheckPreconditions(const plan::PlannedStep& step, const StepEvents& events) {
    std::vector<Claim> claims;
    std::vector<plan::Condition> done;
    const MeasuredStep measured(problem_, step, events);
    for (const plan::CertifiedPrecondition& claim : step.certificate.preconditions) {
      const plan::Condition condition = claim.condition;
      if (std::ranges::count(done, condition) > 0) continue;
      done.push_back(condition);
      if (plan::Absorbs(step.strategy, condition)) continue;
      const Measurement& measurement = MeasurementOf(condition, measurements_);
      if (measurement.is_measured()) {
        AddMeasured(measurement, measured, claims);
      } else {
        assumed_ = assumed_ && MarginOf(condition, {}, step.certificate) > 0;
      }
    }
    const auto fails = [](const Claim& claim) { return !claim.proved && claim.observed < 0; };
    assumed_ = assumed_ && std::ranges::none_of(claims, fails);
    for (Claim& claim : claims) Add(std::move(claim));
  }

  void AddMeasured(const Measurement& measurement, const MeasuredStep& measured,
                   std::vector<Claim>& claims) {
    const plan::Condition condition = measurement.condition;
    std::vector<Claim> proved;
    std::vector<Claim> not_proved;
    for (const MeasuredMargin& meaning : measurement.measure(measured)) {
      if (meaning.counts_on_yielding && meaning.observed < 0) {
        assumed_ = false;
        continue;
      }
      const double margin = MarginOf(condition, meaning.subject, measured.step().certificate);
      (margin > 0 ? proved : not_proved).push_back(ClaimOf(condition, meaning, margin));
    }
    AppendWorst(proved, claims);
    AppendWorst(not_proved, claims);
  }

  Claim ClaimOf(plan::Condition condition, const MeasuredMargin& meaning, double margin) {
    const bool proved = margin > 0;
    const std::string name(condition.name());
    return {.step = step_,
            .about = Claimed::kPrecondition,
            .name = proved ? name : name + ", not proved",
            .dimension = condition->dimension,
            .predicted = {meaning.is_at_least_the_margin ? Tested(margin, condition) : 0,
                          std::numeric_limits<double>::infinity()},
            .proved = proved,
            .observed = meaning.observed};
  }

  static void AppendWorst(const std::vector<Claim>& of_one_name, std::vector<Claim>& claims) {
    if (of_one_name.empty()) return;
    claims.push_back(std::ranges::min(
        of_one_name, {}, [](const Claim& claim) { return claim.observed - claim.predicted.low; }));
  }

  // Returns the certified margin less a tenth of it. For lengths, a tenth of the clearance is
  // subtracted if that is less. The arm yields under load by a micrometre, which an execution
  // without noise does not show.
  double Tested(double margin, plan::Condition condition) const {
    const bool has_clearance =
        condition->dimension == domain::Dimension::kLength && problem_.clearance > 0;
    const double known = has_clearance ? std::min(margin, problem_.clearance) : margin;
    return std::max(0.0, margin - kLeftToTheEngine * known);
  }

  // Returns the margin by which the condition holds for the subject under all errors. If the
  // certificate does not name the subject, it is the margin for all subjects of the condition.
  static double MarginOf(plan::Condition condition, const std::string& subject,
                         const plan::Certificate& certificate) {
    double of_all = std::numeric_limits<double>::infinity();
    double of_subject = of_all;
    for (const plan::CertifiedPrecondition& claim : certificate.preconditions) {
      if (claim.condition != condition) continue;
      of_all = std::min(of_all, claim.margin);
      if (claim.meaning == subject) of_subject = std::min(of_subject, claim.margin);
    }
    return std::isfinite(of_subject) ? of_subject : of_all;
  }

  // A step whose preconditions hold is completed. If the plan was made with
  // assembly::WayConditions, one of the preconditions is that the arm reaches all poses of the
  // step. No certificate covers an execution in which the engine's numbers become invalid.
  void CheckStopped() {
    const auto* end = std::get_if<execution::ExecutionEnd>(&trace_.events.back());
    if (end == nullptr) return;
    const bool about_it =
        end->outcome == execution::TrialOutcome::kOverload ||
        end->outcome == execution::TrialOutcome::kOperatorCalled ||
        (end->outcome == execution::TrialOutcome::kUnreachable && SaysThatTheArmReaches());
    if (about_it) AddFailed("comes to its end");
  }

  void AddFailed(const char* name) {
    Add({.step = step_,
         .about = Claimed::kAfter,
         .name = name,
         .predicted = {1, 1},
         .observed = 0});
  }

  bool SaysThatTheArmReaches() const {
    return std::ranges::count(plan_.step(step_).certificate.preconditions,
                              plan::Condition(plan::condition::kReach),
                              &plan::CertifiedPrecondition::condition) > 0;
  }

  void Add(Claim claim) { AddPassed(gate_.Passed(std::move(claim))); }

  void AddPassed(Claim claim) {
    claim = Judged(std::move(claim));
    if (!assumed_ || !claim.proved) claim.verdict = ClaimVerdict::kNotClaimed;
    claims_.push_back(std::move(claim));
  }

  const domain::Problem& problem_;
  const plan::Plan& plan_;
  const execution::Trace& trace_;
  const NoiseFloor& gate_;
  const std::vector<Measurement>& measurements_;
  std::vector<plan::StepId> steps_;     // that the trace may contain, in the order of execution
  std::vector<plan::StepId> collided_;  // the step of each collision
  plan::StepId step_;
  bool assumed_ = true;
  std::vector<Claim> claims_;
};

}  // namespace

std::vector<Claim> CheckCertificates(const domain::Problem& problem, const plan::Plan& plan,
                                     const execution::Trace& trace, const NoiseFloor& gate,
                                     plan::StepId first,
                                     const std::vector<Measurement>& measurements) {
  return CertificateCheck(problem, plan, trace, gate, first, measurements).Run();
}

}  // namespace assay::check
