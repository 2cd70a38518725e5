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

// What `mate` tells of a plan: for people a table of its motions, numbered from 1, and what is in
// the way if there is none; for programs the fields of mate.schema.json. `search`: with which it
// was searched for.
std::string TextOf(const finemotion::MatingGeometry& geometry,
                   const finemotion::FineMotionPlan& plan,
                   const finemotion::StrategyOptions& search);
std::string SummaryOf(
    const finemotion::MatingGeometry& geometry,
    const finemotion::FineMotionPlan& plan);  // a line of it, and the table's rows
std::vector<report::MatingSubject::Motion> MotionsOf(const finemotion::FineMotionPlan& plan);
nlohmann::ordered_json ToJson(const finemotion::MatingGeometry& geometry,
                              const finemotion::FineMotionPlan& plan);

// Why the arm cannot execute the strategy, a line.
std::string TextOf(const MatingTask& task, const assembly::Unreached& unreached);
nlohmann::ordered_json ToJson(const MatingTask& task, const assembly::Unreached& unreached);

// Trials with a strategy and straight in, and what they say of the plan.
struct MatingStudy {
  std::vector<MatedTrial> strategy = {};  // by number
  std::vector<MatedTrial> straight = {};
  double covered = 0;  // multiple of the errors for which the plan is certain
  check::MarginRanking ranking = {};
  std::string replay = {};  // command that the number of a trial completes

  bool Covers(const MatedTrial& trial) const { return trial.scale <= covered; }
  int CoveredFailures() const;
};
std::string TextOf(const MatingStudy& study);
report::MatingSubject::Trials TrialsOf(const MatingStudy& study);
nlohmann::ordered_json ToJson(const MatingStudy& study);

}  // namespace assay::cli
