#include "sim/sweep/database/summary.h"

namespace assay::sweep {
namespace {

void CountOutcomes(const Database& database, CellSummary& summary) {
  Statement rows =
      database.Prepare("SELECT outcome, count(*) FROM trial WHERE cell = ? GROUP BY outcome");
  rows.Bind(summary.cell.cell);
  while (rows.Next()) {
    summary.done += rows.Int(1);
    if (rows.Text(0) == "succeeded") {
      summary.succeeded = rows.Int(1);
    } else {
      summary.failed[rows.Text(0)] = rows.Int(1);
    }
  }
}

void CountRest(const Database& database, CellSummary& summary) {
  Statement row = database.Prepare(
      "SELECT total(contained), total(inconclusive), total(violated), total(not_claimed),"
      " total(errors_signalled > 0), total(errors_signalled > 0 AND outcome = 'succeeded'),"
      " total(operator_called) FROM trial WHERE cell = ?");
  row.Bind(summary.cell.cell);
  if (!row.Next()) return;
  summary.certificates = {row.Int(0), row.Int(1), row.Int(2), row.Int(3)};
  summary.with_errors = row.Int(4);
  summary.recovered = row.Int(5);
  summary.operator_called = row.Int(6);
}

}  // namespace

std::vector<CellSummary> Summarize(const Store& store) {
  std::vector<CellSummary> summaries;
  for (CellRecord& cell : store.Cells()) {
    CellSummary& summary = summaries.emplace_back(CellSummary{.cell = std::move(cell)});
    CountOutcomes(store.database(), summary);
    CountRest(store.database(), summary);
  }
  return summaries;
}

}  // namespace assay::sweep
