#pragma once

#include <optional>
#include <span>
#include <vector>

namespace assay::check {

// Returns the rank of each margin or frequency of a contact in ascending order, from 1 on. Equal
// values share their mean rank.
std::vector<double> RanksOf(std::span<const double> values);

// Returns how well margins of contacts predict their frequencies: Spearman's coefficient in -1 ..
// 1, which is Pearson's coefficient of the ranks. It is missing if `x` or `y` does not vary. Both
// must have the same length (checked).
std::optional<double> RankCorrelation(std::span<const double> x, std::span<const double> y);

}  // namespace assay::check
