#include "sim/check/certificate_check.h"

#include <algorithm>
#include <limits>

#include "sim/check/geometric_meaning.h"
#include "sim/check/observed_error.h"
#include "sim/check/step_events.h"

namespace assay::check {
namespace {

class CertificateCheck {
 public:
  CertificateCheck(const domain::Problem& problem, const plan::Plan& plan, const exec::Trace& trace,
                   const HonestyGate& gate, plan::StepId first)
      : problem_(problem), plan_(plan), trace_(trace), gate_(gate), steps_(StepsFrom(plan, first)) {
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
  // The steps of the trace that came to their ends.
  std::size_t Ended() const { return trace_.All<exec::StepEnd>().size(); }

  // To the steps on whose ways or in whose work they happened; on the way home to the last one.
  void SortCollisions() {
    std::size_t ended = 0;
    for (const exec::TraceEvent& event : trace_.events) {
      if (std::holds_alternative<exec::StepEnd>(event)) ++ended;
      const bool collided = std::holds_alternative<exec::CollisionRecord>(event);
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
    if (trace_.events.empty() || !std::holds_alternative<exec::ExecutionEnd>(trace_.events.back()))
      return;
    CheckClear();
    CheckStopped();
  }

  void CheckClear() {
    if (std::ranges::count(collided_, step_) > 0) AddFailed("keeps clear of everything else");
  }

  void CheckSets(Claimed about, const std::vector<plan::ErrorSet>& sets,
                 const exec::Moment& moment) {
    for (const plan::ErrorSet& set : sets) {
      const plan::Action& action = plan_.step(step_).action;
      for (ObservedError& error : ObservedErrors(problem_, action, set, moment)) {
        Add({.step = step_,
             .about = about,
             .name = std::move(error.name),
             .unit = error.unit,
             .predicted = error.predicted,
             .observed = error.observed});
      }
    }
  }

  // Those of one name are one claim, or two, of what was proved and of what was not. They stand in
  // the order in which they begin to matter: when one fails that was not proved, those after it are
  // not claimed.
  void CheckPreconditions(const plan::PlannedStep& step, const StepEvents& events) {
    std::vector<std::string> done;
    for (const plan::CertifiedPrecondition& claim : step.certificate.preconditions) {
      if (std::ranges::find(done, claim.condition) != done.end()) continue;
      done.push_back(claim.condition);
      if (plan::Absorbs(step.strategy, claim.condition)) continue;
      const auto meanings = MeaningsOf(claim.condition, problem_, step, events);
      for (const bool proved : {true, false}) {
        const GeometricMeaning* worst = nullptr;
        for (const GeometricMeaning& meaning : meanings) {
          if (IsProved(claim.condition, meaning.subject, step.certificate) != proved) continue;
          if (worst == nullptr || meaning.observed < worst->observed) worst = &meaning;
        }
        if (worst != nullptr) CheckPrecondition(claim.condition, *worst, proved);
      }
    }
  }

  void CheckPrecondition(const std::string& condition, const GeometricMeaning& worst, bool proved) {
    Add({.step = step_,
         .about = Claimed::kPrecondition,
         .name = proved ? condition : condition + ", not proved",
         .unit = worst.unit,
         .predicted = {0, std::numeric_limits<double>::infinity()},
         .proved = proved,
         .observed = worst.observed});
    if (!proved && worst.observed < 0) assumed_ = false;
  }

  // All that the condition says of the subject; all of it, if it does not tell subjects apart.
  static bool IsProved(const std::string& condition, const std::string& subject,
                       const plan::Certificate& certificate) {
    bool all = true;
    bool of_subject = true;
    bool tells = false;
    for (const plan::CertifiedPrecondition& claim : certificate.preconditions) {
      if (claim.condition != condition) continue;
      all = all && claim.holds();
      if (claim.meaning != subject) continue;
      tells = true;
      of_subject = of_subject && claim.holds();
    }
    return tells ? of_subject : all;
  }

  // A step whose preconditions hold comes to its end; that the arm reaches everything is one of
  // them (assembly::WayConditions), if the plan was made with them. What the engine does when its
  // numbers go bad, no certificate says.
  void CheckStopped() {
    const auto* end = std::get_if<exec::ExecutionEnd>(&trace_.events.back());
    if (end == nullptr) return;
    const bool about_it =
        end->outcome == exec::ExecutionOutcome::kOverload ||
        end->outcome == exec::ExecutionOutcome::kOperatorCalled ||
        (end->outcome == exec::ExecutionOutcome::kUnreachable && SaysThatTheArmReaches());
    if (about_it) AddFailed("comes to its end");
  }

  void AddFailed(const char* name) {
    Add({.step = step_,
         .about = Claimed::kAfter,
         .name = name,
         .unit = Unit::kNone,
         .predicted = {1, 1},
         .observed = 0});
  }

  bool SaysThatTheArmReaches() const {
    return std::ranges::count(plan_.step(step_).certificate.preconditions, "reach",
                              &plan::CertifiedPrecondition::condition) > 0;
  }

  void Add(Claim claim) {
    claim = Judged(gate_.Passed(std::move(claim)));
    if (!assumed_ || !claim.proved) claim.verdict = ClaimVerdict::kNotClaimed;
    claims_.push_back(std::move(claim));
  }

  const domain::Problem& problem_;
  const plan::Plan& plan_;
  const exec::Trace& trace_;
  const HonestyGate& gate_;
  std::vector<plan::StepId> steps_;     // that the trace may tell of, in the order of execution
  std::vector<plan::StepId> collided_;  // once for each collision
  plan::StepId step_;
  bool assumed_ = true;
  std::vector<Claim> claims_;
};

}  // namespace

std::vector<Claim> CheckCertificates(const domain::Problem& problem, const plan::Plan& plan,
                                     const exec::Trace& trace, const HonestyGate& gate,
                                     plan::StepId first) {
  return CertificateCheck(problem, plan, trace, gate, first).Run();
}

}  // namespace assay::check
