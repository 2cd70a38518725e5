#include <fmt/format.h>

#include "sim/report/html/data_table.h"
#include "sim/report/numbers/figures.h"
#include "sim/report/sections/section.h"

namespace assay::report {
namespace {

std::string Both(int successes, int trials) {
  return fmt::format("{} ({})", RateText(successes, trials), WilsonText(successes, trials));
}

void AddRow(DataTable& table, const Subject& subject, const CellFindings& cell) {
  const sweep::CellSummary& summary = cell.summary;
  const RecoveryFindings& recovery = cell.recovery;
  table.AddRow({Words(subject.NameOf(cell)), Words(CountText(summary.done)),
                Words(fmt::format("{} ({})", CountText(summary.with_errors),
                                  RateText(summary.with_errors, summary.done))),
                Words(CountText(recovery.signalled)), Words(CountText(recovery.mended)),
                Words(CountText(summary.recovered)), Words(CountText(summary.operator_called)),
                Words(Both(recovery.unaided, summary.done)),
                Words(Both(summary.succeeded, summary.done))});
}

}  // namespace

Element Recoveries(const Subject& subject) {
  DataTable table("Trials in which a verification signalled an error, and their results",
                  {{"cell"},
                   {"trials", "number"},
                   {"with an error", "number"},
                   {"errors", "number"},
                   {"mended", "number"},
                   {"trials recovered", "number"},
                   {"operator called", "number"},
                   {"success without recoveries", "number"},
                   {"success with them", "number"}});
  for (const CellFindings& cell : subject.findings.cells) {
    if (cell.recovery.verifies && cell.summary.done > 0) AddRow(table, subject, cell);
  }
  Element section("div");
  if (table.empty()) {
    section.Add("p", "No plan has verifications, because all preconditions are proved.");
    return section;
  }
  section.Add("p",
              "If a precondition could not be proved, the plan verifies the step by a measurement, "
              "and recovers from an error. Without recoveries, every trial with an error would "
              "have failed. A trial is recovered if it had an error and succeeded.");
  section.Add(table.Take());
  return section;
}

}  // namespace assay::report
