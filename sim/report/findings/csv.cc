#include "sim/report/findings/csv.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <string_view>

#include "sim/report/findings/command.h"
#include "sim/sweep/database/wilson.h"

namespace assay::report {
namespace {

// Writes a file row by row.
class Csv {
 public:
  Csv(std::string name, std::string_view columns) : file_{std::move(name), ""} {
    file_.text = fmt::format("{}\n", columns);
  }

  template <class... Values>
  void Add(const Values&... values) {
    (Append(Text(values)), ...);
    file_.text.back() = '\n';
  }

  CsvFile Take() { return std::move(file_); }

 private:
  // Appends an entry and a comma after it.
  void Append(const std::string& text) {
    file_.text += text;
    file_.text += ',';
  }

  static std::string Text(double value) {
    return std::isnan(value) ? "" : fmt::format("{}", value);
  }
  static std::string Text(const std::optional<double>& value) { return value ? Text(*value) : ""; }
  static std::string Text(int value) { return std::to_string(value); }
  static std::string Text(std::int64_t value) { return std::to_string(value); }
  static std::string Text(domain::Dimension value) {
    return std::string(domain::SiUnitOf(value).name);
  }
  static std::string Text(bool value) { return value ? "1" : "0"; }
  static std::string Text(std::string_view value) {
    if (value.find_first_of(",\"\r\n") == value.npos) return std::string(value);
    std::string quoted = "\"";
    for (const char c : value) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
  }
  static std::string Text(const std::string& value) { return Text(std::string_view(value)); }

  CsvFile file_;
};

CsvFile OutcomesCsv(const Findings& findings) {
  Csv csv("outcomes.csv",
          "cell,scenario,clearance,error_scale,propagation,resolvers,grasp,sensing,noise,seed,plan,"
          "actions,"
          "unproved,trials,done,succeeded,wilson_low,wilson_high,control_done,control_succeeded");
  for (const CellFindings& cell : findings.cells) {
    const sweep::CellRecord& record = cell.cell();
    const Interval wilson = sweep::WilsonInterval(cell.summary.succeeded, cell.summary.done);
    csv.Add(record.cell, record.scenario, record.clearance, record.error_scale, record.propagation,
            record.resolvers, record.grasp, record.sensing, record.noise, record.seed,
            record.outcome, record.actions, record.errors, record.trials, cell.summary.done,
            cell.summary.succeeded, wilson.low, wilson.high, cell.control_done,
            cell.control_succeeded);
  }
  return csv.Take();
}

CsvFile FailuresCsv(const Findings& findings) {
  Csv csv("failures.csv", "cell,outcome,trials");
  for (const CellFindings& cell : findings.cells) {
    for (const auto& [outcome, count] : cell.summary.failed) {
      csv.Add(cell.cell().cell, outcome, count);
    }
  }
  return csv.Take();
}

CsvFile RecoveriesCsv(const Findings& findings) {
  Csv csv("recoveries.csv",
          "cell,done,trials_with_errors,errors_signalled,errors_mended,trials_recovered,operator_"
          "called,succeeded_unaided,succeeded");
  for (const CellFindings& cell : findings.cells) {
    const sweep::CellSummary& summary = cell.summary;
    csv.Add(cell.cell().cell, summary.done, summary.with_errors, cell.recovery.signalled,
            cell.recovery.mended, summary.recovered, summary.operator_called, cell.recovery.unaided,
            summary.succeeded);
  }
  return csv.Take();
}

CsvFile ErrorSetsCsv(const Findings& findings) {
  Csv csv("error_sets.csv",
          "cell,step,action,about,name,unit,low,high,proved,gate,contained,inconclusive,violated,"
          "not_claimed,least,lower_quartile,median,upper_quartile,greatest");
  for (const CellFindings& cell : findings.cells) {
    for (const StepFindings& step : cell.steps) {
      for (const auto& [claim, seen] : step.claims) {
        const double none = std::nan("");
        const bool any = seen.claimed() > 0;
        const VerdictCounts verdicts = seen.verdicts.Verdicts();
        csv.Add(cell.cell().cell, claim.step, claim.action, claim.about, claim.name,
                claim.dimension, claim.low, claim.high, claim.proved, claim.gate,
                verdicts.contained, verdicts.inconclusive, verdicts.violated, verdicts.not_claimed,
                any ? seen.least : none, any ? seen.lower_quartile : none, any ? seen.median : none,
                any ? seen.upper_quartile : none, any ? seen.greatest : none);
      }
    }
  }
  return csv.Take();
}

CsvFile VerdictsCsv(const Findings& findings) {
  Csv csv("verdicts.csv",
          "cell,step,action,contained,inconclusive,violated,not_claimed,worst_verdict,claim,about,"
          "unit,observed,low,high,margin,gate,trial,replay");
  for (const CellFindings& cell : findings.cells) {
    for (const StepFindings& step : cell.steps) {
      const auto& [verdict, about, dimension, trial] = step.worst;
      const VerdictCounts counts = step.counts.Verdicts();
      csv.Add(cell.cell().cell, step.step, step.action, counts.contained, counts.inconclusive,
              counts.violated, counts.not_claimed, verdict.verdict, verdict.claim, about, dimension,
              verdict.observed, verdict.low, verdict.high, verdict.margin, verdict.gate, trial,
              ReplayCommand(findings.database, trial));
    }
  }
  return csv.Take();
}

CsvFile FalsificationsCsv(const Findings& findings) {
  Csv csv("attacks.csv",
          "cell,attempts,contained,inconclusive,violated,not_claimed,claims_contained,claims_"
          "inconclusive,claims_violated,claims_not_claimed");
  for (const CellFindings& cell : findings.cells) {
    if (!cell.falsification) continue;
    const auto& [certificates, claims] =
        std::pair(cell.falsification->certificates, cell.falsification->claims);
    csv.Add(cell.cell().cell, cell.falsification->attempts, certificates.contained,
            certificates.inconclusive, certificates.violated, certificates.not_claimed,
            claims.contained, claims.inconclusive, claims.violated, claims.not_claimed);
  }
  return csv.Take();
}

CsvFile TriedClaimsCsv(const Findings& findings) {
  Csv csv(
      "attacked_claims.csv",
      "cell,step,action,about,name,unit,observed,low,high,margin,gate,verdict,phase,attempt,noise");
  for (const CellFindings& cell : findings.cells) {
    if (!cell.falsification) continue;
    for (const sweep::WorstClaimRecord& claim : cell.falsification->worst) {
      csv.Add(cell.cell().cell, claim.step, claim.action, claim.about, claim.name, claim.dimension,
              claim.observed, claim.low, claim.high, claim.margin, claim.gate, claim.verdict,
              claim.phase, claim.attempt, claim.noise);
    }
  }
  return csv.Take();
}

CsvFile CounterexamplesCsv(const Findings& findings) {
  Csv csv("counterexamples.csv",
          "cell,number,claim,action,name,unit,observed,low,high,margin,gate,noise,steps,replayed,"
          "multiple,replay");
  for (const CellFindings& cell : findings.cells) {
    if (!cell.falsification) continue;
    for (const sweep::CounterexampleRecord& example : cell.falsification->counterexamples) {
      csv.Add(cell.cell().cell, example.number, example.claim, example.action, example.name,
              example.dimension, example.observed, example.low, example.high, example.margin,
              example.gate, example.noise, example.steps, example.replayed, example.multiple,
              WithDatabase(example.replay, findings.database));
    }
  }
  return csv.Take();
}

CsvFile ConservatismRatiosCsv(const Findings& findings) {
  Csv csv("conservatism.csv", "cell,variable,guaranteed,broken,ratio");
  for (const CellFindings& cell : findings.cells) {
    if (!cell.falsification) continue;
    for (const sweep::ConservatismRecord& row : cell.falsification->conservatism) {
      csv.Add(cell.cell().cell, row.variable, row.guaranteed, row.broken, row.ratio);
    }
  }
  return csv.Take();
}

CsvFile RunsCsv(const Findings& findings) {
  Csv csv("runs.csv", "started,shard,jobs,version,machine,cores,os");
  for (const sweep::RunRecord& run : findings.runs) {
    csv.Add(run.started, run.shard, run.jobs, run.version, run.machine, run.cores, run.os);
  }
  return csv.Take();
}

}  // namespace

std::vector<CsvFile> CsvFiles(const Findings& findings) {
  return {OutcomesCsv(findings),    FailuresCsv(findings),        RecoveriesCsv(findings),
          ErrorSetsCsv(findings),   VerdictsCsv(findings),        FalsificationsCsv(findings),
          TriedClaimsCsv(findings), CounterexamplesCsv(findings), ConservatismRatiosCsv(findings),
          RunsCsv(findings)};
}

}  // namespace assay::report
