#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

#include "planner/assembly/strategy_reach.h"
#include "planner/finemotion/strategy_search/mating.h"
#include "sim/cli/tasks/mating_task.h"
#include "sim/report/fine_motion/mating_page.h"

namespace assay::cli {

// Returns the names of contacts, in their order.
std::vector<std::string> NamesOf(std::span<const finemotion::ContactKey> keys);

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
// Returns the fields of mate.schema.json that are about the plan of fine motion.
nlohmann::ordered_json ToJson(const finemotion::MatingGeometry& geometry,
                              const finemotion::FineMotionPlan& plan);

// Returns one line that states why the arm cannot execute the strategy.
std::string TextOf(const MatingTask& task, const assembly::Unreached& unreached);
nlohmann::ordered_json ToJson(const MatingTask& task, const assembly::Unreached& unreached);

}  // namespace assay::cli
