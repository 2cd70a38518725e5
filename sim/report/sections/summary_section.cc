#include <fmt/format.h>

#include <set>

#include "sim/report/charts/chart.h"
#include "sim/report/html/data_table.h"
#include "sim/report/numbers/figures.h"
#include "sim/report/sections/section.h"

namespace assay::report {
namespace {

// The sums over several cells.
struct Tally {
  int done = 0, succeeded = 0;                  // trials under noise
  int control_done = 0, control_succeeded = 0;  // trials without noise
  StandingCounts certificates;                  // the certificates of these trials
  // Attempts of falsifications on single steps.
  std::int64_t tried = 0, tried_violated = 0, tried_inconclusive = 0;

  std::int64_t violated() const { return certificates.Of(Standing::kViolated); }
  std::int64_t all_violated() const { return violated() + tried_violated; }
};

void Add(const CellFindings& cell, Tally& tally) {
  if (cell.falsification) {
    tally.tried += cell.falsification->attempts;
    tally.tried_violated += cell.falsification->certificates.violated;
    tally.tried_inconclusive += cell.falsification->certificates.inconclusive;
  }
  if (cell.is_falsification()) return;  // its only trial stands for all these attempts
  (cell.is_control() ? tally.control_done : tally.done) += cell.summary.done;
  (cell.is_control() ? tally.control_succeeded : tally.succeeded) += cell.summary.succeeded;
  for (const StepFindings& step : cell.steps) tally.certificates += step.counts;
}

template <class Matches>
Tally TallyOf(const Findings& findings, const Matches& matches) {
  Tally tally;
  for (const CellFindings& cell : findings.cells) {
    if (matches(cell)) Add(cell, tally);
  }
  return tally;
}

void AddTile(Element& tiles, const std::string& name, Element big, const std::string& words) {
  Element& tile = tiles.Add("div").Set("class", "tile");
  tile.Add("dt", name);
  tile.Add("dd").Set("class", "big").Add(std::move(big));
  tile.Add("dd", words);
}

Element Counted(std::int64_t violated) {
  Element big("span");
  big.Set("class", "big");
  big.Add(Mark(violated > 0 ? Standing::kViolated : Standing::kContained));
  big.Text(CountText(violated));
  return big;
}

std::string TrialWords(const Findings& findings) {
  const int done = findings.done();
  const std::string cells = fmt::format("in {}", CountText(findings.cells.size(), "cell"));
  if (done == findings.trials()) return cells + ", which is the whole sweep";
  return fmt::format("{}, of {} in the whole sweep", cells, CountText(findings.trials()));
}

std::string SuccessWords(const Tally& tally) {
  std::string words = "no trials under noise";
  if (tally.done > 0) {
    words = fmt::format("{} of {}; 95 % interval {}", CountText(tally.succeeded),
                        CountText(tally.done, "trial"), WilsonText(tally.succeeded, tally.done));
  }
  if (tally.control_done > 0) {
    words += fmt::format(". Without noise: {} of {}", CountText(tally.control_succeeded),
                         CountText(tally.control_done));
  }
  return words;
}

std::string CountOf(const Tally& tally, Standing standing) {
  return fmt::format("{} {}", CountText(tally.certificates.Of(standing)), TextOf(standing));
}

Element Tiles(const Findings& findings, const Tally& tally) {
  Element tiles("dl");
  tiles.Set("class", "tiles");
  AddTile(tiles, "Trials", Words(CountText(findings.done())), TrialWords(findings));
  AddTile(tiles, "Success under noise", Words(RateText(tally.succeeded, tally.done)),
          SuccessWords(tally));
  AddTile(tiles, "Certificates violated in trials", Counted(tally.violated()),
          fmt::format(
              "of {} compared with the true poses; {}, {}, {}",
              CountText(tally.certificates.Total()), CountOf(tally, Standing::kWithinResolution),
              CountOf(tally, Standing::kInconclusive), CountOf(tally, Standing::kNotClaimed)));
  if (tally.tried > 0) {
    AddTile(tiles, "Violated in attempts", Counted(tally.tried_violated),
            fmt::format("of {}; {} inconclusive or within the engine’s resolution",
                        CountText(tally.tried, "attempt"), CountText(tally.tried_inconclusive)));
  } else {
    AddTile(tiles, "Attempts of falsification", Words("0"), "the sweep has no falsification");
  }
  return tiles;
}

std::string EvaluationsText(const Tally& tally) {
  std::string text = CountText(tally.certificates.Total(), "certificate") + " of trials";
  if (tally.tried > 0) text += " and " + CountText(tally.tried, "attempt");
  return text;
}

std::string Lead(const Tally& tally) {
  if (tally.certificates.Total() + tally.tried == 0) return "No prediction has been tested yet.";
  if (tally.all_violated() == 0) {
    return fmt::format("No prediction was violated in {}. This does not prove the predictions.",
                       EvaluationsText(tally));
  }
  return fmt::format(
      "Predictions were violated {} in {}.",
      tally.all_violated() == 1 ? "once" : CountText(tally.all_violated()) + " times",
      EvaluationsText(tally));
}

// Adds the violations of each propagation mode if the sweep has several modes.
void AddPropagations(Element& section, const Findings& findings) {
  std::set<std::string> modes;
  for (const CellFindings& cell : findings.cells) modes.insert(cell.cell().propagation);
  if (modes.size() < 2) return;
  Element& list = section.Add("ul");
  for (const std::string& mode : modes) {
    const Tally tally = TallyOf(
        findings, [&](const CellFindings& cell) { return cell.cell().propagation == mode; });
    list.Add("li", fmt::format("Propagation “{}”: {} violated in {}.", mode,
                               CountText(tally.all_violated()), EvaluationsText(tally)));
  }
}

void AddKey(Element& key, Standing standing, const std::string& words) {
  Element& item = key.Add("li");
  item.Add(Mark(standing));
  item.Add("span", fmt::format("{}: {}", TextOf(standing), words));
}

Element MarkKey() {
  Element key("ul");
  key.Set("class", "key").Set("aria-label", "What the marks mean");
  AddKey(key, Standing::kContained, "the observation is within the prediction");
  AddKey(
      key, Standing::kWithinResolution,
      "outside by no more than the gate, the change of the quantity when the timestep is halved; "
      "no sign of a wrong prediction");
  AddKey(key, Standing::kInconclusive,
         "outside by more than the gate, but not confirmed with half the timestep");
  AddKey(key, Standing::kViolated, "outside by more than the gate, and confirmed");
  AddKey(key, Standing::kNotClaimed, "an assumption that the planner left unproved did not hold");
  return key;
}

}  // namespace

Element SummaryOf(const Subject& subject) {
  const Tally tally = TallyOf(subject.findings, [](const CellFindings&) { return true; });
  Element section("div");
  section.Add("p", Lead(tally)).Set("class", "lead");
  AddPropagations(section, subject.findings);
  section.Add(Tiles(subject.findings, tally));
  section.Add(MarkKey());
  return section;
}

}  // namespace assay::report
