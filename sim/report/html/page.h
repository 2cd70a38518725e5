#pragma once

#include <functional>
#include <string>

#include "sim/report/findings/findings.h"
#include "sim/report/sections/view_link.h"

namespace assay::report {

struct PageOptions {
  int cells_in_full = 12;  // the most cells whose certificates are shown step by step
  // Returns a picture of a trial as the contents of a PNG file. If empty, there are no pictures.
  std::function<std::string(int trial)> picture = {};
  // Makes the pages in three dimensions to which the page links. If empty, the page gives the
  // commands that make them.
  ViewMaker view = {};
};

// Returns a self-contained HTML page that fetches nothing, runs no scripts, and is well-formed XML.
// Equal findings, pictures and addresses give equal pages.
std::string Page(const Findings& findings, const PageOptions& options);

}  // namespace assay::report
