#include "planner/plan/plan_files/plan_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>

#include "planner/plan/certificates/not_covered.h"
#include "planner/plan/checker/linearization.h"
#include "planner/plan/plan_files/action_file.h"
#include "planner/plan/plan_files/certificate_file.h"
#include "planner/plan/plan_files/recovery_file.h"
#include "planner/plan/plan_files/strategy_file.h"
#include "planner/plan/plan_files/travel_file.h"

namespace assay::plan {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kFormat = "assay-plan/2";
// 2^53: not every integer above it is a double.
constexpr double kLargestCount = 9007199254740992.0;

// The words of the format for outcomes, in the order of the enum Outcome.
const std::vector<std::string> kOutcomes = {"planned", "none", "budget"};

std::vector<std::string> NamesOf(const std::vector<PlannedStep>& steps) {
  std::vector<std::string> names;
  for (const PlannedStep& step : steps) names.push_back(step.name);
  return names;
}

Json StepToJson(const PlannedStep& step, const domain::Problem& problem) {
  Json json = {{"id", step.name},
               {"name", step.action.kind->name},
               {"arguments", ArgumentsToJson(step.action, problem)},
               {"inserted", step.inserted},
               {"executed", step.executed}};
  if (const Hold* hold = HoldIn(step.action)) json["hold"] = ToJson(*hold);
  json["place"] = ToJson(step.action.place);
  if (step.travel) json["travel"] = ToJson(*step.travel);
  if (step.strategy) json["strategy"] = ToJson(*step.strategy);
  return json;
}

Json ActionsToJson(const Plan& plan, const domain::Problem& problem) {
  const std::vector<std::string> names = NamesOf(plan.steps);
  Json actions = Json::array();
  for (const PlannedStep& step : plan.steps) {
    Json json = StepToJson(step, problem);
    if (step.certificate != Certificate{}) {
      json["certificate"] = ToJson(step.certificate, problem, names);
    }
    actions.push_back(std::move(json));
  }
  return actions;
}

Json OrderingToJson(const Plan& plan) {
  Json ordering = Json::array();
  for (const auto& [first, second] : plan.ordering) {
    ordering.push_back(Json::array({plan.step(first).name, plan.step(second).name}));
  }
  return ordering;
}

PlannedStep ReadStep(const Value& action, const domain::Problem& problem) {
  action.AllowOnly({"id", "name", "arguments", "inserted", "executed", "hold", "place", "travel",
                    "strategy", "certificate"});
  const int most = std::numeric_limits<int>::max();
  PlannedStep step = {action.At("id").Text(), ReadAction(action, problem),
                      action.At("inserted").Integer(1, most),
                      action.At("executed").Integer(1, most)};
  if (const auto travel = action.Find("travel")) step.travel = ReadTravel(*travel);
  const std::optional<Value> strategy = action.Find("strategy");
  if (!strategy) return step;
  if (step.action.kind->leaves != domain::Leaves::kMated) {
    strategy->Fail(fmt::format("a strategy of {}", action.At("name").Text()),
                   "a strategy of assemble");
  }
  step.strategy = ReadStrategy(*strategy);
  return step;
}

// Checks that ids are unique, that insertion numbers count the actions, and that execution numbers
// are a permutation.
void CheckNumbering(const std::vector<Value>& actions, const std::vector<PlannedStep>& steps) {
  const int count = static_cast<int>(steps.size());
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const PlannedStep& step = steps[i];
    if (step.executed > count) {
      actions[i]
          .At("executed")
          .Fail(fmt::format("{} of {} steps", step.executed, count), fmt::format("1 to {}", count));
    }
    if (step.inserted != static_cast<int>(i) + 1) {
      actions[i]
          .At("inserted")
          .Fail("the actions are not in the order of insertion", fmt::format("{}", i + 1));
    }
    for (std::size_t j = 0; j < i; ++j) {
      if (steps[j].name == step.name) actions[i].At("id").Fail("an id is given twice");
      if (steps[j].executed == step.executed) {
        actions[i]
            .At("executed")
            .Fail("two steps are executed at the same time",
                  fmt::format("each of 1 to {} once", count));
      }
    }
  }
}

Ordering ReadOrdering(const Value& ordering, const std::vector<PlannedStep>& steps) {
  const std::vector<std::string> names = NamesOf(steps);
  Ordering pairs;
  for (const Value& pair : ordering.Items()) {
    const std::vector<Value> ids = pair.Items();
    if (ids.size() != 2) pair.Fail("not a pair", "[first, second]");
    pairs.emplace_back(ids[0].OneOf(names), ids[1].OneOf(names));
  }
  if (!IsAcyclic(static_cast<int>(steps.size()), pairs)) ordering.Fail("the ordering is cyclic");
  return pairs;
}

std::vector<std::string> ReadTexts(const std::optional<Value>& texts) {
  std::vector<std::string> read;
  if (!texts) return read;
  for (const Value& text : texts->Items()) read.push_back(text.Text());
  return read;
}

std::vector<Reason> ReadSentences(const std::optional<Value>& texts) {
  std::vector<Reason> read;
  for (std::string& text : ReadTexts(texts)) read.push_back({std::move(text)});
  return read;
}

// Reads the reasons why there is no plan, or the planner's limits.
void ReadReasons(const Value& root, PlanResult& result) {
  const bool is_none = result.outcome == Outcome::kNone;
  const std::optional<Value> conflict = root.Find("conflict");
  if (conflict.has_value() != is_none) {
    root.Fail("a conflict is given if and only if the outcome is 'none'");
  }
  result.conflict = ReadSentences(conflict);
  if (is_none && result.conflict.empty()) conflict->Fail("an empty conflict", "at least one");
  const auto find = [&](const std::string& key, bool may_be_given) {
    const std::optional<Value> texts = root.Find(key);
    if (texts && !may_be_given) texts->Fail("not with this outcome");
    return texts;
  };
  result.hypotheses = ReadTexts(find("hypotheses", is_none));
  result.near_misses = ReadSentences(find("near_misses", is_none));
  result.limits = ReadTexts(find("limits", result.outcome == Outcome::kBudget));
}

std::map<std::string, std::int64_t> ReadCounters(const Value& counters) {
  std::map<std::string, std::int64_t> counts;
  for (const auto& [name, value] : counters.Entries()) {
    const double count = value.Number();
    if (std::abs(count) > kLargestCount || count != std::floor(count)) {
      value.Fail("a counter that is no whole number, or too large", "an integer up to 2^53");
    }
    counts[name.Text()] = static_cast<std::int64_t>(count);
  }
  return counts;
}

// Reads what the second phase of planning adds to the steps.
void ReadAugmentation(const Value& root, const domain::Problem& problem, Plan& plan) {
  const std::vector<std::string> names = NamesOf(plan.steps);
  const std::vector<Value> actions = root.At("actions").Items();
  for (std::size_t i = 0; i < actions.size(); ++i) {
    const std::optional<Value> certificate = actions[i].Find("certificate");
    if (certificate) plan.steps[i].certificate = ReadCertificate(*certificate, problem, names);
  }
  for (const Value& value : root.At("verifications").Items()) {
    plan.verifications.push_back(ReadVerification(value, names));
  }
  for (const Value& value : root.At("recoveries").Items()) {
    plan.recoveries.push_back(ReadRecovery(value, names));
  }
  plan.errors = root.At("errors").Integer(0, static_cast<int>(names.size()));
  // A plan with certificates that leaves out the key says that nothing is left open.
  const std::optional<Value> not_covered = root.Find("not_covered");
  if (not_covered || IsCertified(plan)) plan.not_covered = ReadTexts(not_covered);
}

}  // namespace

Json ToJson(const PlanResult& result, const domain::Problem& problem, const std::string& scenario) {
  const Plan& plan = result.plan;
  const std::vector<std::string> names = NamesOf(plan.steps);
  Json verifications = Json::array();
  for (const Verification& verification : plan.verifications) {
    verifications.push_back(ToJson(verification, names));
  }
  Json recoveries = Json::array();
  for (const Recovery& recovery : plan.recoveries) recoveries.push_back(ToJson(recovery, names));
  Json json = {{"format", kFormat},
               {"scenario", scenario},
               {"problem", problem.name},
               {"outcome", kOutcomes[static_cast<std::size_t>(result.outcome)]},
               {"actions", ActionsToJson(plan, problem)},
               {"ordering", OrderingToJson(plan)},
               {"verifications", verifications},
               {"recoveries", recoveries},
               {"errors", plan.errors},
               {"not_covered", NotCovered(problem, plan)}};
  if (plan.homing) json["homing"] = ToJson(*plan.homing);
  if (result.outcome == Outcome::kNone) {
    json["conflict"] = TextsOf(result.conflict);
    json["hypotheses"] = result.hypotheses;
    json["near_misses"] = TextsOf(result.near_misses);
  }
  if (!result.limits.empty()) json["limits"] = result.limits;
  if (result.obstruction) json["obstruction"] = result.obstruction->text;
  json["counters"] = Json::object();
  for (const auto& [name, count] : result.counters) json["counters"][name] = count;
  return json;
}

std::string ScenarioOf(const Document& plan_file) {
  plan_file.RequireFormat(kFormat);
  return plan_file.root().At("scenario").Text();
}

PlanResult ReadPlan(const Document& plan_file, const domain::Problem& problem) {
  plan_file.RequireFormat(kFormat);
  const Value& root = plan_file.root();
  root.AllowOnly({"format",      "scenario",      "problem",    "outcome",     "actions",
                  "ordering",    "verifications", "recoveries", "errors",      "not_covered",
                  "homing",      "conflict",      "hypotheses", "near_misses", "limits",
                  "obstruction", "counters",      "seconds",    "instances",   "check"});
  root.At("scenario").Text();
  PlanResult result;
  result.plan.problem = root.At("problem").Text();
  root.At("problem").OneOf({problem.name});
  result.outcome = static_cast<Outcome>(root.At("outcome").OneOf(kOutcomes));
  const std::vector<Value> actions = root.At("actions").Items();
  for (const Value& action : actions) result.plan.steps.push_back(ReadStep(action, problem));
  CheckNumbering(actions, result.plan.steps);
  result.plan.ordering = ReadOrdering(root.At("ordering"), result.plan.steps);
  ReadAugmentation(root, problem, result.plan);
  if (const auto homing = root.Find("homing")) result.plan.homing = ReadTravel(*homing);
  ReadReasons(root, result);
  if (const auto obstruction = root.Find("obstruction")) {
    result.obstruction = Reason{obstruction->Text()};
  }
  result.counters = ReadCounters(root.At("counters"));
  return result;
}

}  // namespace assay::plan
