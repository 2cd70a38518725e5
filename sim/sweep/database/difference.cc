#include "sim/sweep/database/difference.h"

#include <fmt/format.h>

#include <map>

namespace assay::sweep {
namespace {

// All values of a record by name. Numbers are written so that they read back to the same bits.
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

std::string TextOf(const VerdictCounts& counts) {
  return fmt::format("{} contained, {} inconclusive, {} violated, {} not claimed", counts.contained,
                     counts.inconclusive, counts.violated, counts.not_claimed);
}

Fields FieldsOf(const TrialRecord& record) {
  Fields fields = {{"noise", record.noise},
                   {"outcome", record.outcome},
                   {"reason", record.reason},
                   {"simulated", fmt::format("{}", record.simulated)},
                   {"steps of the engine", fmt::format("{}", record.steps)},
                   {"errors signalled", fmt::format("{}", record.errors_signalled)},
                   {"recovered", fmt::format("{}", record.recovered)},
                   {"operator called", fmt::format("{}", record.operator_called)},
                   {"warnings", record.warnings},
                   {"certificates", TextOf(record.counts)}};
  for (const VerdictRecord& verdict : record.verdicts) AddVerdict(verdict, fields);
  for (const ObservationRecord& observation : record.observations) {
    fields["observed " + observation.claim] = fmt::format("{}", observation.observed);
  }
  return fields;
}

void AddWorst(const WorstClaimRecord& worst, Fields& fields) {
  fields["worst " + worst.claim] =
      fmt::format("{} in {} of [{}, {}], margin {}, gate {}, {}, attempt {} ({}), noise {}",
                  worst.observed, domain::SiUnitOf(worst.dimension).name, worst.low, worst.high,
                  worst.margin, worst.gate, worst.verdict, worst.attempt, worst.phase, worst.noise);
}

void AddExample(const CounterexampleRecord& example, Fields& fields) {
  fields[fmt::format("counterexample {}", example.number)] = fmt::format(
      "{}: {} {} of [{}, {}], margin {}, gate {}, noise {}, steps {}, {}, "
      "multiple {}",
      example.claim, example.observed, domain::SiUnitOf(example.dimension).name, example.low,
      example.high, example.margin, example.gate, example.noise, example.steps,
      example.replayed ? "replayed" : "not replayed", example.multiple);
}

std::string TextOf(const std::optional<double>& value) {
  return value ? fmt::format("{}", *value) : "none";
}

Fields FieldsOf(const FalsificationRecord& record) {
  Fields fields = {{"attempts", fmt::format("{}", record.attempts)},
                   {"certificates of attempts", TextOf(record.certificates)},
                   {"claims", TextOf(record.claims)}};
  for (const WorstClaimRecord& worst : record.worst) AddWorst(worst, fields);
  for (const CounterexampleRecord& example : record.counterexamples) AddExample(example, fields);
  for (const ConservatismRecord& ratio : record.conservatism) {
    fields["conservatism for " + ratio.variable] =
        fmt::format("guaranteed {}, broken {}, ratio {}", ratio.guaranteed, TextOf(ratio.broken),
                    TextOf(ratio.ratio));
  }
  return fields;
}

std::string ValueIn(const Fields& fields, const std::string& name) {
  const auto found = fields.find(name);
  return found == fields.end() ? "nothing" : found->second;
}

std::vector<std::string> Different(const Fields& before, const Fields& after) {
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

}  // namespace

std::vector<std::string> Differences(const TrialRecord& stored, const TrialRecord& again) {
  return Different(FieldsOf(stored), FieldsOf(again));
}

std::vector<std::string> Differences(const FalsificationRecord& stored,
                                     const FalsificationRecord& again) {
  return Different(FieldsOf(stored), FieldsOf(again));
}

}  // namespace assay::sweep
