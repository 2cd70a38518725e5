#include "sim/report/html/data_table.h"

#include <fmt/format.h>

#include "planner/base/check.h"
#include "sim/report/charts/chart.h"
#include "sim/report/findings/observations.h"

namespace assay::report {

DataTable::DataTable(const std::string& caption, std::vector<Column> columns)
    : caption_(caption), columns_(std::move(columns)), heads_(columns_.size()) {}

void DataTable::AddToHead(std::size_t column, Element element) {
  heads_[column].push_back(std::move(element));
}

void DataTable::AddRow(std::vector<Element> entries) {
  ASSAY_CHECK(entries.size() == columns_.size(), "{} entries for {} columns", entries.size(),
              columns_.size());
  Element& row = body_.Add("tr");
  for (std::size_t i = 0; i < entries.size(); ++i) {
    Element& entry = row.Add(i == 0 ? "th" : "td");
    if (i == 0) entry.Set("scope", "row");
    if (!columns_[i].kind.empty()) entry.Set("class", columns_[i].kind);
    entry.Add(std::move(entries[i]));
  }
  ++rows_;
}

void DataTable::AddGroup(const std::string& name) {
  body_.Add("tr")
      .Set("class", "group")
      .Add("th", name)
      .Set("colspan", std::to_string(columns_.size()))
      .Set("scope", "colgroup");
}

Element DataTable::Take() {
  Element frame("div");
  frame.Set("class", "scroll").Set("role", "region").Set("tabindex", "0");
  frame.Set("aria-label", caption_);
  Element& table = frame.Add("table");
  // The caption is narrower than a table that is scrolled, so that it is always visible.
  table.Add("caption").Add("span", caption_);
  Element& head = table.Add("thead").Add("tr");
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    Element& entry = head.Add("th", columns_[i].name).Set("scope", "col");
    if (!columns_[i].kind.empty()) entry.Set("class", columns_[i].kind);
    for (Element& more : heads_[i]) entry.Add(std::move(more));
  }
  table.Add(std::move(body_));
  return frame;
}

Element Words(std::string_view text) { return {"span", text}; }

Element Command(const std::string& command) {
  return Element("code", command).Set("class", "command");
}

Element StandingWords(Standing standing) {
  Element words("span");
  words.Set("class", "verdict");
  words.Add(Mark(standing));
  words.Text(fmt::format(" {}", TextOf(standing)));
  return words;
}

}  // namespace assay::report
