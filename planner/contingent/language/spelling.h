#pragma once

#include <set>
#include <string>
#include <string_view>

namespace assay::contingent {

// Returns the text as a name that .pks files and PDDL accept, as close to the text as possible:
// letters, digits, _ and single - between them, and no digit first. "at(cup) = table" becomes
// at-cup-table, and "2nd try" becomes _2nd-try.
std::string Spelled(std::string_view text);

// Returns the name for a .pks file or PDDL, with a number appended if it is in `taken` already, and
// adds the result to `taken`.
std::string Unique(const std::string& name, std::set<std::string>& taken);

}  // namespace assay::contingent
