#include "planner/verify/plan_verification.h"

#include <algorithm>
#include <iterator>

#include "planner/assembly/plan_check.h"
#include "planner/verify/certificate_check.h"
#include "planner/verify/certificate_comparison.h"

namespace assay::verify {
namespace {

void Tell(const Submitted& submitted, std::string_view what) {
  if (submitted.progress) submitted.progress(what);
}

std::vector<plan::Flaw> Contradictions(const Submitted& submitted) {
  Tell(submitted, "checking the certificates");
  return CertificateFlaws(submitted.plan, submitted.file);
}

// Returns where the certificates differ from certificates that are computed anew. The plan must
// have no flaws of other kinds.
std::vector<plan::Flaw> Differences(const Submitted& submitted) {
  if (!submitted.is_of_file || !IsCertified(submitted.plan)) return {};
  Tell(submitted, "computing the certificates anew");
  return DifferencesFromAnew(submitted.problem, submitted.plan, submitted.file);
}

}  // namespace

plan::CheckReport Verify(const Submitted& submitted, int most_linearizations) {
  Tell(submitted, "checking the plan");
  plan::CheckReport report =
      assembly::Check(submitted.problem, submitted.plan, most_linearizations);
  std::ranges::move(Contradictions(submitted), std::back_inserter(report.flaws));
  if (report.flaws.empty()) report.flaws = Differences(submitted);
  return report;
}

}  // namespace assay::verify
