#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/check/claims/claim.h"
#include "sim/report/sections/standing.h"
#include "sim/sweep/store/store.h"
#include "sim/sweep/store/summary.h"

namespace assay::report {

using check::ClaimVerdict;
using check::VerdictCounts;

// What the trials of a cell observed of one claim, in the trials in which its
// step's certificate claimed anything; in the claim's unit.
struct Observed {
  double least = 0, lower_quartile = 0, median = 0, upper_quartile = 0, greatest = 0;
  StandingCounts verdicts = {};  // of every observation, one that is not claimed included

  // Observations that the five numbers are of.
  std::int64_t claimed() const { return verdicts.Total() - verdicts.Of(Standing::kNotClaimed); }
};

struct ClaimFindings {
  sweep::ClaimRecord claim;
  Observed observed;
};

// The verdict on a certificate in the trial in which it came out worst.
struct WorstVerdict {
  sweep::VerdictRecord verdict;
  std::string about, unit;  // of the claim; empty if it is not known
  int trial = 0;
};

// All that trials say of the certificate of one step.
struct StepFindings {
  int step = 0;  // place in the order of execution, from 1
  std::string action;
  std::string what;  // "pickup(peg)"; empty if the plan does not tell
  StandingCounts counts;
  WorstVerdict worst;
  std::vector<ClaimFindings> claims;

  StandingCounts ObservedClaims() const;  // of all claims together
};

// What verifications and recoveries did in the trials of a cell.
struct RecoveryFindings {
  int signalled = 0;      // errors, in all trials together
  int mended = 0;         // of them, those after which the plan went on
  int unaided = 0;        // trials that succeeded without an error
  bool verifies = false;  // the plan has verifications
};

struct CellFindings {
  sweep::CellSummary summary;
  RecoveryFindings recovery;
  std::vector<StepFindings> steps;
  // The worst claims by step, conservatism of all errors together first.
  std::optional<sweep::AttackRecord> attack = {};
  // Trials without noise of the same plan; 0 done: there are none.
  int control_done = 0;
  int control_succeeded = 0;

  const sweep::CellRecord& cell() const { return summary.cell; }
  bool is_control() const { return cell().noise == "none"; }
  bool is_attack() const { return cell().noise == "attack"; }
  bool has_conservatism() const { return attack && !attack->conservatism.empty(); }
};

// The trials that pictures are taken of.
struct NotableTrials {
  int best = 0, typical = 0,
      worst = 0;  // numbers in the sweep; 0: there is none
};

// All that a report tells, in the database's units.
struct Findings {
  std::string database;  // path, as the user gave it
  sweep::SweepFacts facts;
  std::vector<sweep::RunRecord> runs;
  std::vector<CellFindings> cells;
  double mean_trial_seconds = 0;
  double planning_seconds = 0;  // of all cells
  NotableTrials notable;

  int trials() const;  // of the whole sweep, whether they are done or not
  int done() const;
};

}  // namespace assay::report
