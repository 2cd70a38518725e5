#include "sim/report/charts/chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/report/charts/drawing.h"
#include "sim/report/numbers/figures.h"
#include "sim/sweep/database/wilson.h"

namespace assay::report {
namespace {

void AddMark(Element& svg, Standing standing, double x, double y) {
  svg.Add("use")
      .Set("href", fmt::format("#mark-{}", Name(standing)))
      .Set("class", Name(standing))
      .Set("x", x - 6)
      .Set("y", y - 6)
      .Set("width", 12)
      .Set("height", 12);
}

constexpr double kRateWidth = 220;
constexpr Axis kRates{0, 1, 8, kRateWidth - 8};

void AddRate(Element& svg, std::string_view kind, int succeeded, int done, double y) {
  if (done == 0) return;
  const auto [low, high] = sweep::WilsonInterval(succeeded, done);
  AddLine(svg, kind, kRates.At(low), y, kRates.At(high), y);
  for (const double end : {low, high}) {
    AddLine(svg, kind, kRates.At(end), y - 4, kRates.At(end), y + 4);
  }
  svg.Add("circle")
      .Set("class", kind)
      .Set("cx", kRates.At(static_cast<double>(succeeded) / done))
      .Set("cy", y)
      .Set("r", 4.5);
}

std::string RateWords(const CellFindings& cell) {
  const auto& [record, done, succeeded, failed, certificates, with_errors, recovered, operators] =
      cell.summary;
  std::string words = fmt::format("{} of {} succeeded, 95 % interval {}", CountText(succeeded),
                                  CountText(done), WilsonText(succeeded, done));
  if (cell.control_done > 0) {
    words += fmt::format("; without noise {} of {}", CountText(cell.control_succeeded),
                         CountText(cell.control_done));
  }
  return words;
}

constexpr double kErrorWidth = 300;
constexpr double kErrorHeight = 40;
constexpr double kMiddle = 12;  // pixels, the vertical middle of the bars

// Returns the axis for a claim. It shows every finite end of the prediction and of the
// observations, with some room beside them.
Axis ErrorAxis(const ClaimFindings& row) {
  const Observed& seen = row.observed;
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  const auto include = [&](double value) {
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  };
  include(row.claim.low);
  include(row.claim.high);
  if (seen.claimed() > 0) {
    include(seen.least);
    include(seen.greatest);
  }
  if (low > high) low = high = 0;
  double room = 0.08 * (high - low);
  if (room == 0) room = std::max({row.claim.gate, 0.1 * std::abs(high), 1e-9});
  return {low - room, high + room, 6, kErrorWidth - 6};
}

void AddPrediction(Element& svg, const Axis& axis, const sweep::ClaimRecord& claim) {
  const double left = axis.At(claim.low);
  const double right = axis.At(claim.high);
  const std::string kind = claim.proved ? "predicted" : "predicted unproved";
  const double gate_left = axis.At(claim.low - claim.gate);
  const double gate_right = axis.At(claim.high + claim.gate);
  if (gate_left < left) AddBox(svg, "gate", gate_left, kMiddle - 3, left - gate_left, 6);
  if (gate_right > right) AddBox(svg, "gate", right, kMiddle - 3, gate_right - right, 6);
  AddBox(svg, kind, left, kMiddle - 9, std::max(right - left, 1.5), 18);
  if (std::isfinite(claim.low)) AddLine(svg, "end", left, kMiddle - 11, left, kMiddle + 11);
  if (std::isfinite(claim.high)) AddLine(svg, "end", right, kMiddle - 11, right, kMiddle + 11);
}

// Adds an end of the observed interval. An end outside the prediction has the mark of its verdict.
void AddEnd(Element& svg, const Axis& axis, const ClaimFindings& row, double value) {
  const auto& [low, high] = Interval{row.claim.low, row.claim.high};
  const double margin = std::min(value - low, high - value);
  if (margin < -row.claim.gate && row.observed.verdicts.Of(Standing::kViolated) > 0) {
    AddMark(svg, Standing::kViolated, axis.At(value), kMiddle);
  } else if (margin < -row.claim.gate) {
    AddMark(svg, Standing::kInconclusive, axis.At(value), kMiddle);
  } else if (margin < 0) {
    AddMark(svg, Standing::kWithinResolution, axis.At(value), kMiddle);
  } else {
    AddLine(svg, "observed", axis.At(value), kMiddle - 4, axis.At(value), kMiddle + 4);
  }
}

void AddObserved(Element& svg, const Axis& axis, const ClaimFindings& row) {
  const Observed& seen = row.observed;
  if (seen.claimed() == 0) return;
  AddLine(svg, "observed", axis.At(seen.least), kMiddle, axis.At(seen.greatest), kMiddle);
  const double left = axis.At(seen.lower_quartile);
  AddBox(svg, "observed", left, kMiddle - 5, std::max(axis.At(seen.upper_quartile) - left, 1.0),
         10);
  AddLine(svg, "median", axis.At(seen.median), kMiddle - 5, axis.At(seen.median), kMiddle + 5);
  AddEnd(svg, axis, row, seen.least);
  AddEnd(svg, axis, row, seen.greatest);
}

void AddTicks(Element& svg, const Axis& axis, domain::Dimension dimension) {
  const Axis shown{Shown(axis.low, dimension), Shown(axis.high, dimension), axis.left, axis.right};
  const double y = kMiddle + 14;
  AddLine(svg, "axis", axis.left, y, axis.right, y);
  for (const double tick : Ticks(shown, 4)) {
    const double x = shown.At(tick);
    AddLine(svg, "axis", x, y, x, y + 3);
    const double inset = std::clamp(x, 16.0, kErrorWidth - 16);
    AddWords(svg, "middle", inset, y + 13, NumberText(std::abs(tick) < 1e-15 ? 0 : tick));
  }
}

std::string ErrorWords(const ClaimFindings& row) {
  const auto& claim = row.claim;
  const Observed& seen = row.observed;
  std::string words = fmt::format("{}: predicted {}", claim.name,
                                  IntervalText({claim.low, claim.high}, claim.dimension));
  if (seen.claimed() == 0) return words + "; no observation of a claim";
  return words +
         fmt::format("; observed {}, half of it {}",
                     IntervalText({seen.least, seen.greatest}, claim.dimension),
                     IntervalText({seen.lower_quartile, seen.upper_quartile}, claim.dimension));
}

Element Symbol(Standing standing) {
  Element symbol("symbol");
  symbol.Set("id", fmt::format("mark-{}", Name(standing))).Set("viewBox", "0 0 12 12");
  return symbol;
}

}  // namespace

Element Mark(Standing standing) {
  Element svg("svg");
  svg.Set("class", fmt::format("mark {}", Name(standing))).Set("aria-hidden", "true");
  svg.Set("width", 12).Set("height", 12);
  svg.Add("use").Set("href", fmt::format("#mark-{}", Name(standing)));
  return svg;
}

Element MarkDefinitions() {
  Element svg("svg");
  svg.Set("class", "definitions").Set("aria-hidden", "true").Set("width", 0).Set("height", 0);
  Element disc = Symbol(Standing::kContained);
  disc.Add("circle").Set("cx", 6).Set("cy", 6).Set("r", 5);
  Element bars = Symbol(Standing::kWithinResolution);
  bars.Add("path").Set("class", "stroke").Set("d", "M1 3.5H11M1 8.5H11");
  Element diamond = Symbol(Standing::kInconclusive);
  diamond.Add("path").Set("d", "M6 0.5 11.5 6 6 11.5 0.5 6Z");
  Element cross = Symbol(Standing::kViolated);
  cross.Add("path").Set("class", "stroke").Set("d", "M1.5 1.5 10.5 10.5 M10.5 1.5 1.5 10.5");
  Element ring = Symbol(Standing::kNotClaimed);
  ring.Add("circle").Set("class", "stroke thin").Set("cx", 6).Set("cy", 6).Set("r", 4.5);
  for (Element* symbol : {&disc, &bars, &diamond, &cross, &ring}) svg.Add(std::move(*symbol));
  return svg;
}

Element RateChart(const CellFindings& cell) {
  Element svg = Drawing(kRateWidth, 28, RateWords(cell));
  for (const double tick : {0.0, 0.25, 0.5, 0.75, 1.0}) {
    AddLine(svg, "grid", kRates.At(tick), 0, kRates.At(tick), 28);
  }
  const bool both = cell.control_done > 0;
  AddRate(svg, "control", cell.control_succeeded, cell.control_done, 20);
  AddRate(svg, cell.is_control() ? "control" : "rate", cell.summary.succeeded, cell.summary.done,
          both ? 8 : 14);
  return svg;
}

Element RateAxis() {
  Element svg("svg");
  svg.Set("class", "chart").Set("width", kRateWidth).Set("height", 14).Set("aria-hidden", "true");
  for (const double tick : {0.0, 0.5, 1.0}) {
    const char* const anchor = tick == 0 ? "start" : tick == 1 ? "end" : "middle";
    AddWords(svg, anchor,
             tick == 0   ? 4
             : tick == 1 ? kRateWidth
                         : kRates.At(tick),
             11, fmt::format("{:.0f} %", 100 * tick));
  }
  return svg;
}

Element VerdictBar(const StandingCounts& counts) {
  constexpr double kWidth = 120;
  const auto sum = static_cast<double>(counts.Total());
  std::string words;
  for (const Standing standing : kStandings) {
    words +=
        fmt::format("{}{} {}", words.empty() ? "" : ", ", TextOf(standing), counts.Of(standing));
  }
  Element svg = Drawing(kWidth, 12, words);
  double x = 0;
  for (const Standing standing : kStandings) {
    const auto count = static_cast<double>(counts.Of(standing));
    if (count == 0) continue;
    // Even the smallest share stays visible.
    const double width = std::clamp(kWidth * count / sum, 3.0, kWidth - x);
    AddBox(svg, fmt::format("share {}", Name(standing)), x, 1, width, 10);
    x = std::min(x + width, kWidth - 3);
  }
  return svg;
}

Element ErrorChart(const ClaimFindings& claim) {
  Element svg = Drawing(kErrorWidth, kErrorHeight, ErrorWords(claim));
  const Axis axis = ErrorAxis(claim);
  AddPrediction(svg, axis, claim.claim);
  AddObserved(svg, axis, claim);
  AddTicks(svg, axis, claim.claim.dimension);
  return svg;
}

Element ConservatismChart(const sweep::ConservatismRecord& row, double greatest) {
  constexpr double kWidth = 240;
  const Axis axis{0, greatest, 4, kWidth - 10};
  Element svg =
      Drawing(kWidth, 20,
              fmt::format("guaranteed to {}, {}", NumberText(row.guaranteed),
                          row.broken ? "broken at " + NumberText(*row.broken) : "not broken"));
  AddLine(svg, "grid", axis.At(0), 10, axis.right, 10);
  AddBox(svg, "predicted", axis.At(0), 4, axis.At(row.guaranteed) - axis.At(0), 12);
  if (row.broken) AddMark(svg, Standing::kViolated, axis.At(*row.broken), 10);
  return svg;
}

}  // namespace assay::report
