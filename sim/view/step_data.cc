#include "sim/view/step_data.h"

#include <map>
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

// Returns the time at which the tool reached the place where it acts, for each step that did so.
std::map<plan::StepId, double> ReachedBySteps(const execution::Trace& trace) {
  std::map<plan::StepId, double> times;
  for (const execution::Milestone* milestone : trace.All<execution::Milestone>()) {
    if (milestone->stage == execution::Stage::kReached) {
      times.try_emplace(milestone->step, milestone->snapshot.time);
    }
  }
  return times;
}

Json StepData(const Executed& executed, plan::StepId id) {
  const plan::PlannedStep& step = executed.plan.step(id);
  return {{"number", step.executed},
          {"planNumber", step.executed},
          {"planned", true},
          {"name", step.name},
          {"action", plan::ShortText(executed.problem, step.action)},
          {"certified", !step.certificate.before.empty()},
          {"preconditions", PreconditionsOf(executed, id)},
          {"notNeeded", NotNeededOf(step.certificate)},
          {"resolutions", ResolutionsOf(executed.plan, step.certificate)},
          {"verifications", VerificationsOf(executed.plan, id)},
          {"verdicts", VerdictsOn(id, executed.claims)}};
}

// An action that is no step of a plan has no certificate.
Json UnplannedData() {
  const Json none = Json::array();
  return {
      {"number", 0},         {"planNumber", 0},       {"planned", false},      {"name", ""},
      {"action", ""},        {"certified", false},    {"preconditions", none}, {"notNeeded", none},
      {"resolutions", none}, {"verifications", none}, {"verdicts", none}};
}

}  // namespace

Json TimesOf(const plan::Plan& plan, const execution::Trace& trace) {
  Json times = Json::array();
  double from = 0;
  for (const execution::StepEnd* end : trace.All<execution::StepEnd>()) {
    times.push_back({{"from", from}, {"to", end->snapshot.time}, {"ended", true}});
    from = end->snapshot.time;
  }
  if (times.size() < plan.steps.size()) {
    times.push_back({{"from", from}, {"to", trace.end().snapshot.time}, {"ended", false}});
  }
  return times;
}

Json StepsOf(const Executed& executed) {
  const Json times = TimesOf(executed.plan, executed.trace);
  const std::map<plan::StepId, double> reached = ReachedBySteps(executed.trace);
  Json steps = Json::array();
  for (const plan::StepId id : executed.plan.ExecutionOrder()) {
    Json step = StepData(executed, id);
    if (steps.size() < times.size()) step.update(times[steps.size()]);
    if (const auto found = reached.find(id); found != reached.end()) step["acts"] = found->second;
    steps.push_back(std::move(step));
  }
  return steps;
}

Json StepsOf(const Executed& executed, const std::vector<WalkedAction>& walked) {
  const std::map<plan::StepId, double> reached = ReachedBySteps(executed.trace);
  Json steps = Json::array();
  double from = 0;
  for (const WalkedAction& action : walked) {
    Json step = action.step.IsNone() ? UnplannedData() : StepData(executed, action.step);
    step["number"] = steps.size() + 1;
    step["action"] = action.action;
    for (const Fact& fact : action.facts) step["facts"].push_back({fact.name, fact.value});
    if (action.drawing) step["drawing"] = *action.drawing;
    if (action.end) {
      step.update({{"from", from}, {"to", *action.end}, {"ended", true}});
      from = *action.end;
    }
    const auto found = reached.find(action.step);
    if (found != reached.end()) step["acts"] = found->second;
    steps.push_back(std::move(step));
  }
  return steps;
}

}  // namespace assay::view
