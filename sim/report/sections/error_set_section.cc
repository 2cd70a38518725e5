#include <fmt/format.h>

#include <array>

#include "sim/report/charts/chart.h"
#include "sim/report/html/data_table.h"
#include "sim/report/numbers/figures.h"
#include "sim/report/sections/section.h"

namespace assay::report {
namespace {

struct About {
  std::string_view name;
  const char* title;
};
constexpr std::array kAbouts = {
    About{"before", "before the step: errors of the poses at its start"},
    About{"precondition",
          "preconditions: their margins; a negative margin means that the precondition does not "
          "hold"},
    About{"after", "after the step: errors of the poses at its end"},
};

std::string ObservedText(const ClaimFindings& row) {
  const Observed& seen = row.observed;
  if (seen.claimed() == 0) return "–";
  return IntervalText({seen.least, seen.greatest}, row.claim.dimension);
}

// Returns the worst standing and how often it occurred.
Element Worst(const StandingCounts& counts) {
  const std::int64_t all = counts.Total();
  for (const Standing standing :
       {Standing::kViolated, Standing::kInconclusive, Standing::kWithinResolution,
        Standing::kContained, Standing::kNotClaimed}) {
    const std::int64_t count = counts.Of(standing);
    if (count == 0) continue;
    Element words = StandingWords(standing);
    words.Text(count == all ? "" : fmt::format(" {} of {}", CountText(count), CountText(all)));
    return words;
  }
  return Words("–");
}

void AddRow(DataTable& table, const ClaimFindings& row) {
  const sweep::ClaimRecord& claim = row.claim;
  table.AddRow(
      {Words(claim.proved ? claim.name : claim.name + " (not proved)"), ErrorChart(row),
       Words(IntervalText({claim.low, claim.high}, claim.dimension)), Words(ObservedText(row)),
       Words(row.observed.claimed() == 0 ? "–"
                                         : QuantityText(row.observed.median, claim.dimension)),
       Words(QuantityText(claim.gate, claim.dimension)), Worst(row.observed.verdicts)});
}

Element StepTable(const StepFindings& step) {
  DataTable table(fmt::format("Step {}, {}{}", step.step, step.action,
                              step.what.empty() ? "" : fmt::format(": {}", step.what)),
                  {{"component"},
                   {"predicted and observed, mm or °", "chart"},
                   {"predicted", "number"},
                   {"observed", "number"},
                   {"median", "number"},
                   {"gate", "number"},
                   {"verdict"}});
  for (const About& about : kAbouts) {
    bool first = true;
    for (const ClaimFindings& row : step.claims) {
      if (row.claim.about != about.name) continue;
      if (first) table.AddGroup(about.title);
      first = false;
      AddRow(table, row);
    }
  }
  return table.Take();
}

// Returns an example of a chart with the meaning of its shapes.
Element DrawingKey() {
  ClaimFindings example;
  example.claim.name = std::string("example");
  example.claim.dimension = domain::Dimension::kLength;
  example.claim.low = -0.001;
  example.claim.high = 0.001;
  example.claim.gate = 0.0001;
  example.observed = {-0.0006, -0.0003, 0.0001, 0.0004, 0.0009, {}};
  example.observed.verdicts.Add(Standing::kContained);
  Element key("ul");
  key.Set("class", "key").Set("aria-label", "How to read the drawings");
  Element& item = key.Add("li").Set("class", "drawn");
  item.Add(ErrorChart(example));
  item.Add(
      "span",
      "The wide bar is the predicted range. The pale bars beside it are as long as the gate, "
      "the change of the quantity when the timestep is halved. The line goes from the least to "
      "the greatest observed value. Its box has the middle half of the values, with a gap at "
      "the median. Each row has its own axis. A dashed bar is not proved, so nothing is claimed "
      "about it.");
  return key;
}

}  // namespace

Element ErrorSets(const Subject& subject) {
  Element section("div");
  if (subject.in_full.empty()) {
    section.Add("p", "Nothing has been observed yet.");
    return section;
  }
  section.Add(DrawingKey());
  for (const CellFindings* cell : subject.in_full) {
    section.Add("h3", subject.NameOf(*cell));
    for (const StepFindings& step : cell->steps) {
      if (!step.claims.empty()) section.Add(StepTable(step));
    }
  }
  if (subject.left_out() > 0) {
    section
        .Add("p",
             fmt::format("The file error_sets.csv also has the cells that are not shown here: {}.",
                         CountText(subject.left_out(), "cell")))
        .Set("class", "note");
  }
  return section;
}

}  // namespace assay::report
