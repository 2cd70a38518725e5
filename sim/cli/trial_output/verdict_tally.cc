#include "sim/cli/trial_output/verdict_tally.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "planner/plan/data/action.h"
#include "sim/cli/options/quantity.h"
#include "sim/cli/plan_output/table.h"
#include "sim/cli/trial_output/json_number.h"

namespace assay::cli {
namespace {

using check::Claim;
using check::VerdictCounts;
using Json = nlohmann::ordered_json;

std::string Place(const Claim& claim) {
  switch (claim.about) {
    case check::Claimed::kBefore:
      return "before: ";
    case check::Claimed::kPrecondition:
      return "";
    case check::Claimed::kAfter:
      return "after: ";
  }
  return "";
}

}  // namespace

VerdictTally::VerdictTally(const plan::Plan& plan) : plan_(plan), counts_(plan.steps.size()) {}

void VerdictTally::Add(const std::vector<Claim>& claims) {
  for (const Claim& claim : claims) claims_.Add(claim.verdict);
  for (const check::CertificateVerdict& verdict : ByStep(claims)) {
    counts_[verdict.step.index()].Add(verdict.verdict);
    AddWorst(verdict.worst);
  }
}

void VerdictTally::Add(plan::StepId step, const VerdictCounts& certificates) {
  counts_[step.index()] += certificates;
}

void VerdictTally::AddClaims(const VerdictCounts& claims) { claims_ += claims; }

void VerdictTally::AddWorst(const Claim& claim) {
  const auto [at, is_new] = worst_.try_emplace(claim.step, claim);
  if (!is_new && check::IsWorse(claim, at->second)) at->second = claim;
}

VerdictCounts VerdictTally::Total() const {
  VerdictCounts total;
  for (const VerdictCounts& counts : counts_) total += counts;
  return total;
}

std::string VerdictTally::Text(const domain::Problem& problem) const {
  Table table({{"step", Align::kRight},
               {"action"},
               {"contained", Align::kRight},
               {"inconclusive", Align::kRight},
               {"violated", Align::kRight},
               {"not claimed", Align::kRight},
               {"worst"}});
  for (const plan::StepId id : plan_.ExecutionOrder()) {
    const VerdictCounts& counts = counts_[id.index()];
    const auto worst = worst_.find(id);
    table.Add({std::to_string(plan_.step(id).executed),
               plan::ShortText(problem, plan_.step(id).action), std::to_string(counts.contained),
               std::to_string(counts.inconclusive), std::to_string(counts.violated),
               std::to_string(counts.not_claimed),
               worst == worst_.end() ? "" : cli::Text(worst->second)});
  }
  return table.Text() + fmt::format(
                            "\n{} claims: {} contained, {} inconclusive, {} violated, {} not "
                            "claimed. The verdict on a step is the verdict on its worst claim.\n",
                            claims_.Total(), claims_.contained, claims_.inconclusive,
                            claims_.violated, claims_.not_claimed);
}

Json VerdictTally::ClaimsToJson() const { return cli::ToJson(claims_); }

Json VerdictTally::ToJson() const { return cli::ToJson(Total()); }

Json VerdictTally::WorstToJson() const {
  Json json = Json::array();
  for (const plan::StepId id : plan_.ExecutionOrder()) {
    const auto worst = worst_.find(id);
    if (worst == worst_.end()) continue;
    Json row = cli::ToJson(plan_, worst->second);
    row["verdicts"] = cli::ToJson(counts_[id.index()]);
    json.push_back(std::move(row));
  }
  return json;
}

Json ToJson(const VerdictCounts& counts) {
  return {{"contained", counts.contained},
          {"inconclusive", counts.inconclusive},
          {"violated", counts.violated},
          {"not_claimed", counts.not_claimed}};
}

std::string Text(const Claim& claim) {
  if (!claim.dimension) return claim.name + ": it does not";
  const Unit unit = ShownUnitOf(*claim.dimension);
  const auto number = [&](double value) { return fmt::format("{:+.3f}", value / unit.factor); };
  return fmt::format("{}{} {} in [{}, {}] {}, gate {:.3f}", Place(claim), claim.name,
                     number(claim.observed), number(claim.predicted.low),
                     number(claim.predicted.high), unit.name, claim.gate / unit.factor);
}

Json ToJson(const plan::Plan& plan, const Claim& claim) {
  return {{"step", plan.step(claim.step).name},
          {"about", check::Name(claim.about)},
          {"claim", claim.name},
          {"unit", claim.UnitName()},
          {"predicted", {OrNull(claim.predicted.low), OrNull(claim.predicted.high)}},
          {"proved", claim.proved},
          {"observed", claim.observed},
          {"margin", claim.margin},
          {"gate", claim.gate},
          {"verdict", check::Name(claim.verdict)}};
}

std::string Text(const plan::Plan& plan, const check::NoiseFloor& gate) {
  if (gate.steps.empty()) return "  not measured\n";
  Table table({{"step", Align::kRight},
               {"id"},
               {"lag mm", Align::kRight},
               {"lag deg", Align::kRight},
               {"penetration mm", Align::kRight}});
  for (const plan::StepId id : plan.ExecutionOrder()) {
    const check::StepNoiseFloor& step = gate.steps[id.index()];
    const auto mm = [](double value) { return fmt::format("{:.4f}", value / kLengthUnit.factor); };
    table.Add({std::to_string(plan.step(id).executed), plan.step(id).name, mm(step.lag),
               fmt::format("{:.5f}", step.lag_turn / kAngleUnit.factor), mm(step.penetration)});
  }
  return table.Text();
}

Json ToJson(const plan::Plan& plan, const check::NoiseFloor& gate) {
  Json json = Json::array();
  if (gate.steps.empty()) return json;
  for (const plan::StepId id : plan.ExecutionOrder()) {
    const check::StepNoiseFloor& step = gate.steps[id.index()];
    Json components = Json::array();
    for (const check::ClaimNoiseFloor& component : step.components) {
      components.push_back({{"about", check::Name(component.about)},
                            {"name", component.name},
                            {"offset", component.offset},
                            {"step_size", component.step_size}});
    }
    json.push_back({{"step", plan.step(id).name},
                    {"lag", step.lag},
                    {"lag_turn", step.lag_turn},
                    {"penetration", step.penetration},
                    {"components", components}});
  }
  return json;
}

std::string Text(const plan::Plan& plan, const check::Noiseless& noiseless,
                 const check::NoiseFloor& gate) {
  std::string text;
  for (const Claim& claim : noiseless.violated) {
    text += fmt::format("violated without any noise: step {}: {}\n", plan.step(claim.step).executed,
                        Text(claim));
  }
  for (const Claim& claim : noiseless.hidden) {
    const Unit unit = ShownUnitOf(claim.dimension.value_or(Dimension::kRatio));
    text += fmt::format(
        "step {}: {}: the noise floor, {:.3f} {}, is wider than the certified set or the "
        "clearance: the plan cannot be tested\n",
        plan.step(claim.step).executed, Text(claim), gate.Floor(claim) / unit.factor, unit.name);
  }
  return text;
}

Json ToJson(const plan::Plan& plan, const check::Noiseless& noiseless) {
  Json json = {{"violated", Json::array()}, {"hidden", Json::array()}};
  for (const Claim& claim : noiseless.violated) json["violated"].push_back(ToJson(plan, claim));
  for (const Claim& claim : noiseless.hidden) json["hidden"].push_back(ToJson(plan, claim));
  return json;
}

}  // namespace assay::cli
