#pragma once

#include <filesystem>
#include <string>

namespace assay::report {

// Names that would break a page if they were not escaped.
inline const std::string kHostileScenario = "a<b>&amp;\"'.yaml";
inline const std::string kHostilePart = "x of </td><script>alert(1)</script>&peg";

// Writes a database with three cells for one plan of two steps.
//   1 none     1 trial, succeeded, 2 certificates contained
//   2 uniform  10 trials, 8 succeeded
//   3 attack   no trials; 20,000 attempts, 2 violated, a counterexample, conservatism ratios
// In trial k of cell 2, the observed x is (2 k - 11) / 10 mm, and ±1 mm was predicted. The observed
// theta is 0, but 0.0105 in the 9th trial and 0.02 in the 10th. ±0.01 rad was predicted for it,
// with a gate of 0.001. Errors were signalled in trials 1 to 4. The first two recovered, and the
// other two called the operator and failed.
// If `tried` is false, there are no tables of falsification, and cell 3 has only its plan.
void WriteSampleDatabase(const std::filesystem::path& file, bool tried);

}  // namespace assay::report
