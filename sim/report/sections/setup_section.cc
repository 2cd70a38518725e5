#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <ranges>

#include "sim/report/html/data_table.h"
#include "sim/report/numbers/figures.h"
#include "sim/report/sections/section.h"

namespace assay::report {
namespace {

std::string Fact(const sweep::SweepFacts& facts, const std::string& key) {
  const auto found = facts.find(key);
  return found == facts.end() ? "" : found->second;
}

void AddFact(Element& facts, const std::string& name, const std::string& value) {
  if (value.empty()) return;
  facts.Add("dt", name);
  facts.Add("dd", value);
}

Element Facts(const Findings& findings) {
  Element facts("dl");
  facts.Set("class", "facts");
  AddFact(facts, "database", findings.database);
  AddFact(facts, "sweep file", Fact(findings.facts, "path"));
  std::vector<std::string> scenarios;
  for (const auto& [key, value] : findings.facts) {
    if (key.starts_with("scenario ")) scenarios.push_back(key.substr(9));
  }
  AddFact(facts, "scenario files", fmt::format("{}", fmt::join(scenarios, ", ")));
  AddFact(facts, "version of assay", Fact(findings.facts, "version"));
  AddFact(facts, "time of planning", DurationText(findings.planning_seconds));
  if (findings.done() > 0) {
    AddFact(facts, "time of a trial", DurationText(findings.mean_trial_seconds) + " on average");
  }
  return facts;
}

Element RunTable(const Findings& findings) {
  DataTable table("Runs of the program that wrote this database", {{"started"},
                                                                   {"shard"},
                                                                   {"threads", "number"},
                                                                   {"version"},
                                                                   {"machine"},
                                                                   {"cores", "number"},
                                                                   {"system"}});
  constexpr std::size_t kMostRuns = 50;
  for (const sweep::RunRecord& run : findings.runs | std::views::take(kMostRuns)) {
    table.AddRow({Words(run.started), Words(run.shard), Words(std::to_string(run.jobs)),
                  Words(run.version), Words(run.machine), Words(std::to_string(run.cores)),
                  Words(run.os)});
  }
  return table.Take();
}

}  // namespace

Element Setup(const Subject& subject) {
  const Findings& findings = subject.findings;
  Element section("div");
  section.Add(Facts(findings));
  if (!findings.runs.empty()) section.Add(RunTable(findings));
  section.Add("h3", "The sweep file");
  section.Add("pre", Fact(findings.facts, "text")).Set("tabindex", "0");
  return section;
}

}  // namespace assay::report
