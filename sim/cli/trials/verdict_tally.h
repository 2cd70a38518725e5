#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "planner/plan/data/plan.h"
#include "sim/check/claims/claim.h"
#include "sim/check/claims/honesty_gate.h"
#include "sim/check/claims/noiseless.h"

namespace assay::cli {

// How the certificates of a plan came out, over trials or attempts.
class VerdictTally {
 public:
  explicit VerdictTally(const plan::Plan& plan);

  // The claims of one trial.
  void Add(const std::vector<check::Claim>& claims);
  // So many attempts at one step; so many claims in all attempts.
  void Add(plan::StepId step, const check::VerdictCounts& certificates);
  void AddClaims(const check::VerdictCounts& claims);
  // Keeps it, if it is the worst of its step.
  void AddWorst(const check::Claim& claim);

  check::VerdictCounts Total() const;
  // A row for each step, in the order of execution: the verdicts and the worst claim; and how the
  // single claims came out.
  std::string Text(const std::vector<std::string>& actions) const;
  nlohmann::ordered_json ToJson() const;  // the counts of all certificates
  nlohmann::ordered_json ClaimsToJson() const;
  nlohmann::ordered_json WorstToJson() const;  // the worst claim of each step

 private:
  const plan::Plan& plan_;
  std::vector<check::VerdictCounts> counts_;  // by StepId
  check::VerdictCounts claims_;
  std::map<plan::StepId, check::Claim> worst_;
};

nlohmann::ordered_json ToJson(const check::VerdictCounts& counts);

// "y of peg +0.038 in [-0.025, +0.025] mm, gate 0.016".
std::string Text(const check::Claim& claim);
nlohmann::ordered_json ToJson(const plan::Plan& plan, const check::Claim& claim);

// What the engine cannot tell from nothing, a row for each step.
std::string Text(const plan::Plan& plan, const check::HonestyGate& gate);
nlohmann::ordered_json ToJson(const plan::Plan& plan, const check::HonestyGate& gate);

// What is wrong with a plan before any error is drawn; empty: nothing.
std::string Text(const plan::Plan& plan, const check::Noiseless& noiseless,
                 const check::HonestyGate& gate);
nlohmann::ordered_json ToJson(const plan::Plan& plan, const check::Noiseless& noiseless);

}  // namespace assay::cli
