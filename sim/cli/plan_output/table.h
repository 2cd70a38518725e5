#pragma once

#include <string>
#include <vector>

namespace assay::cli {

enum class Align { kLeft, kRight };

// A table of text. Columns are as wide as their widest cell, and a line of names is above them.
class Table {
 public:
  struct Column {
    std::string name;
    Align align = Align::kLeft;
  };

  explicit Table(std::vector<Column> columns) : columns_(std::move(columns)) {}

  void Add(std::vector<std::string> row);  // one cell for each column (checked)
  std::string Text() const;                // ends with a line break

 private:
  std::string Line(const std::vector<std::string>& cells, const std::vector<int>& widths) const;

  std::vector<Column> columns_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace assay::cli
