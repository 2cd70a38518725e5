#include "sim/sweep/difference.h"

#include <fmt/format.h>

#include <map>

namespace assay::sweep {
namespace {

// Everything in a record by its name. Numbers are written so that they read back as the same ones.
using Fields = std::map<std::string, std::string>;

void AddVerdict(const VerdictRecord& verdict, Fields& fields) {
  const std::string step = fmt::format("step {}: ", verdict.step);
  fields[step + "verdict"] = verdict.verdict;
  fields[step + "worst claim"] = verdict.claim;
  fields[step + "observed"] = fmt::format("{}", verdict.observed);
  fields[step + "predicted"] = fmt::format("[{}, {}]", verdict.low, verdict.high);
  fields[step + "margin"] = fmt::format("{}", verdict.margin);
  fields[step + "gate"] = fmt::format("{}", verdict.gate);
}

Fields FieldsOf(const TrialRecord& record) {
  const VerdictCounts& counts = record.counts;
  Fields fields = {
      {"noise", record.noise},
      {"outcome", record.outcome},
      {"reason", record.reason},
      {"simulated", fmt::format("{}", record.simulated)},
      {"steps of the engine", fmt::format("{}", record.steps)},
      {"errors signalled", fmt::format("{}", record.errors_signalled)},
      {"recovered", fmt::format("{}", record.recovered)},
      {"operator called", fmt::format("{}", record.operator_called)},
      {"warnings", record.warnings},
      {"certificates",
       fmt::format("{} contained, {} inconclusive, {} violated, {} not claimed", counts.contained,
                   counts.inconclusive, counts.violated, counts.not_claimed)}};
  for (const VerdictRecord& verdict : record.verdicts) AddVerdict(verdict, fields);
  for (const ObservationRecord& observation : record.observations) {
    fields["observed " + observation.claim] = fmt::format("{}", observation.observed);
  }
  return fields;
}

std::string ValueIn(const Fields& fields, const std::string& name) {
  const auto found = fields.find(name);
  return found == fields.end() ? "nothing" : found->second;
}

}  // namespace

std::vector<std::string> Differences(const TrialRecord& stored, const TrialRecord& again) {
  const Fields before = FieldsOf(stored);
  const Fields after = FieldsOf(again);
  Fields names = before;
  names.insert(after.begin(), after.end());
  std::vector<std::string> differences;
  for (const auto& [name, ignored] : names) {
    const std::string first = ValueIn(before, name);
    const std::string second = ValueIn(after, name);
    if (first != second) differences.push_back(fmt::format("{}: {} and {}", name, first, second));
  }
  return differences;
}

}  // namespace assay::sweep
