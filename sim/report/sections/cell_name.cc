#include "sim/report/sections/cell_name.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <set>

#include "sim/report/numbers/figures.h"

namespace assay::report {
namespace {

// Returns the scenario's name without folder dots and ending: "spar-fig15" for
// "../spar-fig15.yaml".
std::string ScenarioName(const sweep::CellRecord& cell) {
  const std::filesystem::path file(cell.scenario);
  std::filesystem::path name;
  for (const auto& piece : file.parent_path() / file.stem()) {
    if (piece != "..") name /= piece;
  }
  return name.string();
}

constexpr std::array kAxes = {
    CellAxis{"scenario", ScenarioName},
    CellAxis{"clearance",
             [](const sweep::CellRecord& cell) {
               return QuantityText(cell.clearance, domain::Dimension::kLength);
             }},
    CellAxis{"errors",
             [](const sweep::CellRecord& cell) { return "× " + NumberText(cell.error_scale); }},
    CellAxis{"propagation", [](const sweep::CellRecord& cell) { return cell.propagation; }},
    CellAxis{"resolvers", [](const sweep::CellRecord& cell) { return cell.resolvers; }},
    CellAxis{"grasp", [](const sweep::CellRecord& cell) { return cell.grasp; }},
    CellAxis{"sensing", [](const sweep::CellRecord& cell) { return cell.sensing; }},
    CellAxis{"noise", [](const sweep::CellRecord& cell) { return cell.noise; }},
    CellAxis{"seed", [](const sweep::CellRecord& cell) { return std::to_string(cell.seed); }},
};

}  // namespace

std::vector<CellAxis> AxesThatDiffer(const std::vector<CellFindings>& cells) {
  std::vector<CellAxis> differ;
  for (const CellAxis& axis : kAxes) {
    std::set<std::string> values;
    for (const CellFindings& cell : cells) values.insert(axis.value(cell.cell()));
    if (values.size() > 1) differ.push_back(axis);
  }
  return differ;
}

std::string CommonText(const std::vector<CellFindings>& cells) {
  std::vector<std::string> common;
  const std::vector<CellAxis> differ = AxesThatDiffer(cells);
  for (const CellAxis& axis : kAxes) {
    const bool differs = std::ranges::find(differ, axis.name, &CellAxis::name) != differ.end();
    if (!cells.empty() && !differs) {
      common.push_back(fmt::format("{} {}", axis.name, axis.value(cells.front().cell())));
    }
  }
  return fmt::format("{}", fmt::join(common, ", "));
}

std::string CellName(const sweep::CellRecord& cell, const std::vector<CellAxis>& axes) {
  std::vector<std::string> values;
  for (const CellAxis& axis : axes) {
    const std::string value = axis.value(cell);
    const bool bare = std::string_view(axis.name) == "errors" ||
                      std::string_view(axis.name) == "seed" ||
                      std::string_view(axis.name) == "clearance";
    values.push_back(bare ? fmt::format("{} {}", axis.name, value) : value);
  }
  if (values.empty()) return fmt::format("Cell {}", cell.cell);
  return fmt::format("Cell {}: {}", cell.cell, fmt::join(values, ", "));
}

std::string PlanText(const sweep::CellRecord& cell) {
  if (cell.outcome == "none") return "no plan";
  if (cell.outcome == "budget") return "budget spent";
  if (cell.outcome == "untestable") {
    return CountText(cell.actions, "action") + ", cannot be tested";
  }
  return fmt::format("{}, {}", CountText(cell.actions, "action"),
                     cell.proved ? "proved" : fmt::format("{} unproved", cell.errors));
}

}  // namespace assay::report
