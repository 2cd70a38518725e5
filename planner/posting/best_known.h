#pragma once

#include <optional>

#include "planner/domain/problem.h"

namespace assay::posting {

// The problem as the best remedies could make it: x, y and theta of every part known exactly, by
// squeezing or sensing, and z if a sensor that may be used measures it. Whatever the remedies, this
// is among what remains possible if all errors may be 0; none otherwise.
std::optional<domain::Problem> BestKnown(domain::Problem problem);

}  // namespace assay::posting
