#pragma once

#include <filesystem>
#include <string>

#include "planner/contingent/language/domain.h"

namespace assay::contingent {

struct Task {
  Domain domain;
  Problem problem;
};

enum class Language { kPks, kPddl };

// A text, and the name by which errors call it.
struct NamedText {
  std::string text;
  std::string name;
};

// Reads a domain and a problem. Throws InputError if a text is wrong, and if the PKS problem
// belongs to another domain.
Task ReadTask(Language language, const NamedText& domain, const NamedText& problem);

// Reads a domain and a problem from files. The language is PDDL if the domain's file ends in .pddl,
// and PKS if it ends in .pks. Throws InputError as ReadTask does, and for other endings.
Task LoadTask(const std::filesystem::path& domain, const std::filesystem::path& problem);

}  // namespace assay::contingent
