#include "sim/report/sections/section.h"

#include <algorithm>

namespace assay::report {
namespace {

bool HasViolation(const CellFindings& cell) {
  return cell.summary.certificates.violated > 0 ||
         (cell.falsification && cell.falsification->certificates.violated > 0);
}

// Returns the priority of a cell if not all cells can be shown in full. Smaller numbers come first.
int Priority(const CellFindings& cell) {
  if (HasViolation(cell)) return 0;
  return cell.is_control() ? 2 : 1;
}

}  // namespace

int Subject::left_out() const {
  const auto told = std::ranges::count_if(
      findings.cells, [](const CellFindings& cell) { return !cell.steps.empty(); });
  return static_cast<int>(told) - static_cast<int>(in_full.size());
}

Subject SubjectOf(const Findings& findings, int most) {
  Subject subject{findings, AxesThatDiffer(findings.cells), {}};
  for (const CellFindings& cell : findings.cells) {
    if (!cell.steps.empty()) subject.in_full.push_back(&cell);
  }
  std::ranges::stable_sort(subject.in_full, {},
                           [](const CellFindings* cell) { return Priority(*cell); });
  if (subject.in_full.size() > static_cast<std::size_t>(most)) subject.in_full.resize(most);
  std::ranges::sort(subject.in_full, {},
                    [](const CellFindings* cell) { return cell->cell().cell; });
  return subject;
}

const std::vector<Section>& Sections() {
  static const std::vector<Section> kSections = {
      {"summary", "In short", SummaryOf},
      {"outcomes", "Outcome rates", Outcomes},
      {"failures", "Failed trials", Failures},
      {"recoveries", "Verifications and recoveries", Recoveries},
      {"verdicts", "Verdicts on certificates", Verdicts},
      {"error-sets", "Predicted and observed errors", ErrorSets},
      {"attacks", "Falsification", Falsifications},
      {"conservatism", "Conservatism", ConservatismRatios},
      {"setup", "Setup", Setup},
  };
  return kSections;
}

}  // namespace assay::report
