#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/report/chart.h"
#include "sim/report/data_table.h"
#include "sim/report/figures.h"
#include "sim/report/section.h"

namespace assay::report {
namespace {

double Greatest(const CellFindings& cell) {
  double greatest = 1;
  for (const Conservatism& row : cell.conservatism) {
    for (const double value : {row.guaranteed, row.broken}) {
      if (std::isfinite(value)) greatest = std::max(greatest, value);
    }
  }
  return greatest;
}

void AddRow(DataTable& table, const Conservatism& row, double greatest) {
  const bool broke = std::isfinite(row.broken);
  table.AddRow({Words(row.variable == "all" ? "all together" : row.variable),
                ConservatismChart(row, greatest), Words("× " + NumberText(row.guaranteed)),
                Words(broke ? "× " + NumberText(row.broken) : "not broken"),
                Words(!broke && std::isfinite(row.ratio) ? "more than " + NumberText(row.ratio)
                                                         : NumberText(row.ratio))});
}

}  // namespace

Element ConservatismRatios(const Subject& subject) {
  Element section("div");
  bool any = false;
  for (const CellFindings& cell : subject.findings.cells) any |= !cell.conservatism.empty();
  if (!any) {
    section.Add("p", "How much more noise it would take to break a plan was not measured.");
    return section;
  }
  section.Add("p",
              "The ratio is the smallest multiple of the noise that broke the plan in physics over "
              "the multiple that the planner guarantees: 1 means that the guarantee is tight, 3 "
              "that the noise could be three times as great before anything went wrong.");
  for (const CellFindings& cell : subject.findings.cells) {
    if (cell.conservatism.empty()) continue;
    DataTable table(fmt::format("{}: multiples of the noise", subject.NameOf(cell)),
                    {{"variable"},
                     {"guaranteed (bar), broken (cross)", "chart"},
                     {"guaranteed", "number"},
                     {"broken at", "number"},
                     {"ratio", "number"}});
    for (const Conservatism& row : cell.conservatism) AddRow(table, row, Greatest(cell));
    section.Add(table.Take());
  }
  return section;
}

}  // namespace assay::report
