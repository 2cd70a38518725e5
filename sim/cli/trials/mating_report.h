#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "planner/assembly/strategy_reach.h"
#include "planner/finemotion/contacts/mating.h"
#include "sim/check/contacts/margin_ranking.h"
#include "sim/cli/work/mating_task.h"
#include "sim/cli/work/mating_trials.h"
#include "sim/report/fine_motion/mating_page.h"

namespace assay::cli {

// Returns a text for people about a plan of fine motion: a table of its motions, numbered from 1,
// or what stands in the way if there is none. `search` holds the options of the search that made
// the plan.
std::string TextOf(const finemotion::MatingGeometry& geometry,
                   const finemotion::FineMotionPlan& plan,
                   const finemotion::StrategyOptions& search);
// Returns one line about the plan.
std::string SummaryOf(const finemotion::MatingGeometry& geometry,
                      const finemotion::FineMotionPlan& plan);
// Returns the rows of the table of motions.
std::vector<report::MatingSubject::Motion> MotionsOf(const finemotion::FineMotionPlan& plan);
// Returns the fields of mate.schema.json that are about the plan.
nlohmann::ordered_json ToJson(const finemotion::MatingGeometry& geometry,
                              const finemotion::FineMotionPlan& plan);

// Returns one line that states why the arm cannot execute the strategy.
std::string TextOf(const MatingTask& task, const assembly::Unreached& unreached);
nlohmann::ordered_json ToJson(const MatingTask& task, const assembly::Unreached& unreached);

// Trials with a strategy and trials straight in, and what they show about the plan.
struct MatingStudy {
  std::vector<MatedTrial> strategy = {};  // by number
  std::vector<MatedTrial> straight = {};
  double covered = 0;  // multiple of the errors for which the plan is certain
  check::MarginRanking ranking = {};
  std::string replay = {};  // command that repeats a trial when its number is added

  bool Covers(const MatedTrial& trial) const { return trial.scale <= covered; }
  int CoveredFailures() const;
};
std::string TextOf(const MatingStudy& study);
report::MatingSubject::Trials TrialsOf(const MatingStudy& study);
nlohmann::ordered_json ToJson(const MatingStudy& study);

}  // namespace assay::cli
