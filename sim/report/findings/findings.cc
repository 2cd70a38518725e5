#include "sim/report/findings/findings.h"

#include <cstdlib>

namespace assay::report {

StandingCounts StepFindings::ObservedClaims() const {
  StandingCounts sum;
  for (const ClaimFindings& claim : claims) sum += claim.observed.verdicts;
  return sum;
}

int Findings::trials() const {
  const auto found = facts.find("trials");
  return found == facts.end() ? done() : std::atoi(found->second.c_str());
}

int Findings::done() const {
  int count = 0;
  for (const CellFindings& cell : cells) count += cell.summary.done;
  return count;
}

}  // namespace assay::report
