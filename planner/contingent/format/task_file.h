#pragma once

#include <filesystem>

#include "planner/contingent/language/domain.h"

namespace assay::contingent {

struct Task {
  Domain domain;
  Problem problem;
};

// Reads a domain and a problem, PDDL where the domain's file ends in .pddl, PKS where it ends in
// .pks. Throws InputError for other endings, and if the problem is of another domain.
Task LoadTask(const std::filesystem::path& domain, const std::filesystem::path& problem);

}  // namespace assay::contingent
