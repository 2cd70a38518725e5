#include "sim/cli/plan_output/table.h"

#include <fmt/format.h>

#include <algorithm>

#include "planner/base/check.h"
#include "planner/base/input_files/quotation.h"

namespace assay::cli {
namespace {

// Counts characters, not bytes: UTF-8 marks the bytes that continue a character.
int WidthOf(const std::string& text) {
  return static_cast<int>(std::ranges::count_if(
      text, [](char c) { return (static_cast<unsigned char>(c) >> 6) != 2; }));
}

}  // namespace

void Table::Add(std::vector<std::string> row) {
  ASSAY_CHECK(row.size() == columns_.size(), "{} cells in {} columns", row.size(), columns_.size());
  for (std::string& cell : row) cell = Show(cell);
  rows_.push_back(std::move(row));
}

std::string Table::Line(const std::vector<std::string>& cells,
                        const std::vector<int>& widths) const {
  std::string line;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::string padding(widths[i] - WidthOf(cells[i]), ' ');
    if (i > 0) line += "  ";
    line += columns_[i].align == Align::kLeft ? cells[i] + padding : padding + cells[i];
  }
  line.erase(line.find_last_not_of(' ') + 1);
  return line + '\n';
}

std::string Table::Text() const {
  std::vector<std::string> names;
  for (const Column& column : columns_) names.push_back(column.name);
  std::vector<int> widths;
  for (std::size_t i = 0; i < names.size(); ++i) {
    widths.push_back(WidthOf(names[i]));
    for (const auto& row : rows_) widths[i] = std::max(widths[i], WidthOf(row[i]));
  }
  std::string text = Line(names, widths);
  for (const auto& row : rows_) text += Line(row, widths);
  return text;
}

}  // namespace assay::cli
