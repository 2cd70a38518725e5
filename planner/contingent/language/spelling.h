#pragma once

#include <set>
#include <string>
#include <string_view>

namespace assay::contingent {

// The text as a name that .pks files and PDDL can have, as like it as can be: letters, digits, _
// and single - between them, no digit first. "at(cup) = table" is at-cup-table, "2nd try" _2nd-try.
std::string Spelled(std::string_view text);

// The name, which is taken from now on; with a number if it was taken already.
std::string Unique(const std::string& name, std::set<std::string>& taken);

}  // namespace assay::contingent
