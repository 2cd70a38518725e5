#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/check/certificate_claims/claim.h"
#include "sim/report/findings/standing.h"
#include "sim/sweep/database/store.h"
#include "sim/sweep/database/summary.h"

namespace assay::report {

using check::ClaimVerdict;
using check::VerdictCounts;

// The observations of one claim in the trials of a cell, in the claim's unit. A trial counts only
// if the certificate of the claim's step claimed anything in this trial.
struct Observed {
  double least = 0, lower_quartile = 0, median = 0, upper_quartile = 0, greatest = 0;
  StandingCounts verdicts = {};  // of all observations, claimed or not

  // Returns the number of claimed observations, which the five values from `least` to `greatest`
  // summarize.
  std::int64_t claimed() const { return verdicts.Total() - verdicts.Of(Standing::kNotClaimed); }
};

struct ClaimFindings {
  sweep::ClaimRecord claim;
  Observed observed;
};

// The worst verdict on a certificate in all trials, and its trial.
struct WorstVerdict {
  sweep::VerdictRecord verdict;
  std::string about;  // taken from the claim; empty if the claim is unknown
  domain::Dimension dimension = domain::Dimension::kRatio;  // taken from the claim, if it is known
  int trial = 0;
};

// All findings of the trials about the certificate of one step.
struct StepFindings {
  int step = 0;  // position in the order of execution, from 1
  std::string action;
  std::string what;  // like "pickup(peg)"; empty if the plan does not name the action
  StandingCounts counts;
  WorstVerdict worst;
  std::vector<ClaimFindings> claims;

  StandingCounts ObservedClaims() const;  // the sum over all claims
};

// The results of verifications and recoveries in the trials of a cell.
struct RecoveryFindings {
  int signalled = 0;      // signalled errors, in all trials together
  int mended = 0;         // signalled errors after which the plan went on
  int unaided = 0;        // trials that succeeded without a signalled error
  bool verifies = false;  // the plan has verifications
};

struct CellFindings {
  sweep::CellSummary summary;
  RecoveryFindings recovery;
  std::vector<StepFindings> steps;
  // The falsification of the plan. Its worst claims are ordered by step, and its conservatism
  // begins with all errors together.
  std::optional<sweep::FalsificationRecord> falsification = {};
  // The number of the falsification's trial in the sweep; 0 if there is none.
  int falsification_trial = 0;
  // The trials of the same plan without noise. If control_done is 0, there are none.
  int control_done = 0;
  int control_succeeded = 0;

  const sweep::CellRecord& cell() const { return summary.cell; }
  bool is_control() const { return cell().noise == "none"; }
  bool is_falsification() const { return cell().noise == "attack"; }
  bool has_conservatism() const { return falsification && !falsification->conservatism.empty(); }
};

// A trial that failed, or that violated a certificate. Falsifications are left out.
struct FailedTrial {
  int trial = 0;  // number in the sweep, from 1
  int cell = 0;
  std::string outcome;
  std::string reason;
};

// The trials of which pictures are taken, by their numbers in the sweep; 0 if there is none.
struct NotableTrials {
  int best = 0, typical = 0, worst = 0;
};

// All facts of a report, in the database's units.
struct Findings {
  std::string database;  // the path, as the user gave it
  sweep::SweepFacts facts;
  std::vector<sweep::RunRecord> runs;
  std::vector<CellFindings> cells;
  double mean_trial_seconds = 0;
  double planning_seconds = 0;  // the sum over all cells
  NotableTrials notable;
  std::vector<FailedTrial> failures = {};  // the first ones, in the order of their numbers
  std::int64_t failures_in_all = 0;

  int trials() const;  // the number of trials of the whole sweep, done or not
  int done() const;
};

}  // namespace assay::report
