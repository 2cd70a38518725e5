#include <fmt/format.h>

#include "sim/report/findings/command.h"
#include "sim/report/html/data_table.h"
#include "sim/report/numbers/figures.h"
#include "sim/report/sections/section.h"

namespace assay::report {

// Making the page of a trial takes the time of an execution, and the page has about a megabyte. The
// command that makes it is given unless pages were asked for.
Element Failures(const Subject& subject) {
  const Findings& findings = subject.findings;
  Element section("div");
  if (findings.failures.empty()) {
    section.Add("p", "No trial failed.");
    return section;
  }
  section.Add("p", fmt::format("The {} a page that shows the trial in three dimensions, beside the "
                               "plan without noise.",
                               subject.view ? "link leads to" : "command makes"));
  DataTable table("Trials that failed, or in which a certificate was violated",
                  {{"trial", "number"}, {"cell"}, {"outcome"}, {"page of the trial"}});
  for (const FailedTrial& failure : findings.failures) {
    table.AddRow(
        {Words(std::to_string(failure.trial)), Words(std::to_string(failure.cell)),
         Words(failure.reason.empty() ? failure.outcome
                                      : fmt::format("{}: {}", failure.outcome, failure.reason)),
         ViewLink({failure.trial}, findings.database, subject.view)});
  }
  section.Add(table.Take());
  if (findings.failures_in_all > std::ssize(findings.failures)) {
    section.Add("p", fmt::format("The first {} of {}.", findings.failures.size(),
                                 CountText(findings.failures_in_all)));
  }
  return section;
}

}  // namespace assay::report
