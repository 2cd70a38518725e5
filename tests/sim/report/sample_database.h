#pragma once

#include <filesystem>
#include <string>

namespace assay::report {

// Names as bad as names can be for a page.
inline const std::string kHostileScenario = "a<b>&amp;\"'.yaml";
inline const std::string kHostilePart = "x of </td><script>alert(1)</script>&peg";

// A database with three cells of one plan of two steps.
//   1 none     1 trial, succeeded, 2 certificates contained
//   2 uniform  10 trials, 8 succeeded. Trial number k of the cell saw x at (2 k - 11) / 10 mm where
//              ±1 mm was predicted; theta at 0, but at 0.0105 in the 9th and 0.02 in the 10th where
//              ±0.01 rad with a gate of 0.001 was. Errors were signalled in the 1st to the 4th; the
//              1st and 2nd recovered, the 3rd and 4th called the operator and failed.
//   3 attack   no trials; 20,000 attempts, 2 violated, a counterexample, conservatism ratios
// With `attacked` false there are no tables of attacks, and nothing of cell 3 but its plan.
void WriteSampleDatabase(const std::filesystem::path& file, bool attacked);

}  // namespace assay::report
