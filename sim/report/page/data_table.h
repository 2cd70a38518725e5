#pragma once

#include <string>
#include <vector>

#include "sim/report/page/element.h"

namespace assay::report {

// A table of a page: with a caption, a head, and rows whose first entry names
// them. It can be scrolled by itself where the window is narrower, by keyboard
// too.
class DataTable {
 public:
  struct Column {
    std::string name;
    std::string kind = {};  // class of its entries: "number", "chart"; empty: words
  };

  DataTable(const std::string& caption, std::vector<Column> columns);

  // What stands in the head of a column below its name.
  void AddToHead(std::size_t column, Element element);

  // An entry for each column (checked). A row with a heading for all of its
  // columns starts a group.
  void AddRow(std::vector<Element> entries);
  void AddGroup(const std::string& name);

  bool empty() const { return rows_ == 0; }
  Element Take();  // at the end

 private:
  std::string caption_;
  std::vector<Column> columns_;
  std::vector<std::vector<Element>> heads_;
  Element body_{"tbody"};
  int rows_ = 0;
};

// Contents of an entry.
Element Words(std::string_view text);
Element Command(const std::string& command);  // a click selects it
// Its mark and its words.
Element StandingWords(Standing standing);

}  // namespace assay::report
