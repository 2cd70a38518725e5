#pragma once

#include <functional>
#include <optional>
#include <string>

#include "sim/report/html/element.h"

namespace assay::report {

// A page in three dimensions of a trial, or of a counterexample of a falsification.
struct ViewedTrial {
  int trial = 0;                           // number in the sweep
  std::optional<int> counterexample = {};  // from 1

  std::string FileName() const;  // "trial-17.html"
};

// Makes the page and returns its address as seen from the report.
using ViewMaker = std::function<std::string(const ViewedTrial& viewed)>;

// Returns a link to the page. Without a maker, it returns the command that makes the page of a
// trial of the database.
Element ViewLink(const ViewedTrial& viewed, const std::string& database, const ViewMaker& make);

}  // namespace assay::report
