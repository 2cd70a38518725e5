#pragma once

#include <string>
#include <string_view>

#include "planner/base/document.h"
#include "planner/domain/problem/problem.h"

namespace assay::domain {

// A name that a file gives: letters, digits, - and _. Throws InputError, which tells what it is to
// name ("a part").
std::string ReadName(const Value& key, std::string_view what);

// Any text but none.
std::string ReadAnyName(const Value& value);

// The part of this name. Throws InputError if there is none.
PartId ReadPartName(const Value& value, const Problem& problem);

}  // namespace assay::domain
