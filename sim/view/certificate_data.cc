#include "sim/view/certificate_data.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "planner/domain/units/units.h"
#include "planner/plan/certificates/error_kind.h"
#include "planner/verify/proof.h"
#include "sim/view/deciding_place.h"
#include "sim/view/pose_data.h"

namespace assay::view {
namespace {

using plan::CertifiedPrecondition;
using Json = nlohmann::ordered_json;

constexpr std::size_t kShownVariables = 6;  // the variables that cost most

// Preconditions of one kind and meaning.
struct ClaimGroup {
  const CertifiedPrecondition* tightest;
  int count = 0;
  int open = 0;  // that are not proved
};

std::vector<ClaimGroup> GroupsOf(const std::vector<CertifiedPrecondition>& claims) {
  std::vector<ClaimGroup> groups;
  for (const CertifiedPrecondition& claim : claims) {
    auto group = std::ranges::find_if(groups, [&](const ClaimGroup& known) {
      return known.tightest->condition == claim.condition &&
             known.tightest->meaning == claim.meaning;
    });
    if (group == groups.end()) group = groups.insert(groups.end(), {&claim});
    if (claim.margin < group->tightest->margin) group->tightest = &claim;
    ++group->count;
    group->open += claim.holds() ? 0 : 1;
  }
  std::ranges::stable_sort(groups, {},
                           [](const ClaimGroup& group) { return group.tightest->margin; });
  return groups;
}

Json RangeData(const Interval& range) { return {range.low, range.high}; }

Json CostsOf(const verify::Proof& proof) {
  Json costs = Json::array();
  for (std::size_t i = 0; i < std::min(proof.variables.size(), kShownVariables); ++i) {
    const verify::VariableInProof& variable = proof.variables[i];
    Json cost = {{"name", variable.name},
                 {"unit", domain::SiUnitOf(variable.dimension).name},
                 {"range", RangeData(variable.range)},
                 {"cost", variable.cost}};
    if (const plan::ErrorKind* kind = plan::ErrorKindOf(variable.name)) {
      cost["meaning"] = kind->meaning;
    }
    if (variable.worst) cost["worst"] = *variable.worst;
    costs.push_back(std::move(cost));
  }
  return costs;
}

std::string StandingOf(const ClaimGroup& group, const plan::PlannedStep& step) {
  if (group.open == 0) return "proved";
  return plan::Absorbs(step.strategy, group.tightest->condition) ? "absorbed" : "open";
}

void AddProof(const verify::Proof& proof, Json& data) {
  if (!proof.is_number) data["nominal"] = proof.nominal;
  data["costs"] = CostsOf(proof);
  if (proof.claim.holds()) return;
  data["refuted"] = proof.IsRefuted();
  if (!proof.remedy) return;
  data["remedy"] = {{"name", proof.remedy->name},
                    {"unit", domain::SiUnitOf(proof.remedy->dimension).name},
                    {"range", RangeData(proof.remedy->range)},
                    {"enough", RangeData(proof.remedy->enough)}};
}

void AddPlace(const std::optional<DecidingPlace>& place, Json& data) {
  if (!place) return;
  Json lines = Json::array();
  for (const auto& [from, to] : place->lines) lines.push_back({ToJson(from), ToJson(to)});
  data["place"] = {{"time", place->time}, {"marked", place->bodies}, {"lines", std::move(lines)}};
}

}  // namespace

Json PreconditionsOf(const Executed& executed, plan::StepId id) {
  const plan::PlannedStep& step = executed.plan.step(id);
  Json all = Json::array();
  if (step.certificate.preconditions.empty()) return all;
  const verify::CertificateProofs proofs(step, executed.plan_file);
  for (const ClaimGroup& group : GroupsOf(step.certificate.preconditions)) {
    const CertifiedPrecondition& claim = *group.tightest;
    Json data = {{"condition", claim.condition.name()},
                 {"meaning", claim.meaning},
                 {"standing", StandingOf(group, step)},
                 {"count", group.count},
                 {"open", group.open},
                 {"unit", domain::SiUnitOf(claim.condition->dimension).name},
                 {"relation", claim.relation == plan::Relation::kLess ? "<" : ">"},
                 {"bound", claim.bound},
                 {"limit", claim.limit},
                 {"margin", claim.margin}};
    if (claim.IsUnborne()) data["unborne"] = true;
    AddProof(proofs.Of(claim), data);
    if (data["standing"] == "open") AddPlace(PlaceOf(claim, id, executed), data);
    all.push_back(std::move(data));
  }
  return all;
}

}  // namespace assay::view
