#include "sim/view/step_data.h"

#include <nlohmann/json.hpp>

#include "sim/view/certificate_data.h"

namespace assay::view {
namespace {

using Json = nlohmann::ordered_json;

Json NotNeededOf(const plan::Certificate& certificate) {
  Json all = Json::array();
  for (const plan::NotNeeded& kind : certificate.not_needed) {
    all.push_back({{"condition", kind.condition.name()}, {"reason", kind.reason}});
  }
  return all;
}

Json ResolutionsOf(const plan::Plan& plan, const plan::Certificate& certificate) {
  Json all = Json::array();
  for (const plan::Resolution& resolution : certificate.resolutions) {
    Json steps = Json::array();
    for (const plan::StepId step : resolution.steps) steps.push_back(plan.step(step).executed);
    all.push_back({{"resolver", resolution.resolver}, {"steps", steps}, {"why", resolution.why}});
  }
  return all;
}

Json VerificationsOf(const plan::Plan& plan, plan::StepId step) {
  Json all = Json::array();
  for (const plan::Verification& check : plan.verifications) {
    if (check.step != step) continue;
    all.push_back({{"name", check.name},
                   {"expected", check.expected},
                   {"tolerance", check.tolerance},
                   {"below", check.below},
                   {"above", check.above}});
  }
  return all;
}

Json VerdictsOn(plan::StepId step, const std::vector<check::Claim>& claims) {
  Json all = Json::array();
  for (const check::Claim& claim : claims) {
    if (claim.step != step) continue;
    all.push_back({{"about", check::Name(claim.about)},
                   {"name", claim.name},
                   {"unit", claim.UnitName()},
                   {"predicted", {claim.predicted.low, claim.predicted.high}},
                   {"observed", claim.observed},
                   {"margin", claim.margin},
                   {"gate", claim.gate},
                   {"verdict", check::Name(claim.verdict)}});
  }
  return all;
}

// Returns the time at which each step ended, in the order of execution.
std::vector<double> EndsOf(const execution::Trace& trace) {
  std::vector<double> ends;
  for (const execution::StepEnd* end : trace.All<execution::StepEnd>())
    ends.push_back(end->moment.time);
  return ends;
}

Json StepData(const Executed& executed, plan::StepId id) {
  const plan::PlannedStep& step = executed.plan.step(id);
  return {{"number", step.executed},
          {"name", step.name},
          {"action", plan::ShortText(executed.problem, step.action)},
          {"certified", !step.certificate.before.empty()},
          {"preconditions", PreconditionsOf(step, executed.plan_file)},
          {"notNeeded", NotNeededOf(step.certificate)},
          {"resolutions", ResolutionsOf(executed.plan, step.certificate)},
          {"verifications", VerificationsOf(executed.plan, id)},
          {"verdicts", VerdictsOn(id, executed.claims)}};
}

}  // namespace

Json StepsOf(const Executed& executed) {
  const std::vector<double> ends = EndsOf(executed.trace);
  Json steps = Json::array();
  for (const plan::StepId id : executed.plan.ExecutionOrder()) {
    Json step = StepData(executed, id);
    const std::size_t place = steps.size();
    if (place <= ends.size()) {
      const bool ended = place < ends.size();
      step["from"] = place == 0 ? 0.0 : ends[place - 1];
      step["to"] = ended ? ends[place] : executed.trace.end().moment.time;
      step["ended"] = ended;
    }
    steps.push_back(std::move(step));
  }
  return steps;
}

}  // namespace assay::view
