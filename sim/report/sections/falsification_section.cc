#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "sim/noise/error_box.h"
#include "sim/report/charts/chart.h"
#include "sim/report/findings/command.h"
#include "sim/report/findings/observations.h"
#include "sim/report/html/data_table.h"
#include "sim/report/numbers/figures.h"
#include "sim/report/sections/section.h"

namespace assay::report {
namespace {

constexpr std::size_t kMostClaims = 12;    // shown for one cell
constexpr std::size_t kMostExamples = 20;  // shown on the page

Element CountTable(const Subject& subject) {
  DataTable table(
      "Attempts at single steps from saved states, with the verdicts on their certificates",
      {{"cell"},
       {"attempts", "number"},
       {"contained", "number"},
       {"inconclusive, or within the engine’s resolution", "number"},
       {"violated", "number"},
       {"not claimed", "number"},
       {"claims", "number"},
       {"claims contained", "number"},
       {"claims violated", "number"}});
  for (const CellFindings& cell : subject.findings.cells) {
    if (!cell.falsification) continue;
    const auto& [certificates, claims] =
        std::pair(cell.falsification->certificates, cell.falsification->claims);
    table.AddRow({Words(subject.NameOf(cell)), Words(CountText(cell.falsification->attempts)),
                  Words(CountText(certificates.contained)),
                  Words(CountText(certificates.inconclusive)),
                  Words(CountText(certificates.violated)),
                  Words(CountText(certificates.not_claimed)), Words(CountText(claims.Total())),
                  Words(CountText(claims.contained)), Words(CountText(claims.violated))});
  }
  return table.Take();
}

// Returns the worst claims, ordered by verdict and then by their margin as a share of the predicted
// width.
std::vector<sweep::WorstClaimRecord> Tightest(const sweep::FalsificationRecord& falsification) {
  const auto key = [](const sweep::WorstClaimRecord& claim) {
    const double width = claim.high - claim.low;
    const double scale = std::isfinite(width) && width > 0 ? width : 1;
    constexpr std::array kOrder = {"violated", "inconclusive", "contained"};
    const auto rank = std::ranges::find(kOrder, claim.verdict) - kOrder.begin();
    return std::pair(rank, claim.margin / scale);
  };
  std::vector<sweep::WorstClaimRecord> worst = falsification.worst;
  std::ranges::stable_sort(worst, {}, key);
  if (worst.size() > kMostClaims) worst.resize(kMostClaims);
  return worst;
}

Element WorstTable(const Subject& subject, const CellFindings& cell) {
  DataTable table(fmt::format("{}: the claims with the least margins", subject.NameOf(cell)),
                  {{"claim"},
                   {"verdict"},
                   {"observed", "number"},
                   {"predicted", "number"},
                   {"margin", "number"},
                   {"gate", "number"},
                   {"found by"},
                   {"attempt", "number"}});
  for (const sweep::WorstClaimRecord& claim : Tightest(*cell.falsification)) {
    table.AddRow({Words(fmt::format("{} {} ({})", claim.step, claim.name, claim.about)),
                  StandingWords(StandingOf(claim)),
                  Words(QuantityText(claim.observed, claim.dimension)),
                  Words(IntervalText({claim.low, claim.high}, claim.dimension)),
                  Words(QuantityText(claim.margin, claim.dimension)),
                  Words(QuantityText(claim.gate, claim.dimension)), Words(claim.phase),
                  Words(CountText(claim.attempt))});
  }
  return table.Take();
}

// Converts "dx_block=0.0028 theta_block=-0.09" to "dx_block = 2.8 mm, ...".
std::string NoiseText(const std::string& noise) {
  std::vector<std::string> errors;
  std::istringstream words(noise);
  for (std::string word; words >> word;) {
    const std::size_t equals = word.find('=');
    double value = 0;
    std::istringstream number(equals == std::string::npos ? "" : word.substr(equals + 1));
    if (!(number >> value)) {
      errors.push_back(word);
      continue;
    }
    const std::string channel = word.substr(0, equals);
    errors.push_back(
        fmt::format("{} = {}", channel, QuantityText(value, noise::DimensionOfChannel(channel))));
  }
  return errors.empty() ? "none" : fmt::format("{}", fmt::join(errors, ", "));
}

Element Example(const Subject& subject, const CellFindings& cell,
                const sweep::CounterexampleRecord& example) {
  Element box("div");
  box.Set("class", "example");
  box.Add("h4")
      .Add(StandingWords(Standing::kViolated))
      .Text(fmt::format(": {} of {}", example.name, example.action));
  box.Add("p", fmt::format("{}. Observed: {}. Predicted: {}. The observation is outside by {}; the "
                           "gate is {}.",
                           subject.NameOf(cell), QuantityText(example.observed, example.dimension),
                           IntervalText({example.low, example.high}, example.dimension),
                           QuantityText(-example.margin, example.dimension),
                           QuantityText(example.gate, example.dimension)));
  box.Add("p", fmt::format("Remaining errors: {}. {}, {}.", NoiseText(example.noise),
                           CountText(example.steps, "step"),
                           example.replayed ? "replayed from the start of the plan"
                                            : "seen only in an execution from a saved state"));
  if (example.multiple != 1) {
    box.Add("p", fmt::format("It is still violated with {} of these errors.",
                             NumberText(example.multiple)));
  }
  box.Add(Command(WithDatabase(example.replay, subject.findings.database)));
  if (cell.falsification_trial > 0) {
    box.Add("p").Add(ViewLink({cell.falsification_trial, example.number}, subject.findings.database,
                              subject.view));
  }
  return box;
}

void AddExamples(Element& section, const Subject& subject) {
  std::size_t all = 0;
  std::vector<Element> examples;
  for (const CellFindings& cell : subject.findings.cells) {
    if (!cell.falsification) continue;
    for (const sweep::CounterexampleRecord& example : cell.falsification->counterexamples) {
      if (++all <= kMostExamples) examples.push_back(Example(subject, cell, example));
    }
  }
  if (examples.empty()) return;
  section.Add("h3", "Counterexamples");
  section.Add("p", fmt::format("The errors of each counterexample are reduced: without any one of "
                               "them, nothing is violated. The first command repeats the "
                               "counterexample, {} a page that shows it in three dimensions.",
                               subject.view ? "and the link leads to" : "the second one makes"));
  for (Element& example : examples) section.Add(std::move(example));
  if (all > kMostExamples) {
    section.Add("p", fmt::format("The file counterexamples.csv also has the counterexamples that "
                                 "are not shown here: {}.",
                                 CountText(static_cast<std::int64_t>(all - kMostExamples))));
  }
}

}  // namespace

Element Falsifications(const Subject& subject) {
  Element section("div");
  const auto& cells = subject.findings.cells;
  if (std::ranges::none_of(cells,
                           [](const auto& cell) { return cell.falsification.has_value(); })) {
    section.Add("p", "There was no falsification: the sweep has no cell with noise “attack”.");
    return section;
  }
  section.Add("p",
              "The attempts are at corners of the error box, then at evenly spread points, then at "
              "points of a local search for the least margin. Each attempt starts from a state "
              "that was saved before the step.");
  section.Add(CountTable(subject));
  AddExamples(section, subject);
  section.Add("h3", "Claims with the least margins");
  std::size_t told = 0;
  for (const CellFindings& cell : cells) {
    if (!cell.falsification || cell.falsification->worst.empty()) continue;
    if (++told > kMostClaims) break;
    section.Add(WorstTable(subject, cell));
  }
  section.Add("p", "All claims are in attacked_claims.csv.").Set("class", "note");
  return section;
}

}  // namespace assay::report
