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
                   const HonestyGate& gate)
      : problem_(problem), plan_(plan), trace_(trace), gate_(gate) {}

  std::vector<Claim> Run() {
    for (const StepEvents& events : EventsByStep(trace_)) {
      step_ = events.step;
      Check(events);
    }
    return std::move(claims_);
  }

 private:
  void Check(const StepEvents& events) {
    const plan::PlannedStep& step = plan_.step(step_);
    const plan::Certificate& certificate = step.certificate;
    if (events.poised != nullptr) CheckSets(Claimed::kBefore, certificate.before, *events.poised);
    CheckPreconditions(step, events);
    if (events.recovered) assumed_ = false;
    if (events.end != nullptr) {
      CheckSets(Claimed::kAfter, certificate.after, *events.end);
    } else {
      CheckStopped();
    }
  }

  void CheckSets(Claimed about, const std::vector<plan::ErrorSet>& sets,
                 const exec::Moment& moment) {
    for (const plan::ErrorSet& set : sets) {
      const plan::Action& action = plan_.step(step_).action;
      for (ObservedError& error : ObservedErrors(problem_, action, set, moment)) {
        Add({.step = step_,
             .about = about,
             .name = std::move(error.name),
             .unit = std::move(error.unit),
             .predicted = error.predicted,
             .observed = error.observed});
      }
    }
  }

  // Those of one name are one claim. They stand in the order in which they begin to matter: when
  // one fails that was not proved, those after it are not claimed.
  void CheckPreconditions(const plan::PlannedStep& step, const StepEvents& events) {
    std::vector<std::string> done;
    for (const plan::CertifiedPrecondition& claim : step.certificate.preconditions) {
      if (std::ranges::find(done, claim.condition) != done.end()) continue;
      done.push_back(claim.condition);
      if (plan::Absorbs(step.strategy, claim.condition)) continue;
      const auto meaning = MeaningOf(claim.condition, problem_, step, events);
      if (!meaning) continue;
      const bool proved = IsProved(claim.condition, step.certificate);
      Add({.step = step_,
           .about = Claimed::kPrecondition,
           .name = claim.condition,
           .unit = meaning->unit,
           .predicted = {0, std::numeric_limits<double>::infinity()},
           .proved = proved,
           .observed = meaning->observed});
      if (!proved && meaning->observed < 0) assumed_ = false;
    }
  }

  static bool IsProved(const std::string& condition, const plan::Certificate& certificate) {
    return std::ranges::all_of(certificate.preconditions, [&](const auto& claim) {
      return claim.condition != condition || claim.holds();
    });
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
    if (!about_it) return;
    Add({.step = step_,
         .about = Claimed::kAfter,
         .name = "comes to its end",
         .unit = "",
         .predicted = {1, 1},
         .proved = end->outcome != exec::ExecutionOutcome::kUnreachable ||
                   IsProved("reach", plan_.step(step_).certificate),
         .observed = 0});
  }

  bool SaysThatTheArmReaches() const {
    return std::ranges::count(plan_.step(step_).certificate.preconditions, "reach",
                              &plan::CertifiedPrecondition::condition) > 0;
  }

  void Add(Claim claim) {
    claim.gate = gate_.For(claim);
    claim = Judged(std::move(claim));
    if (!assumed_ || !claim.proved) claim.verdict = ClaimVerdict::kNotClaimed;
    claims_.push_back(std::move(claim));
  }

  const domain::Problem& problem_;
  const plan::Plan& plan_;
  const exec::Trace& trace_;
  const HonestyGate& gate_;
  plan::StepId step_;
  bool assumed_ = true;
  std::vector<Claim> claims_;
};

}  // namespace

std::vector<Claim> CheckCertificates(const domain::Problem& problem, const plan::Plan& plan,
                                     const exec::Trace& trace, const HonestyGate& gate) {
  return CertificateCheck(problem, plan, trace, gate).Run();
}

}  // namespace assay::check
