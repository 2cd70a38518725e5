#include "sim/cli/tree_output/tree_trial_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "sim/cli/options/quantity.h"
#include "sim/cli/plan_output/table.h"
#include "sim/sweep/database/wilson.h"

namespace assay::cli {
namespace {

using execution::Leaf;
using execution::TreeTrial;
using execution::TrialOutcome;
using Json = nlohmann::ordered_json;

// The counts over several trials of one plan tree.
struct TreeTally {
  int trials = 0;
  int reached = 0;
  int called = 0;            // trials in which a person was called as planned
  double greatest_tilt = 0;  // radians

  void Add(const TreeTrial& trial) {
    ++trials;
    if (trial.outcome == TrialOutcome::kSucceeded) ++reached;
    if (trial.outcome == TrialOutcome::kOperatorCalled && !trial.IsFailed()) ++called;
    greatest_tilt = std::max(greatest_tilt, trial.greatest_tilt);
  }
};

std::string TiltText(const TreeTally& tally) {
  return tally.trials > 0 ? fmt::format("{:.3f} deg", tally.greatest_tilt / kDegree) : "";
}

TreeTally TallyOf(const Leaf& leaf, const TreeStudy& study) {
  TreeTally tally;
  for (const TreeTrial& trial : study.trials) {
    if (leaf.IsOn(trial.walk)) tally.Add(trial);
  }
  return tally;
}

TreeTally TallyOf(const TreeStudy& study) {
  TreeTally tally;
  for (const TreeTrial& trial : study.trials) tally.Add(trial);
  return tally;
}

std::map<std::string, int> Failures(const TreeStudy& study) {
  std::map<std::string, int> failures;
  for (const TreeTrial& trial : study.trials) {
    if (trial.IsFailed()) ++failures[std::string(Name(trial.outcome))];
  }
  return failures;
}

std::string ReplayCommand(const TreeStudy& study, int number) {
  return study.command.Again(study.command.seed.value(), number).Text();
}

int CountFlipped(const TreeStudy& study, bool is_audited) {
  return static_cast<int>(std::ranges::count_if(study.trials, [&](const TreeTrial& trial) {
    return trial.walk.is_flipped && (!is_audited || !trial.walk.false_claims.empty());
  }));
}

// Returns a row for each leaf. Columns for outcomes that cannot occur are left out.
std::string LeafTable(const TreeStudy& study) {
  std::vector<Table::Column> columns = {
      {"leaf"}, {"trials", Align::kRight}, {"reached", Align::kRight}};
  const bool is_operator_called = TallyOf(study).called > 0;
  if (is_operator_called) columns.push_back({"operator called", Align::kRight});
  if (study.can_spill) columns.push_back({"greatest tilt", Align::kRight});
  Table table(std::move(columns));
  constexpr std::size_t kMostMissed = 4;  // leaves without trials that are listed
  std::size_t missed = 0;
  for (const Leaf& leaf : study.leaves) {
    const TreeTally tally = TallyOf(leaf, study);
    if (tally.trials == 0 && ++missed > kMostMissed) continue;
    std::vector<std::string> row = {leaf.Text(), fmt::format("{}", tally.trials),
                                    fmt::format("{}", tally.reached)};
    if (is_operator_called) row.push_back(fmt::format("{}", tally.called));
    if (study.can_spill) row.push_back(TiltText(tally));
    table.Add(std::move(row));
  }
  if (missed <= kMostMissed) return table.Text();
  return table.Text() +
         fmt::format("and {} more leaves that were not reached\n", missed - kMostMissed);
}

const std::string& WordsOf(const std::string& action, const TreeStudy& study) {
  const auto words = study.words.find(action);
  return words == study.words.end() ? action : words->second;
}

// Returns the reason of a failed trial with the action in words. An example of a reason is
// "plan1-action_3(): a finger touches the table".
std::string ReasonOf(const TreeTrial& trial, const TreeStudy& study) {
  const std::size_t end = trial.reason.find(": ");
  if (end == std::string::npos) return trial.reason;
  return WordsOf(trial.reason.substr(0, end), study) + trial.reason.substr(end);
}

// Returns the leaves that no world leads to, except those that wrong sensing led to, and the faults
// that were injected.
std::string FaultText(const TreeStudy& study) {
  std::string text;
  for (std::size_t i = 0; i < study.unreachable.size(); ++i) {
    if (study.unreachable[i].empty() || TallyOf(study.leaves[i], study).trials > 0) continue;
    text += fmt::format("unreachable: {}: {}\n", study.leaves[i].Text(), study.unreachable[i]);
  }
  for (const TreeTrial& trial : study.trials) {
    if (!trial.fault.empty()) text += fmt::format("trial {}: {}\n", trial.number, trial.fault);
  }
  return text;
}

std::string StepTable(const TreeTrial& trial, const TreeStudy& study) {
  Table table({{"step", Align::kRight}, {"action"}, {"seconds", Align::kRight}});
  for (std::size_t i = 0; i < trial.walk.steps.size(); ++i) {
    const execution::WalkedStep& step = trial.walk.steps[i];
    table.Add(
        {fmt::format("{}", i + 1), WordsOf(step.action, study), fmt::format("{:.1f}", step.end)});
  }
  return table.Text();
}

Json TreeTrialJson(const TreeTrial& trial) {
  Json json = {{"trial", trial.number},      {"outcome", trial.OutcomeName()},
               {"reason", trial.reason},     {"mishap", trial.fault},
               {"goal", trial.is_goal_true}, {"greatest_tilt", trial.greatest_tilt / kDegree},
               {"spilled", trial.spilled},   {"fallen", trial.fallen}};
  json["collisions"] = Json::array();
  for (const execution::CollisionRecord& collision : trial.collisions) {
    json["collisions"].push_back(
        {{"time", collision.time}, {"robot", collision.robot}, {"other", collision.other}});
  }
  json["simulated"] = trial.duration;
  json["steps"] = Json::array();
  for (const execution::WalkedStep& step : trial.walk.steps) {
    json["steps"].push_back({{"action", step.action}, {"end", step.end}});
  }
  json["branches"] = Json::array();
  for (const execution::TakenBranch& branch : trial.walk.branches) {
    json["branches"].push_back({{"outcome", branch.text}, {"flipped", branch.is_flipped}});
  }
  json["false_claims"] = Json::array();
  for (const execution::FalseClaim& claim : trial.walk.false_claims) {
    json["false_claims"].push_back({{"after_step", claim.step},
                                    {"atom", claim.atom},
                                    {"claimed", claim.claimed},
                                    {"true", claim.is_true}});
    if (!claim.truth.empty()) json["false_claims"].back()["truth"] = claim.truth;
  }
  return json;
}

std::string FailuresText(const TreeStudy& study) {
  constexpr int kMostListed = 3;
  std::string text;
  int listed = 0;
  for (const TreeTrial& trial : study.trials) {
    if (!trial.IsFailed() || ++listed > kMostListed) continue;
    text += fmt::format("trial {}: {}: {}{}\nto repeat it: {}\n", trial.number, Name(trial.outcome),
                        ReasonOf(trial, study), trial.is_goal_true ? "; the goal is true" : "",
                        ReplayCommand(study, trial.number));
  }
  if (listed > kMostListed) text += fmt::format("and {} more\n", listed - kMostListed);
  for (const auto& [name, count] : Failures(study)) text += fmt::format("{}: {}\n", name, count);
  return text;
}

}  // namespace

int TreeStudy::Failed() const {
  return static_cast<int>(std::ranges::count_if(trials, &TreeTrial::IsFailed));
}

std::string TextOf(const TreeStudy& study) {
  std::string text = study.trials.size() == 1 ? StepTable(study.trials.front(), study) + "\n" : "";
  text += LeafTable(study) + "\n" + FaultText(study) + FailuresText(study);
  const TreeTally all = TallyOf(study);
  const Interval rate = sweep::WilsonInterval(all.reached, all.trials);
  text += fmt::format(
      "{} of {} trials reached the goal without a collision, a spill or a false claim (95 % "
      "interval of the rate: {:.1f} to {:.1f} %)\n",
      all.reached, all.trials, 100 * rate.low, 100 * rate.high);
  if (all.called > 0) {
    text += fmt::format("{} ended with a call of the operator, as the tree demands\n", all.called);
  }
  const auto unreached = std::ranges::count_if(
      study.leaves, [&](const Leaf& leaf) { return TallyOf(leaf, study).trials == 0; });
  text +=
      fmt::format("{} of {} leaves were reached",
                  study.leaves.size() - static_cast<std::size_t>(unreached), study.leaves.size());
  text += study.can_spill
              ? fmt::format("; the greatest tilt of parts that can spill was {:.3f} degrees\n",
                            all.greatest_tilt / kDegree)
              : "\n";
  if (study.command.sensing_errors > 0) {
    text += fmt::format("sensor results were made wrong in {} trials; the audit noticed it in {}\n",
                        CountFlipped(study, false), CountFlipped(study, true));
  }
  return text;
}

nlohmann::ordered_json ToJson(const TreeStudy& study) {
  const TreeTally all = TallyOf(study);
  Json json = {{"outcome", study.Failed() == 0 ? "reached" : "failed"},
               {"scenario", study.command.input.string()},
               {"seed", study.command.seed.value()},
               {"sensing_errors", study.command.sensing_errors},
               {"trials", all.trials},
               {"reached", all.reached},
               {"operator_called", all.called},
               {"failed", Json(Failures(study))},
               {"greatest_tilt", all.greatest_tilt / kDegree},
               {"flipped", CountFlipped(study, false)},
               {"flipped_and_told", CountFlipped(study, true)}};
  if (json["failed"].is_null()) json["failed"] = Json::object();
  json["leaves"] = Json::array();
  for (std::size_t i = 0; i < study.leaves.size(); ++i) {
    const Leaf& leaf = study.leaves[i];
    const TreeTally tally = TallyOf(leaf, study);
    json["leaves"].push_back(
        {{"outcomes", leaf.Text()},
         {"unreachable", study.unreachable.empty() ? "" : study.unreachable[i]},
         {"trials", tally.trials},
         {"reached", tally.reached},
         {"operator_called", tally.called},
         {"greatest_tilt", tally.greatest_tilt / kDegree}});
  }
  json["replay"] = Json::array();
  json["rows"] = Json::array();
  for (const TreeTrial& trial : study.trials) {
    if (trial.IsFailed()) json["replay"].push_back(ReplayCommand(study, trial.number));
    json["rows"].push_back(TreeTrialJson(trial));
  }
  json["seconds"] = study.seconds;
  return json;
}

}  // namespace assay::cli
