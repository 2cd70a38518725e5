#pragma once

#include <string>
#include <vector>

namespace assay::cli {

enum class Align { kLeft, kRight };

// Rows of text in columns as wide as their widest cell, with a line of names above.
class Table {
 public:
  struct Column {
    std::string name;
    Align align = Align::kLeft;
  };

  explicit Table(std::vector<Column> columns) : columns_(std::move(columns)) {}

  void Add(std::vector<std::string> row);  // a cell for each column (checked)
  std::string Text() const;                // with a line break at the end

 private:
  std::string Line(const std::vector<std::string>& cells, const std::vector<int>& widths) const;

  std::vector<Column> columns_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace assay::cli
