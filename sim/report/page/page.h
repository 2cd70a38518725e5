#pragma once

#include <functional>
#include <string>

#include "sim/report/sections/findings.h"

namespace assay::report {

struct PageOptions {
  int cells_in_full = 12;  // at most so many have their certificates told step by step
  // A picture of a trial, the contents of a PNG file; empty: no pictures.
  std::function<std::string(int trial)> picture = {};
};

// One HTML page, complete in itself: it fetches nothing, runs nothing, and is
// well-formed XML. The same for the same findings and pictures.
std::string Page(const Findings& findings, const PageOptions& options);

}  // namespace assay::report
