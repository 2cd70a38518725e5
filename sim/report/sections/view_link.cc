#include "sim/report/sections/view_link.h"

#include <fmt/format.h>

#include "sim/report/findings/command.h"
#include "sim/report/html/data_table.h"

namespace assay::report {

std::string ViewedTrial::FileName() const {
  return counterexample ? fmt::format("counterexample-{}-{}.html", trial, *counterexample)
                        : fmt::format("trial-{}.html", trial);
}

Element ViewLink(const ViewedTrial& viewed, const std::string& database, const ViewMaker& make) {
  if (!make) return Command(ViewCommand(database, viewed.trial, viewed.counterexample));
  return Element("a", viewed.FileName()).Set("href", make(viewed));
}

}  // namespace assay::report
