#include "bench/summary/contingent_table.h"

#include <fmt/format.h>

#include <vector>

#include "bench/summary/comparison.h"
#include "bench/summary/markdown.h"

namespace assay::bench {
namespace {

constexpr const char* kBeginning = "Contingent/";

constexpr const char* kAbout = R"(# Contingent planning beside PO-PRP

`ASSAY_CONTINGENT=FOLDER bench/run.sh --only contingent` writes this page. FOLDER has a folder for each problem, with `d.pddl` and `p.pddl`. The problems `kvp-*` and `med-*` belong to `assay`. All other problems are those of the CLG set (Albore, Palacios, Geffner, and the sources that they name), and are not in this repository.

The time of `assay` is the processor time of reading, grounding and planning, the median of the passes. A plan is a tree with shared sub-plans. Its nodes are actions, which act or sense, and branches. Afterwards a checker runs each tree in all worlds that the initial knowledge allows. The checker shares no inference with the planner.

PO-PRP (Muise, Belle, McIlraith: *Computing Contingent Plans via Fully Observable Non-Deterministic Planning*, 2014) is the strongest contingent planner among those that could be compiled. It was not run here: its figures were measured on another machine of this kind (two cores, shared). Its time is from end to end. Its policy consists of state-action pairs. `refused` means that PO-PRP does not accept the problem. An empty cell means that no figure is known.

)";

std::string Number(const Series& series, const std::string& counter) {
  const auto at = series.counters.find(counter);
  return at == series.counters.end() ? "" : fmt::format("{:.10g}", at->second);
}

std::string Milliseconds(const Series& series, const std::string& counter) {
  const auto at = series.counters.find(counter);
  return at == series.counters.end() ? "" : Time(1e-3 * at->second);
}

std::string Checked(const Series& series) {
  if (!series.wrong.empty()) return "**refused**: " + series.wrong;
  const bool all = Number(series, "all_worlds") == "1";
  return fmt::format("in {}{} worlds", all ? "all " : "", Number(series, "worlds"));
}

// Returns the row of a problem. If the peer has no plan, the label has the reason.
std::string RowOf(const Series& series) {
  return Row({series.name.substr(std::string(kBeginning).size()), Number(series, "nodes"),
              Number(series, "actions"), Time(series.Median()), Number(series, "po_prp_pairs"),
              series.label + Milliseconds(series, "po_prp_ms"),
              Milliseconds(series, "po_prp_search_ms"), Checked(series)});
}

// Adds the ratio of the peer's time to assay's, if the peer has a time.
void AddRatio(const Series& series, const std::string& counter, std::vector<double>& ratios) {
  const auto peer = series.counters.find(counter);
  if (peer == series.counters.end() || series.seconds.empty()) return;
  ratios.push_back(1e-3 * peer->second / series.Median());
}

}  // namespace

std::string ContingentTable(const Measurements& measurements) {
  std::string out = kAbout;
  out += Heading({"problem", "nodes of assay", "actions of assay", "time of assay", "PO-PRP: pairs",
                  "PO-PRP: time", "PO-PRP: search time", "accepted"});
  std::vector<double> whole, search;
  for (const Series& series : measurements.series) {
    if (!series.name.starts_with(kBeginning)) continue;
    out += RowOf(series);
    AddRatio(series, "po_prp_ms", whole);
    AddRatio(series, "po_prp_search_ms", search);
  }
  if (!whole.empty()) {
    out += fmt::format(
        "\nFor the {} problems with known figures of PO-PRP, PO-PRP's time is {} times the time of "
        "`assay`, and its search time alone is {} times (geometric means).\n",
        whole.size(), Multiple(GeometricMean(whole)), Multiple(GeometricMean(search)));
  }
  return out + "\n" + Where(measurements);
}

}  // namespace assay::bench
