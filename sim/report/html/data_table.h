#pragma once

#include <string>
#include <vector>

#include "sim/report/findings/standing.h"
#include "sim/report/html/element.h"

namespace assay::report {

// A table of a page with a caption, a head, and rows whose first entry is the row's name. If the
// window is too narrow, the table alone can be scrolled, with the keyboard as well.
class DataTable {
 public:
  struct Column {
    std::string name;
    std::string kind = {};  // class of the entries: "number" or "chart"; empty for words
  };

  DataTable(const std::string& caption, std::vector<Column> columns);

  // Adds an element to the head of a column, below its name.
  void AddToHead(std::size_t column, Element element);

  // Adds a row with one entry for each column (checked).
  void AddRow(std::vector<Element> entries);
  // Starts a group of rows with a heading across all columns.
  void AddGroup(const std::string& name);

  bool empty() const { return rows_ == 0; }
  // Returns the finished table. Call it once, at the end.
  Element Take();

 private:
  std::string caption_;
  std::vector<Column> columns_;
  std::vector<std::vector<Element>> heads_;
  Element body_{"tbody"};
  int rows_ = 0;
};

// The functions below make the contents of an entry of a table.
Element Words(std::string_view text);
Element Command(const std::string& command);  // a click selects the command
// Returns the mark and the words of a standing.
Element StandingWords(Standing standing);

}  // namespace assay::report
