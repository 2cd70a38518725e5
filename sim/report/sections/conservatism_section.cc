#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "sim/report/charts/chart.h"
#include "sim/report/html/data_table.h"
#include "sim/report/numbers/figures.h"
#include "sim/report/sections/section.h"

namespace assay::report {

using sweep::ConservatismRecord;

namespace {

double Greatest(const std::vector<ConservatismRecord>& rows) {
  double greatest = 1;
  for (const ConservatismRecord& row : rows) {
    greatest = std::max({greatest, row.guaranteed, row.broken.value_or(0)});
  }
  return greatest;
}

std::string RatioText(const ConservatismRecord& row) {
  if (!row.ratio) return NumberText(std::numeric_limits<double>::quiet_NaN());
  return (row.broken ? "" : "more than ") + NumberText(*row.ratio);
}

void AddRow(DataTable& table, const ConservatismRecord& row, double greatest) {
  table.AddRow({Words(row.variable == "all" ? "all together" : row.variable),
                ConservatismChart(row, greatest), Words("× " + NumberText(row.guaranteed)),
                Words(row.broken ? "× " + NumberText(*row.broken) : "not broken"),
                Words(RatioText(row))});
}

}  // namespace

Element ConservatismRatios(const Subject& subject) {
  Element section("div");
  if (std::ranges::none_of(subject.findings.cells, &CellFindings::has_conservatism)) {
    section.Add("p", "The sweep did not measure how much more error the plans tolerate.");
    return section;
  }
  section.Add("p",
              "The ratio is the least multiple of the errors at which a trial failed, divided by "
              "the greatest multiple that the planner guarantees. A ratio of 1 means that the "
              "guarantee is tight. A ratio of 3 means that trials failed only when the errors were "
              "three times the guaranteed ones.");
  for (const CellFindings& cell : subject.findings.cells) {
    if (!cell.has_conservatism()) continue;
    DataTable table(fmt::format("{}: multiples of the errors", subject.NameOf(cell)),
                    {{"variable"},
                     {"guaranteed (bar), broken (cross)", "chart"},
                     {"guaranteed", "number"},
                     {"broken at", "number"},
                     {"ratio", "number"}});
    const std::vector<ConservatismRecord>& rows = cell.falsification->conservatism;
    for (const ConservatismRecord& row : rows) AddRow(table, row, Greatest(rows));
    section.Add(table.Take());
  }
  return section;
}

}  // namespace assay::report
