#include <fmt/format.h>

#include "sim/report/findings/command.h"
#include "sim/report/html/data_table.h"
#include "sim/report/numbers/figures.h"
#include "sim/report/sections/section.h"

namespace assay::report {

// A page of each trial would take an execution and about a megabyte, so that the command that makes
// it is given instead.
Element Failures(const Subject& subject) {
  const Findings& findings = subject.findings;
  Element section("div");
  if (findings.failures.empty()) {
    section.Add("p", "No trial failed.");
    return section;
  }
  section.Add("p",
              "The command makes a page that shows the trial in three dimensions, beside the plan "
              "without noise.");
  DataTable table("Trials that failed, or in which a certificate was violated",
                  {{"trial", "number"}, {"cell"}, {"outcome"}, {"page of the trial"}});
  for (const FailedTrial& failure : findings.failures) {
    table.AddRow(
        {Words(std::to_string(failure.trial)), Words(std::to_string(failure.cell)),
         Words(failure.reason.empty() ? failure.outcome
                                      : fmt::format("{}: {}", failure.outcome, failure.reason)),
         Command(ViewCommand(findings.database, failure.trial))});
  }
  section.Add(table.Take());
  if (findings.failures_in_all > std::ssize(findings.failures)) {
    section.Add("p", fmt::format("The first {} of {}.", findings.failures.size(),
                                 CountText(findings.failures_in_all)));
  }
  return section;
}

}  // namespace assay::report
