#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "planner/domain/problem/problem.h"
#include "planner/plan/data/plan.h"
#include "sim/check/certificate_claims/claim.h"
#include "sim/check/noise_floor/noise_floor.h"
#include "sim/check/noise_floor/noiseless.h"

namespace assay::cli {

// Counts the verdicts on a plan's certificates over trials or attempts.
class VerdictTally {
 public:
  explicit VerdictTally(const plan::Plan& plan);

  // Adds the claims of one trial to the report.
  void Add(const std::vector<check::Claim>& claims);
  // Adds the attempts at one step to the report, counted by the verdict on its certificate.
  void Add(plan::StepId step, const check::VerdictCounts& certificates);
  // Adds counts of single claims over all attempts to the report.
  void AddClaims(const check::VerdictCounts& claims);
  // Keeps the claim for the report if it is the worst of its step.
  void AddWorst(const check::Claim& claim);

  check::VerdictCounts Total() const;
  // Returns a row for each step in the order of execution, with the verdicts and the worst claim,
  // and then the verdicts on single claims.
  std::string Text(const domain::Problem& problem) const;
  nlohmann::ordered_json ToJson() const;  // counts over all certificates
  nlohmann::ordered_json ClaimsToJson() const;
  nlohmann::ordered_json WorstToJson() const;  // the worst claim of each step

 private:
  const plan::Plan& plan_;
  std::vector<check::VerdictCounts> counts_;  // by StepId
  check::VerdictCounts claims_;
  std::map<plan::StepId, check::Claim> worst_;
};

nlohmann::ordered_json ToJson(const check::VerdictCounts& counts);

// Returns a text for people about a claim, such as "y of peg +0.038 in [-0.025, +0.025] mm, gate
// 0.016".
std::string Text(const check::Claim& claim);
nlohmann::ordered_json ToJson(const plan::Plan& plan, const check::Claim& claim);

// Returns a text for people about the noise floor, with a row for each step.
std::string Text(const plan::Plan& plan, const check::NoiseFloor& gate);
nlohmann::ordered_json ToJson(const plan::Plan& plan, const check::NoiseFloor& gate);

// Returns a text for people about the plan's defects that show before any error is drawn; empty if
// there are none.
std::string Text(const plan::Plan& plan, const check::Noiseless& noiseless,
                 const check::NoiseFloor& gate);
nlohmann::ordered_json ToJson(const plan::Plan& plan, const check::Noiseless& noiseless);

}  // namespace assay::cli
