#pragma once

#include <filesystem>

#include "planner/contingent/language/domain.h"

namespace assay::contingent {

struct Task {
  Domain domain;
  Problem problem;
};

// Reads a domain and a problem. The format is PDDL if the domain's file ends in .pddl, and PKS if
// it ends in .pks. Throws InputError for other endings, and if the problem belongs to another
// domain.
Task LoadTask(const std::filesystem::path& domain, const std::filesystem::path& problem);

}  // namespace assay::contingent
