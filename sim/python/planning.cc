#include "sim/python/planning.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "planner/base/input_files/quotation.h"
#include "planner/plan/plan_files/json_layout.h"
#include "planner/plan/plan_files/plan_file.h"
#include "planner/verify/proof.h"
#include "sim/cli/budget_output/budgeted_plan.h"
#include "sim/cli/command_line/usage_error.h"
#include "sim/cli/options/resolver_option.h"
#include "sim/cli/plan_output/explanation.h"
#include "sim/cli/plan_output/plan_report.h"
#include "sim/cli/plan_output/plan_text.h"
#include "sim/python/refused.h"

namespace assay::python {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

void RequireNames(const char* what, const std::vector<std::string>& names,
                  const std::vector<std::string>& allowed) {
  for (const std::string& name : names) {
    if (std::ranges::count(allowed, name) > 0) continue;
    throw cli::UsageError(
        fmt::format("there is no {} {}; allowed: {}", what, Quote(name), fmt::join(allowed, ", ")));
  }
}

scenario::Overrides OverridesFrom(const PlanSettings& settings) {
  if (!(settings.error_scale >= 0 && std::isfinite(settings.error_scale))) {
    throw cli::UsageError(
        fmt::format("the error scale is {}; allowed: 0 or more", settings.error_scale));
  }
  scenario::Overrides overrides{.clearance = settings.clearance,
                                .error_scale = settings.error_scale};
  if (settings.resolvers) {
    RequireNames("resolver", *settings.resolvers, domain::ResolverNames());
    overrides.resolvers = cli::ResolversFrom(*settings.resolvers);
  }
  return overrides;
}

std::optional<sweep::RunCommand> CommandOf(const PlanSettings& settings) {
  if (settings.clearance || settings.budget) return std::nullopt;
  return sweep::RunCommand{.input = settings.scenario,
                           .propagation = settings.propagation,
                           .resolvers = settings.resolvers.value_or(std::vector<std::string>{}),
                           .error_scale = settings.error_scale,
                           .models = ModelPathOf(settings.models)};
}

Json ProofToJson(const verify::Proof& proof) {
  Json variables = Json::array();
  for (const verify::VariableInProof& variable : proof.variables) {
    variables.push_back({{"variable", variable.name},
                         {"unit", domain::SiUnitOf(variable.dimension).name},
                         {"low", variable.range.low},
                         {"high", variable.range.high},
                         {"worst", variable.worst ? Json(*variable.worst) : Json()},
                         {"cost", variable.cost}});
  }
  return {{"nominal", proof.nominal},
          {"unit", domain::SiUnitOf(proof.claim.condition->dimension).name},
          {"variables", variables}};
}

}  // namespace

domain::ModelPath ModelPathOf(const std::vector<fs::path>& folders) {
  domain::ModelPath models;
  for (const fs::path& folder : folders) models.Append(folder);
  return models;
}

void RequireSettings(const PlanSettings& settings) {
  RequireNames("propagation", {settings.propagation}, {"sound", "paper"});
  if (settings.budget.value_or(1) >= 1) return;
  throw cli::UsageError(fmt::format("the budget is {}; allowed: 1 or more", *settings.budget));
}

Document LoadScenario(const PlanSettings& settings) {
  Document document = Document::Load(settings.scenario);
  document.RequireFormat("assay-scenario/1");
  return document;
}

execution::WorldPlanning WorldPlanningFrom(const PlanSettings& settings) {
  execution::WorldPlanning planning{.overrides = OverridesFrom(settings)};
  if (settings.budget) planning.planner.partial_plans = *settings.budget;
  if (settings.propagation == "paper") {
    planning.uncertainty.propagation = uncertainty::Propagation::kPaper;
  }
  return planning;
}

PlanHandle::PlanHandle(cli::PlannedProblem planned, std::optional<sweep::RunCommand> command)
    : planned_(std::move(planned)), command_(std::move(command)) {}

std::shared_ptr<const PlanHandle> PlanHandle::Make(const PlanSettings& settings) {
  RequireSettings(settings);
  const Document document = LoadScenario(settings);
  const execution::WorldPlanning planning = WorldPlanningFrom(settings);
  cli::PlannedProblem planned = cli::MakePlan(
      document, scenario::Read(document, ModelPathOf(settings.models), planning.overrides),
      planning.planner, planning.uncertainty);
  if (planned.result.outcome != Outcome::kFound) {
    throw Refused{cli::ExitCodeOf(planned.result.outcome),
                  cli::Text(planned.problem, planned.result),
                  std::make_shared<const Json>(
                      plan::ToJson(planned.result, planned.problem, planned.scenario))};
  }
  return std::shared_ptr<const PlanHandle>(new PlanHandle(std::move(planned), CommandOf(settings)));
}

std::shared_ptr<const PlanHandle> PlanHandle::Read(const fs::path& plan_file,
                                                   const std::vector<fs::path>& models) {
  const domain::ModelPath path = ModelPathOf(models);
  cli::PlannedProblem planned = cli::ReadPlan(Document::Load(plan_file), path);
  return std::shared_ptr<const PlanHandle>(
      new PlanHandle(std::move(planned), sweep::RunCommand{.input = plan_file, .models = path}));
}

std::shared_ptr<const PlanHandle> PlanHandle::OfWorld(cli::PlannedProblem planned) {
  return std::shared_ptr<const PlanHandle>(new PlanHandle(std::move(planned), std::nullopt));
}

Json PlanHandle::ToJson() const {
  return plan::ToJson(planned_.result, planned_.problem, planned_.scenario);
}

std::string PlanHandle::FileText() const { return plan::LaidOut(ToJson()); }

std::string PlanHandle::Text() const { return cli::Text(planned_.problem, planned_.result); }

std::string PlanHandle::Explanation(int executed) const {
  const std::vector<plan::StepId> order = plan().ExecutionOrder();
  const plan::StepId step = order.at(static_cast<std::size_t>(executed) - 1);
  const std::string text = cli::Explanation(planned_.problem, plan(), step, planned_.file());
  if (!Checked().flaws.empty()) return text;
  return text + cli::UnprovedWaysText(planned_.problem, plan(), step);
}

Json PlanHandle::Proofs() const {
  Json steps = Json::array();
  for (const plan::StepId id : plan().ExecutionOrder()) {
    const plan::PlannedStep& step = plan().step(id);
    const verify::CertificateProofs proofs(step, planned_.file());
    Json& rows = steps.emplace_back(Json::array());
    for (const plan::CertifiedPrecondition& claim : step.certificate.preconditions) {
      rows.push_back(ProofToJson(proofs.Of(claim)));
    }
  }
  return steps;
}

Json PlanHandle::Budget(const std::vector<std::string>& front) const {
  return cli::ToJson(cli::BudgetOf(planned_, front), plan());
}

const plan::CheckReport& PlanHandle::Checked() const {
  const std::lock_guard lock(mutex_);
  if (!report_) report_ = cli::CheckPlan(planned_);
  return *report_;
}

Json PlanHandle::CheckedToJson() const {
  const plan::CheckReport& report = Checked();
  Json json = cli::ToJson(plan(), report);
  json["text"] = cli::Text(plan(), report);
  return json;
}

Json Described(const PlanSettings& settings) {
  const Document document = LoadScenario(settings);
  const domain::Problem problem =
      scenario::ReadWorlds(document, ModelPathOf(settings.models), OverridesFrom(settings)).front();
  Json json = {{"name", problem.name},
               {"title", problem.title},
               {"needs_tree", execution::NeedsATree(document)},
               {"clearance", problem.clearance},
               {"sensors", problem.sensors}};
  for (const domain::Part& part : problem.parts) json["parts"].push_back(part.name);
  json["resolvers"] = Json::array();
  for (const domain::ResolverKind kind : problem.resolvers) {
    json["resolvers"].push_back(domain::ResolverNames()[static_cast<std::size_t>(kind)]);
  }
  return json;
}

}  // namespace assay::python
