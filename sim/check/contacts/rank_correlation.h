#pragma once

#include <optional>
#include <span>
#include <vector>

namespace assay::check {

// Places in ascending order from 1 on; equal values share the mean of theirs.
std::vector<double> RanksOf(std::span<const double> values);

// Spearman's coefficient in -1 .. 1: Pearson's, of ranks. None: one of the two does not vary. As
// many x as y (checked).
std::optional<double> RankCorrelation(std::span<const double> x, std::span<const double> y);

}  // namespace assay::check
