#include <fmt/format.h>
#include <fmt/ranges.h>

#include "sim/report/charts/chart.h"
#include "sim/report/findings/command.h"
#include "sim/report/html/data_table.h"
#include "sim/report/numbers/figures.h"
#include "sim/report/sections/section.h"

namespace assay::report {
namespace {

Element StepWords(const StepFindings& step) {
  Element words("span", fmt::format("{} ", step.step));
  words.Text(step.what.empty() ? step.action : fmt::format("{} {}", step.action, step.what));
  return words;
}

// Returns the worst claim and the command that runs its trial again.
Element WorstWords(const WorstVerdict& worst, const std::string& database) {
  Element words("div");
  words.Add(StandingWords(StandingOf(worst.verdict)));
  words.Text(fmt::format(": {}{}", worst.verdict.claim,
                         worst.about.empty() ? "" : fmt::format(" ({})", worst.about)));
  words.Add("br");
  words.Add(Command(ReplayCommand(database, worst.trial)));
  return words;
}

std::string CountsText(const StandingCounts& counts) {
  std::vector<std::string> words;
  for (const Standing standing : kStandings) {
    const std::int64_t count = counts.Of(standing);
    if (count > 0) words.push_back(fmt::format("{} {}", CountText(count), TextOf(standing)));
  }
  return fmt::format("{}", fmt::join(words, ", "));
}

// Returns the verdicts on a step as a drawing and as numbers.
Element CountWords(const StepFindings& step) {
  Element contents("div");
  contents.Add(VerdictBar(step.counts));
  contents.Add("br");
  contents.Text(CountsText(step.counts));
  const StandingCounts claims = step.ObservedClaims();
  if (claims.Total() == 0) return contents;
  contents.Add("br");
  contents
      .Add("span", fmt::format("of {}: {}", CountText(claims.Total(), "claim"), CountsText(claims)))
      .Set("class", "note");
  return contents;
}

void AddRow(DataTable& table, const Findings& findings, const StepFindings& step) {
  const WorstVerdict& worst = step.worst;
  const sweep::VerdictRecord& verdict = worst.verdict;
  if (worst.trial == 0) return;
  table.AddRow({StepWords(step), CountWords(step), WorstWords(worst, findings.database),
                Words(QuantityText(verdict.observed, worst.dimension)),
                Words(IntervalText({verdict.low, verdict.high}, worst.dimension)),
                Words(QuantityText(verdict.margin, worst.dimension)),
                Words(QuantityText(verdict.gate, worst.dimension))});
}

Element CellTable(const Subject& subject, const CellFindings& cell) {
  DataTable table(fmt::format("{}: certificates of {}, and their worst claims",
                              subject.NameOf(cell), CountText(cell.summary.done, "trial")),
                  {{"step"},
                   {"certificates"},
                   {"worst claim, and the command that repeats the trial"},
                   {"observed", "number"},
                   {"predicted", "number"},
                   {"margin", "number"},
                   {"gate", "number"}});
  for (const StepFindings& step : cell.steps) AddRow(table, subject.findings, step);
  return table.Take();
}

}  // namespace

Element Verdicts(const Subject& subject) {
  Element section("div");
  if (subject.in_full.empty()) {
    section.Add("p", "No certificate has been compared with a trial yet.");
    return section;
  }
  section.Add(
      "p",
      "The verdict on a step's certificate is the verdict on its worst claim. If this "
      "claim is within the engine’s resolution, so is the certificate, which is no sign of "
      "a wrong prediction. The margin is the distance to the nearer end of the predicted "
      "range, and is negative outside of it. The gate is the change of the quantity when the "
      "timestep is halved.");
  for (const CellFindings* cell : subject.in_full) section.Add(CellTable(subject, *cell));
  if (subject.left_out() > 0) {
    section
        .Add("p", fmt::format("The file verdicts.csv also has the cells that are not shown here: "
                              "{}. Cells with violations and with noise are shown first.",
                              CountText(subject.left_out(), "cell")))
        .Set("class", "note");
  }
  return section;
}

}  // namespace assay::report
