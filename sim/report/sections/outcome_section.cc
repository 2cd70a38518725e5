#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <ranges>

#include "sim/report/charts/chart.h"
#include "sim/report/html/data_table.h"
#include "sim/report/numbers/figures.h"
#include "sim/report/sections/section.h"

namespace assay::report {
namespace {

constexpr std::size_t kMostRows = 400;

std::string FailureText(const sweep::CellSummary& summary) {
  std::vector<std::string> failures;
  for (const auto& [outcome, count] : summary.failed) {
    failures.push_back(fmt::format("{} {}", outcome, CountText(count)));
  }
  if (!failures.empty()) return fmt::format("{}", fmt::join(failures, ", "));
  return summary.cell.outcome == "planned" ? "none" : summary.cell.conflict;
}

std::string DoneText(const sweep::CellSummary& summary) {
  if (summary.done == summary.cell.trials) return CountText(summary.done);
  return fmt::format("{} of {}", CountText(summary.done), CountText(summary.cell.trials));
}

std::string ControlText(const CellFindings& cell) {
  if (cell.is_control()) return "this cell";
  if (cell.control_done == 0) return "–";
  return fmt::format("{} of {}", CountText(cell.control_succeeded), CountText(cell.control_done));
}

std::string RateWithInterval(const sweep::CellSummary& summary) {
  if (summary.done == 0) return "–";
  return fmt::format("{} ({})", RateText(summary.succeeded, summary.done),
                     WilsonText(summary.succeeded, summary.done));
}

Element CellTable(const Subject& subject) {
  std::vector<DataTable::Column> columns = {{"cell"}};
  for (const CellAxis& axis : subject.axes) columns.push_back({axis.name});
  const std::size_t plot = columns.size();
  columns.insert(columns.end(), {{"success", "chart"},
                                 {"rate, 95 % interval", "number"},
                                 {"trials", "number"},
                                 {"without noise", "number"},
                                 {"plan", "short"},
                                 {"failures"}});
  DataTable table(
      "Success of the trials of each cell, with Wilson’s 95 % interval, and of the same plan "
      "without noise. Marks of trials under noise are dark and filled. Marks of trials without "
      "noise are grey and hollow.",
      std::move(columns));
  table.AddToHead(plot, RateAxis());
  for (const CellFindings& cell : subject.findings.cells | std::views::take(kMostRows)) {
    const sweep::CellSummary& summary = cell.summary;
    std::vector<Element> row = {Words(std::to_string(cell.cell().cell))};
    for (const CellAxis& axis : subject.axes) row.push_back(Words(axis.value(cell.cell())));
    row.push_back(RateChart(cell));
    for (const std::string& text : {RateWithInterval(summary), DoneText(summary), ControlText(cell),
                                    PlanText(cell.cell()), FailureText(summary)}) {
      row.push_back(Words(text));
    }
    table.AddRow(std::move(row));
  }
  return table.Take();
}

// The results of all cells that have the same value on an axis.
struct Group {
  std::string value;
  int cells = 0, done = 0, succeeded = 0;
  std::int64_t violated = 0;
};

// Returns one group for each value of the axis, in the order in which the values first occur.
// Trials without noise count only if the axis is the noise itself.
std::vector<Group> GroupsOf(const Findings& findings, const CellAxis& axis) {
  const bool of_noise = std::string_view(axis.name) == "noise";
  std::vector<Group> groups;
  for (const CellFindings& cell : findings.cells) {
    if (cell.is_control() && !of_noise) continue;
    const std::string value = axis.value(cell.cell());
    auto group = std::ranges::find(groups, value, &Group::value);
    if (group == groups.end()) group = groups.insert(group, Group{.value = value});
    ++group->cells;
    group->done += cell.summary.done;
    group->succeeded += cell.summary.succeeded;
    group->violated += cell.summary.certificates.violated;
  }
  return groups;
}

Element AxisTable(const Subject& subject) {
  DataTable table(
      "All cells together, by each axis of the grid; only trials under noise, except for the axis "
      "of noise itself",
      {{"value"},
       {"cells", "number"},
       {"trials", "number"},
       {"succeeded", "number"},
       {"rate", "number"},
       {"95 % interval", "number"},
       {"certificates violated", "number"}});
  for (const CellAxis& axis : subject.axes) {
    table.AddGroup(axis.name);
    for (const Group& group : GroupsOf(subject.findings, axis)) {
      table.AddRow({Words(group.value), Words(CountText(group.cells)), Words(CountText(group.done)),
                    Words(CountText(group.succeeded)), Words(RateText(group.succeeded, group.done)),
                    Words(WilsonText(group.succeeded, group.done)),
                    Words(CountText(group.violated))});
    }
  }
  return table.Take();
}

}  // namespace

Element Outcomes(const Subject& subject) {
  Element section("div");
  if (const std::string common = CommonText(subject.findings.cells); !common.empty()) {
    section.Add("p", fmt::format("In all cells: {}.", common));
  }
  // For few cells the table of cells suffices.
  if (subject.findings.cells.size() > 4) section.Add(AxisTable(subject));
  section.Add(CellTable(subject));
  if (subject.findings.cells.size() > kMostRows) {
    section.Add(
        "p", fmt::format("The table has the first {} cells of {}. All cells are in outcomes.csv.",
                         kMostRows, CountText(subject.findings.cells.size())));
  }
  return section;
}

}  // namespace assay::report
