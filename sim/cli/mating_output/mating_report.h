#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "sim/check/contact_sequences/margin_ranking.h"
#include "sim/cli/tasks/mating_trials.h"
#include "sim/report/fine_motion/mating_page.h"

namespace assay::cli {

// Trials with a strategy, trials with a straight motion, and what these trials show about the plan.
struct MatingStudy {
  std::vector<MatedTrial> strategy = {};  // by number
  std::vector<MatedTrial> straight = {};
  double covered = 0;  // multiple of the errors for which the plan is certain
  check::MarginRanking ranking = {};
  std::string replay = {};  // command that repeats a trial when its number is added

  bool Covers(const MatedTrial& trial) const { return trial.scale <= covered; }
  int CoveredFailures() const;
};

// Returns a text for people about the trials of a mating.
std::string TextOf(const MatingStudy& study);
// Returns what the trials show, for the page about the mating.
report::MatingSubject::Trials TrialsOf(const MatingStudy& study);
nlohmann::ordered_json ToJson(const MatingStudy& study);

}  // namespace assay::cli
